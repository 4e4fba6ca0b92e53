// SPDX-License-Identifier: MIT
// Bars with strengths drawn by Weibull's law, each pulled until it breaks: mean and size effect.
//   weibull_bars [BARS] [MODULUS]      (1000 and 8; a minute)
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

constexpr double strength = 3e6, stiffness = 30e9, reference_volume = 1e-3;
/// Steps in which the mean of the closed form is reached: the load is known to a part of 400.
constexpr double steps_to_mean = 400;

/// `scale` times 0.3 x 0.1 x 0.1 m in cells of 0.1 m.
struct Bars {
  int scale = 1;
  double modulus = 8;
  double length() const { return 0.3 * scale; }
  double volume() const { return 0.003 * scale * scale * scale; }
  /// The volume that can break: at the ends every tetrahedron of a vertex lies on one side of the
  /// plane across the bar, so the half cells there hold anything.
  double breakable() const { return volume() * (1 - 0.1 / length()); }
  double closed_mean() const {
    return strength * std::pow(reference_volume / breakable(), 1 / modulus) *
           std::tgamma(1 + 1 / modulus);
  }
};

/// Without lateral contraction the grips disturb nothing: the stress is uniform.
Scene pulled_bar(const Bars& bars, std::uint32_t seed) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back(
      {.name = "bar", .mesh = suite::kuhn_box({3 * bars.scale, bars.scale, bars.scale}, 0.1)});
  BodySettings& body = scene.bodies[0];
  body.material = {.young_modulus = stiffness, .poisson_ratio = 0, .tensile_strength = strength};
  const double end = bars.length();
  const double speed =
      bars.closed_mean() / stiffness * end / (steps_to_mean * scene.integrator.time_step);
  body.held = {
      {.minimum = {-0.01, -1, -1}, .maximum = {0.01, 9, 9}},
      {.minimum = {end - 0.01, -1, -1}, .maximum = {end + 0.01, 9, 9}, .velocity = {speed, 0, 0}}};
  body.strength.weibull =
      WeibullSettings{.modulus = bars.modulus, .reference_volume = reference_volume, .seed = seed};
  scene.gravity.acceleration.setZero();
  scene.energy_ledger = false;
  return scene;
}

/// Pa: the mean axial stress in the step in which the bar breaks; 0 where it does not.
double breaking_stress(const Bars& bars, std::uint32_t seed) {
  Result<Simulation> sim = build_simulation(pulled_bar(bars, seed));
  if (!sim) return 0;
  for (int step = 0; step < 4 * steps_to_mean; ++step) {
    double stress = 0, volume = 0;
    const StepReport report = advance(*sim, [&](const Simulation& now, const PartReport&) {
      const ElementColumns& e = now.state->mechanics.elements;
      for (std::size_t t = 0; t < e.size(); ++t) {
        stress += e.rest_volume[t] * e.stress[t](0, 0);
        volume += e.rest_volume[t];
      }
    });
    if (report.status.outcome != StepOutcome::fine) return 0;
    if (!report.fracture.fans.empty()) return stress / volume;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
  const double modulus = argc > 2 ? std::atof(argv[2]) : 8;
  if (count < 2 || !(modulus > 0)) {
    fmt::print(stderr, "weibull_bars [BARS, at least 2] [MODULUS, above 0]\n");
    return 2;
  }
  fmt::print(
      "{} bars each, modulus {}\nbreakable m^3   mean MPa  closed form   ratio  standard error\n",
      count, modulus);
  std::vector<double> means;
  for (const int scale : {1, 2, 4}) {
    const Bars bars{scale, modulus};
    double sum = 0, squares = 0;
    for (int k = 0; k < count; ++k) {
      const double broke = breaking_stress(bars, static_cast<std::uint32_t>(k));
      if (!(broke > 0)) {
        fmt::print(stderr, "bar {} of {} m^3 did not break\n", k, bars.volume());
        return 1;
      }
      sum += broke;
      squares += broke * broke;
    }
    const double mean = sum / count;
    means.push_back(mean);
    const double error = std::sqrt((squares / count - mean * mean) / count) / mean;
    fmt::print("{:<13.4g}  {:>9.4f}  {:>11.4f}  {:>6.4f}  {:>6.4f}\n", bars.breakable(), mean / 1e6,
               bars.closed_mean() / 1e6, mean / bars.closed_mean(), error);
  }
  const double slope = std::log(means[2] / means[0]) /
                       std::log(Bars{4, modulus}.breakable() / Bars{1, modulus}.breakable());
  fmt::print("mean ~ volume^{:.4f}; Weibull: {:.4f}\n", slope, -1 / modulus);
  return 0;
}

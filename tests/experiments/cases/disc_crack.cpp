// SPDX-License-Identifier: MIT
// The disc's mesh (squares turned into rings), its scene and its run.
#include "tests/experiments/cases/disc_crack.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fracture/algorithms/node_stress.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

using std::numbers::pi;
constexpr double strength = 5e6, alpha = pi / 18, rate = 1e7, rounding = 1e-6;

/// Pressure at which the centre reaches the strength, Pa.
double hondros_pressure() { return strength * pi / (2 * (std::sin(2 * alpha) - alpha)); }

double disc_thickness(int cells) { return 2 * 2.0 / cells; }

/// Squares about the centre become circles, so that arcs of 10 degrees end at vertices where
/// `cells` is a multiple of 18.
Scene scene_of(int cells) {
  BodySettings disc;
  const double cell = 2.0 / cells;
  disc.mesh = suite::kuhn_box({cells, cells, 2}, 1);
  for (Point& p : disc.mesh.points) {
    const double u = p[0] * cell - 1, v = p[1] * cell - 1;
    const bool steep = std::abs(v) >= std::abs(u);
    const double r = steep ? v : u, along = steep ? u : v;
    const double angle = r == 0 ? 0 : pi / 4 * along / r;
    const double major = r * std::cos(angle), minor = r * std::sin(angle);
    p = {steep ? minor : major, steep ? major : minor, p[2] * cell};
  }
  disc.material = {.young_modulus = 30e9,
                   .poisson_ratio = 0.2,
                   .density = 2400,
                   .tensile_strength = strength,
                   .toughness = 1.5e6};
  disc.held = {{.minimum = {1 - 0.5 * cell, -1.1 * cell, -1}, .maximum = {2, 1.1 * cell, 9}}};
  const double pressure = 2 * hondros_pressure(), edge = std::cos(alpha) - rounding;
  const double ramp = pressure / rate;
  disc.loads = {
      {.minimum = {-9, edge, -9}, .maximum = {9, 9, 9}, .pressure = pressure, .ramp_time = ramp},
      {.minimum = {-9, -9, -9}, .maximum = {9, -edge, 9}, .pressure = pressure, .ramp_time = ramp}};
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies = {disc};
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-3;
  scene.fracture.relax = 2;
  return scene;
}

Simulation built(const Scene& scene) {
  auto sim = build_simulation(scene);
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  return std::move(*sim);
}

double centre_tension(const Scene& scene) {
  Simulation sim = built(scene);
  MechanicsState& m = sim.state->mechanics;
  const auto corners = sim.state->cells.map.corners();
  Loads loads;
  add_corner_loads(loads.force, sim.state->loads, m, corners, scene.bodies[0].loads[0].ramp_time);
  const auto findings = solve_static(m, sim.scratch->mechanics, corners, loads);
  if (!findings.empty()) throw std::runtime_error(findings.front().text);
  const auto stress = node_stress_of(sim.state->cells, m, NodeStress::volume);
  double tension = 0, nearest = 9;
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    const Vec3& x = m.vertices.rest_position[v];
    const double r = std::hypot(x.x(), x.y());
    if (r > nearest) continue;
    nearest = r;
    tension = largest_principal_stress(stress[v]);
  }
  return tension / (2 * strength);
}

/// The extent and the area of the fans on the diameter.
struct DiameterCrack {
  double lowest = 1, highest = -1;  ///< m
  double area = 0, across = 0;      ///< m^2

  double length() const { return std::max(0.0, highest - lowest) / 2; }
};

void add_fans(DiscAnswer& answer, DiameterCrack& crack, const Cells& cells,
              const StepReport& report) {
  for (const FanEvent& fan : report.fracture.fans) {
    if (crack.length() >= 0.75) return;
    const double off = std::abs(fan.rest_position.x()) * answer.cells / 2;
    if (answer.fans++ == 0) {
      answer.first = off;
      answer.load = report.time * rate / hondros_pressure();
    }
    answer.farthest = std::max(answer.farthest, off);
    crack.lowest = std::min(crack.lowest, fan.rest_position.y());
    crack.highest = std::max(crack.highest, fan.rest_position.y());
    for (const FaceSplit& face : fan.faces) {
      const Vec3 a = rest_area_vector(cells.map, face.face);
      crack.area += a.norm();
      crack.across += std::abs(a.x());
    }
  }
}

}  // namespace

DiscAnswer brazilian_disc(int cells) {
  const Scene scene = scene_of(cells);
  Simulation sim = built(scene);
  DiscAnswer answer{.cells = cells, .vertices = sim.state->mechanics.vertices.size()};
  answer.tension = centre_tension(scene);
  DiameterCrack crack;
  const double longest = 2 * hondros_pressure() / rate;
  while (crack.length() < 0.75 && sim.state->mechanics.time < longest) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    add_fans(answer, crack, sim.state->cells, report);
  }
  answer.length = crack.length();
  answer.area = crack.area / (2 * crack.length() * disc_thickness(cells));
  answer.upright = crack.area > 0 ? crack.across / crack.area : 0;
  return answer;
}

}  // namespace sunder::accuracy

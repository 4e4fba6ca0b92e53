// SPDX-License-Identifier: MIT
// Makes the scene of a blow, runs it both ways, and counts.
#include "tests/experiments/cases/random_blows.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "fracture/simulation/ledger/break_energy.hpp"
#include "fracture/simulation/rubble/islands.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

using Random = std::mt19937_64;

/// In [a, b), the same on every machine.
double between(Random& random, double a, double b) {
  return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53;
}

Vec3 direction(Random& random) {
  for (;;) {
    const Vec3 d(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
    if (d.norm() > 0.1 && d.norm() < 1) return d.normalized();
  }
}

constexpr double cell = 0.05;

BodySettings block(Random& random) {
  BodySettings body;
  const auto side = [&] { return 1 + static_cast<int>(random() % 3); };
  body.mesh = suite::kuhn_box({side(), side(), side()}, cell);
  body.rotation = Eigen::AngleAxisd(between(random, 0, 3), direction(random));
  body.spin = between(random, 0, 1) * direction(random);
  return body;
}

/// Puts the body's lowest point at `height` and its middle over (x, 0).
void place(BodySettings& body, double x, double height) {
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const Point& p : body.mesh.points) {
    const Vec3 at = body.rotation * Vec3(p[0], p[1], p[2]);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Vec3 middle = 0.5 * (low + high);
  body.translation = {x - middle.x(), -middle.y(), height - low.z()};
}

double height_of(const BodySettings& body) {
  double low = 1e9, high = -1e9;
  for (const Point& p : body.mesh.points) {
    const double z = (body.rotation * Vec3(p[0], p[1], p[2])).z();
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return high - low;
}

Simulation built_body(Scene scene) {
  Result<Simulation> sim = build_simulation(std::move(scene));
  if (!sim) throw std::runtime_error("random_blows: " + sim.findings.front().text);
  return std::move(*sim);
}

/// The scene for a unit speed, m/s.
Scene scene_of(Random& random) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.impact.negligible = 0.01;
  const double gap = between(random, 0, 0.002);
  const std::uint64_t kind = random() % 4;
  if (kind != 1) scene.obstacles = {{.shape = Plane{}}};
  BodySettings one = block(random), two = block(random), three = block(random);
  one.velocity = -Vec3::UnitZ() + 0.3 * direction(random);
  place(one, 0, gap);
  scene.bodies = {one};
  if (kind > 0) {
    two.spin *= kind == 2 ? 0 : 1;
    if (kind == 2) two.rotation.setIdentity();
    place(two, 0, kind == 2 ? 0 : gap);
    place(scene.bodies[0], between(random, -cell, cell) / 2, height_of(two) + 2 * gap);
    scene.bodies.push_back(two);
  }
  if (kind == 3) {
    scene.bodies[1].velocity = 0.3 * direction(random);
    three.velocity = -Vec3::UnitZ();
    place(three, 0, height_of(two) + height_of(one) + 4 * gap);
    scene.bodies.push_back(three);
  }
  return scene;
}

/// Scales velocities so that a blow has `part` of the energy that the weakest star needs.
void set_energy(Scene& scene, double part) {
  const Simulation sim = built_body(scene);
  std::vector<double> energy;
  BreakEnergyScratch scratch;
  note_break_energies(energy, sim.state->mechanics, sim.state->cells, scene.fracture.node_stress,
                      scratch);
  double speed = 1e9;
  for (const Component& c : sim.state->mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    speed = std::min(speed, std::sqrt(2 * part * energy[c.id.index()] / c.mass));
  }
  for (BodySettings& body : scene.bodies) {
    body.velocity *= speed;
    body.spin *= speed / cell;
  }
}

struct Run {
  std::uint64_t opened = 0, fans = 0, by_pair = 0, by_island = 0;
};

Run run(Scene scene, bool by_energy, int steps) {
  scene.impact.by_energy = by_energy;
  Simulation sim = built_body(std::move(scene));
  Run sum;
  for (int k = 0; k < steps; ++k) {
    const StepReport report = advance(sim);
    sum.opened += report.impact.opened;
    sum.by_pair += report.impact.spared_by_pair;
    sum.by_island += report.impact.spared_by_island;
    sum.fans += report.fracture.fans.size();
    if (sum.fans > 0) break;
  }
  return sum;
}

}  // namespace

BlowOutcome run_blow(std::uint64_t number) {
  Random random(number);
  Scene scene = scene_of(random);
  set_energy(scene, std::pow(10, between(random, -1.5, 3)));
  const double travel = 0.1 / compression_wave_speed(scene.bodies[0].material);
  const double step = travel * std::pow(10, between(random, std::log10(0.5), std::log10(50)));
  double slowest = 1e9;
  for (const BodySettings& body : scene.bodies) {
    if (body.velocity.norm() > 0) slowest = std::min(slowest, body.velocity.norm());
  }
  scene.integrator.time_step = step;
  // Until the slowest body has had its impacts, and the waves have gone.
  const double duration = std::min(0.006 / slowest + 20 * travel, 400 * step);
  const int steps = 1 + static_cast<int>(duration / step);
  const Run always = run(scene, false, steps), by_energy = run(scene, true, steps);
  return {always.fans > 0,      by_energy.fans > 0,    always.opened > 0,
          by_energy.opened > 0, by_energy.by_pair > 0, by_energy.by_island > 0};
}

BlowCounts run_blows(std::uint64_t first, std::uint64_t count) {
  BlowCounts sum;
  for (std::uint64_t k = 0; k < count; ++k) {
    const BlowOutcome o = run_blow(first + k);
    ++sum.blows;
    sum.broke += o.breaks_always;
    sum.missed += o.breaks_always && !o.opens_by_energy;
    sum.needless += o.opens_by_energy && !o.breaks_always;
    sum.spared += o.opens_always && !o.opens_by_energy;
    sum.spared_by_pair += o.by_pair;
    sum.spared_by_island += o.by_island;
  }
  return sum;
}

CertificateCounts run_certificates(std::uint64_t first, std::uint64_t count) {
  CertificateCounts sum;
  for (std::uint64_t number = first; number < first + count; ++number) {
    Random random(number);
    Scene scene = scene_of(random);
    set_energy(scene, std::pow(10, between(random, -3, 3)));
    scene.integrator.time_step = rubble_clock(1).tick / 8;
    scene.impact.by_energy = false;
    const double tick = rubble_clock(scene.integrator.time_step).tick;
    Simulation sim = built_body(scene);
    std::vector<double> threshold;
    BreakEnergyScratch scratch;
    note_break_energies(threshold, sim.state->mechanics, sim.state->cells,
                        scene.fracture.node_stress, scratch);
    const std::vector<char> none(threshold.size(), 0);
    const RubbleChoice choice =
        choose_rubble(sim, {threshold, none, none, scene.gravity.acceleration, tick});
    bool all = true;
    for (const Component& c : sim.state->mechanics.components) {
      all = all && (c.tetrahedra.empty() || choice.component[c.id.index()]);
    }
    const auto steps = static_cast<int>(std::lround(tick / scene.integrator.time_step));
    const bool breaks = run(scene, false, steps).fans > 0;
    ++sum.blows;
    sum.certified += all;
    sum.missed += all && breaks;
    sum.refused += choice.refused > 0;
    sum.needless += choice.refused > 0 && !breaks;
  }
  return sum;
}

}  // namespace sunder::accuracy

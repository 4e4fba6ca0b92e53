// SPDX-License-Identifier: MIT
// Builds the scene of the flat bar, runs it and measures.
#include "tests/experiments/cases/impact_bar.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/algorithms/node_stress.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

/// The numbers that everything is measured by.
struct Scales {
  double speed, wave_speed, stress, strength, area;
  double travel() const { return 1 / wave_speed; }  ///< L/c, s
};

Scales scales_of(const BarImpact& impact) {
  const Material material{.poisson_ratio = 0};
  const double c = bar_wave_speed(material);
  const double v = impact.blow * material.tensile_strength / (material.density * c);
  const double side = 1.0 / impact.cells[0];
  return {v, c, material.density * c * v, material.tensile_strength,
          side * side * impact.cells[1] * impact.cells[2]};
}

Scene scene_of(const BarImpact& impact, const Scales& scales) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  BodySettings bar;
  bar.name = "bar";
  bar.mesh =
      suite::kuhn_box({impact.cells[0], impact.cells[1], impact.cells[2]}, 1.0 / impact.cells[0]);
  bar.material.poisson_ratio = 0;
  bar.velocity = {-scales.speed, 0, 0};
  scene.integrator = impact.integrator;
  scene.integrator.time_step = impact.step * scales.travel();
  bar.translation = {impact.touches_at * scene.integrator.time_step * scales.speed, 0, 0};
  scene.bodies.push_back(std::move(bar));
  scene.obstacles = {{.shape = Plane{{1, 0, 0}, 0}, .friction = 0}};
  scene.gravity.acceleration.setZero();
  scene.contact = impact.contact;
  scene.contact.friction = 0;
  scene.impact = impact.impact;
  scene.impact.at_once = 1;  // contact times are read as parts end
  scene.fracture.mode = impact.breaks ? FractureMode::all : FractureMode::off;
  return scene;
}

/// The quantities followed through the run.
struct Watch {
  Scales scales;
  double first_push = -1, last_push = -1;  ///< s
  double energy_at_start = 0;
  BarOutcome seen;
};

void watch_stress(Watch& watch, const Simulation& sim) {
  const MechanicsState& m = sim.state->mechanics;
  const auto see = [&](const Mat3& sigma, double& compression, double& tension) {
    compression = std::max(compression, -sigma(0, 0) / watch.scales.stress);
    tension = std::max(tension, principal_tension(sigma).value / watch.scales.strength);
  };
  for (const Mat3& sigma : m.elements.stress) {
    see(sigma, watch.seen.element_compression, watch.seen.element_tension);
  }
  std::vector<Mat3> node;
  average_node_stress(node,
                      {sim.state->cells.map.corners(), m.elements.stress, m.elements.rest_volume},
                      m.vertices.size());
  for (const Mat3& sigma : node) {
    see(sigma, watch.seen.node_compression, watch.seen.node_tension);
  }
}

void watch_part(Watch& watch, const Simulation& sim, const PartReport& part) {
  watch_stress(watch, sim);
  const double end = sim.state->mechanics.time;
  const double length = part.length;
  if (part.contact.impulse_of(0).norm() > 0.01 * watch.scales.stress * watch.scales.area * length) {
    if (watch.first_push < 0) watch.first_push = end - length;
    watch.last_push = end;
  }
  const double energy =
      kinetic_energy(sim.state->mechanics.vertices) + strain_energy(sim.state->mechanics);
  watch.seen.energy_end = energy / watch.energy_at_start;
  watch.seen.energy_peak = std::max(watch.seen.energy_peak, watch.seen.energy_end);
}

}  // namespace

BarOutcome run_bar(const BarImpact& impact) {
  const Scales scales = scales_of(impact);
  Result<Simulation> sim = build_simulation(scene_of(impact, scales));
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  Watch watch{.scales = scales, .seen = {}};
  watch.energy_at_start = kinetic_energy(sim->state->mechanics.vertices);
  const double h = sim->scene.integrator.time_step;
  const double wait = 3 * scales.travel() + 4 * h;
  const double give_up = 20 * scales.travel() + 40 * h;
  const StepObserver observe = [&](const Simulation& now, const PartReport& part) {
    watch_part(watch, now, part);
  };
  const VertexColumns& vertices = sim->state->mechanics.vertices;
  const double mass = scales.area * Material{}.density;
  for (double time = 0; time < give_up; time += h) {
    const StepReport report = advance(*sim, observe);
    if (report.status.outcome != StepOutcome::fine) break;
    watch.seen.broke = watch.seen.broke || !report.fracture.fans.empty();
    watch.seen.sub_steps += report.impact.sub_steps;
    watch.seen.rebound = momentum(vertices).x() / (mass * scales.speed);
    if (watch.seen.rebound > 0 && time > watch.last_push + wait) break;
  }
  watch.seen.contact_time = (watch.last_push - watch.first_push) / (2 * scales.travel());
  return watch.seen;
}

}  // namespace sunder::accuracy

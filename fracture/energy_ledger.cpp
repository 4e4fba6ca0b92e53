// SPDX-License-Identifier: MIT
// The energy ledger of a step.
#include "fracture/energy_ledger.hpp"

#include "mechanics/energy.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/living.hpp"
#include "mechanics/numerical_loss.hpp"

namespace sunder {
namespace {

void add_work(StepWork& work, double length) {
  const VertexColumns& vertices = work.sim.state.mechanics.vertices;
  const std::vector<Vec3>& before = work.sim.scratch.before.position;
  const bool is_loaded = !work.loads.force.empty();
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (!work.members().has(vertices.component[v])) continue;
    const Vec3 way = vertices.position[v] - before[v];
    work.report.energy.gravity += vertices.mass[v] * work.loads.gravity.dot(way);
    if (!is_loaded) continue;
    work.report.energy.loads += work.loads.force[v].dot(way);
    work.report.load_impulse += length * work.loads.force[v];
  }
}

/// Only generalised-alpha has a closed form that needs nothing but the rows.
bool has_closed_form(const StepInput& input) {
  return input.settings.integrator == Integrator::floating_frame &&
         (input.part.deformation == Deformation::whole ||
          input.part.deformation == Deformation::catch_up);
}

void add_numerical_loss(StepWork& work, const StepInput& input) {
  const MechanicsState& m = work.sim.state.mechanics;
  PartStart& before = work.sim.scratch.before;
  for_each_living(m, work.members(), [&](const Component& component) {
    const auto& system = work.sim.scratch.mechanics.systems[component.id.index()];
    if (component.isolated || component.rung != Rung::full || !system) return;
    IntegratorSettings settings = settings_of(input, m, component);
    settings.time_step = input.deformation_step();
    work.report.energy.numerical +=
        numerical_loss(before.work, *system, settings, {before.displacement, before.acceleration},
                       {m.vertices.displacement, m.vertices.displacement_acceleration});
  });
}

}  // namespace

void begin_part(StepWork& work) {
  const VertexColumns& vertices = work.sim.state.mechanics.vertices;
  PartStart& before = work.sim.scratch.before;
  before.position = vertices.position;
  before.displacement = vertices.displacement;
  before.acceleration = vertices.displacement_acceleration;
}

void end_part(StepWork& work, const StepInput& input) {
  add_work(work, input.settings.time_step);
  if (has_closed_form(input)) add_numerical_loss(work, input);
}

void close_ledger(StepWork& work, double kinetic, double strain) {
  const MechanicsState& m = work.sim.state.mechanics;
  EnergyLedger& ledger = work.report.energy;
  ledger.kinetic = kinetic_energy(m.vertices) - kinetic;
  ledger.strain = strain_energy(m) - strain;
  ledger.balance = ledger.kinetic + ledger.strain + ledger.numerical +
                   work.report.status.damping_work + work.report.energy_released - ledger.gravity -
                   ledger.loads;
}

}  // namespace sunder

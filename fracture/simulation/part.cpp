// SPDX-License-Identifier: MIT
// Loads, contact and mechanics of one part of a step.
#include "fracture/simulation/part.hpp"

#include <algorithm>
#include <optional>

#include "fracture/simulation/ledger/energy_ledger.hpp"
#include "fracture/simulation/ledger/force_report.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// Surface loads at `time` on the vertices as they are: rows may have come since the last part.
void update_forces(Loads& loads, const SimulationState& s, double time) {
  loads.force.clear();
  loads.turning.clear();
  if (s.loads.empty()) return;
  loads.force.assign(s.mechanics.vertices.size(), Vec3::Zero());
  loads.turning.assign(s.mechanics.vertices.size(), Vec3::Zero());
  add_corner_loads(loads, s.loads, s.mechanics, s.cells.map.corners(), time);
  for (const Component& component : s.mechanics.components) {
    if (component.rung != Rung::carried) continue;
    for (VertexId v : component.vertices) {
      loads.force[v.index()].setZero();
      loads.turning[v.index()].setZero();
    }
  }
}

/// Supports with a raised velocity go on at its mean over the part.
void raise_supports(StepReport& report, MechanicsState& m, const PartInput& part,
                    std::optional<HeldRegions>& regions) {
  const auto is_raised = [](const PrescribedMotion& motion) { return !motion.raised.empty(); };
  if (std::ranges::none_of(m.motions, is_raised)) return;
  sunder::raise_supports(m, m.time + part.plan.length);
  std::vector<Vec3> velocity;
  if (regions) velocity = m.vertices.velocity;
  for (const ComponentId id : living_components(m, part.members)) {
    const Component& component = m.components[id.index()];
    if (!component.supported || component.rung == Rung::carried) continue;
    const Impulse before = momentum_of(component);
    report.energy.supports += follow_supports(m, id);
    const Impulse given = momentum_of(component) - before;
    report.momentum.supports += given;
    if (regions) add_raised_forces(report.forces, *regions, m, {component, given, velocity});
  }
}

}  // namespace

ContactStepResult take_part(StepReport& report, SimulationState& s, const PartInput& part,
                            SimulationScratch& scratch) {
  IntegratorSettings settings = part.scene.integrator;
  settings.time_step = part.plan.length;
  scratch.loads.gravity = part.gravity;
  update_forces(scratch.loads, s, s.mechanics.time + part.plan.length);
  const StepInput input{.corners = s.cells.map.corners(),
                        .loads = scratch.loads,
                        .settings = settings,
                        .part = part.plan.part,
                        .members = part.members,
                        .neighbours = s.cells.map.neighbours(),
                        .measures_strain = part.scene.energy_ledger,
                        .threads = part.threads,
                        .ends = part.ends,
                        .hurry = part.hurry};
  std::optional<HeldRegions> regions;
  if (part.reports_forces) regions.emplace(part.scene, part.bodies);
  const double end = s.mechanics.time + part.plan.length;
  raise_supports(report, s.mechanics, part, regions);
  remember_start(scratch.before, s, part.scene.energy_ledger);
  ContactStepResult result =
      advance_with_contact({s.mechanics, s.obstacles, s.contact}, input, part.scene.contact,
                           {scratch.mechanics, scratch.contact});
  if (!result.adopted) return result;
  settings.time_step = result.length;
  const AdoptedPart adopted{s, input, result, scratch.before, part.scene.contact};
  support_impulses(scratch.supports, adopted);
  add_part_momentum(report.momentum, adopted, scratch.supports);
  if (regions) add_part_forces(report.forces, *regions, adopted, scratch.supports, end);
  add_part_energy(report, adopted, part.scene.energy_ledger);
  return result;
}

}  // namespace sunder

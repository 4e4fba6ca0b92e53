// SPDX-License-Identifier: MIT
// One step: mechanics with contact, then fracture, then the components that came of it.
#include <algorithm>

#include "fracture/simulation/energy_ledger.hpp"
#include "fracture/simulation/fan_clock.hpp"
#include "fracture/simulation/ladder.hpp"
#include "fracture/simulation/step_work.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/living.hpp"
#include "topology/kernel/sort_unique.hpp"

namespace sunder {
namespace {

/// The component that `id` was part of when the step began.
ComponentId ancestor(const Components& labels, ComponentId id, std::size_t components_before) {
  while (id.index() >= components_before) id = labels.parent[id.index()];
  return id;
}

/// Components that the fans of a step divided, and what came off them, ascending.
std::vector<ComponentId> touched_components(const Components& labels,
                                            const FractureReport& fracture,
                                            std::size_t components_before) {
  std::vector<ComponentId> touched;
  for (const FanEvent& fan : fracture.fans) {
    // Every row a fan split belongs to a component whose masses, at least, must be made anew.
    for (const FaceSplit& split : fan.faces) {
      touched.push_back(labels.of_tetrahedron[tetrahedron_of(split.face).index()]);
      touched.push_back(labels.of_tetrahedron[tetrahedron_of(split.opposite).index()]);
    }
  }
  for (std::size_t id = components_before; id < labels.size.size(); ++id) {
    touched.emplace_back(id);
    touched.push_back(ancestor(labels, ComponentId{id}, components_before));
  }
  sort_unique(touched);
  return touched;
}

/// Pieces inherit what their ancestor was to the step.
void inherit(StepWork& work, std::size_t before) {
  const Components& labels = work.sim.state->cells.labels;
  std::vector<double>& quiet = work.sim.state->impact.quiet;
  std::vector<char>& touched = work.sim.scratch->ladder.touched;
  const std::size_t count = labels.size.size();
  if (!work.components.empty()) work.components.resize(count);
  quiet.resize(count);
  touched.resize(count);
  for (std::size_t id = before; id < count; ++id) {
    const std::size_t old = ancestor(labels, ComponentId{id}, before).index();
    if (!work.components.empty()) work.components[id] = work.components[old];
    quiet[id] = quiet[old];
    touched[id] = touched[old];
  }
}

/// Brings mechanics and display up to date with what broke.
void rebuild_components(StepWork& work, const FractureReport& fracture) {
  Simulation& sim = work.sim;
  SimulationState& s = *sim.state;
  const std::size_t before = s.display.size();
  const auto touched = touched_components(s.cells.labels, fracture, before);
  open_cracks(s.cracks, {fracture.fans, s.fans, s.mechanics.time}, s.mechanics, s.cells);
  s.fans += fracture.fans.size();
  std::vector<Vec3> old_rest_centre;
  for (std::size_t id = 0; id < before; ++id) {
    old_rest_centre.push_back(s.mechanics.components[id].rest_centre);
  }
  s.mechanics.elements.component = s.cells.labels.of_tetrahedron;
  const RebuildReport rebuilt =
      rebuild(s.mechanics, s.cells.map.corners(), touched, sim.scratch->mechanics);
  work.report.energy_released += rebuilt.energy_released;
  work.report.energy.strain -= rebuilt.strain_released;

  s.display.resize(s.cells.labels.size.size());
  s.display_target.resize(s.display.size());
  // Fresh ids first: their display state comes from the parent's, which changes last.
  for (auto id = touched.rbegin(); id != touched.rend(); ++id) {
    const std::size_t old = ancestor(s.cells.labels, *id, before).index();
    const Vec3& centre = s.mechanics.components[id->index()].rest_centre;
    s.display[id->index()] = split_off(s.display[old], old_rest_centre[old], centre);
    s.display_target[id->index()] = split_off(s.display_target[old], old_rest_centre[old], centre);
  }
  inherit(work, before);
}

/// Adds the contact of a part to that of its step.
void add_contact(ContactReport& sum, const ContactReport& part) {
  sum.candidates = std::max(sum.candidates, part.candidates);
  sum.contacts = std::max(sum.contacts, part.contacts);
  sum.passes += part.passes;
  sum.iterations += part.iterations;
  if (part.residual - part.tolerated >= sum.residual - sum.tolerated) {
    sum.residual = part.residual;
    sum.tolerated = part.tolerated;
  }
  sum.converged = sum.converged && part.converged;
  sum.deepest = std::max(sum.deepest, part.deepest);
  sum.left_out += part.left_out;
  const std::size_t obstacles = std::max(sum.obstacle_impulse.size(), part.obstacle_impulse.size());
  sum.obstacle_impulse.resize(obstacles, Vec3::Zero());
  for (std::size_t k = 0; k < part.obstacle_impulse.size(); ++k) {
    sum.obstacle_impulse[k] += part.obstacle_impulse[k];
  }
}

/// The fans that the script has for the search at hand.
FractureReport make_scripted_fans(StepWork& work, FanClock& clock) {
  Simulation& sim = work.sim;
  const BreakableBody body{sim.state->cells, sim.state->mechanics};
  FractureReport made;
  if (!std::ranges::all_of(sim.state->mechanics.elements.stress,
                           [](const Mat3& stress) { return stress.allFinite(); })) {
    // The search fails on it and makes none; a script has nothing for it.
    return break_vertices(body, sim.scene.fracture, sim.scratch->fracture, work.members());
  }
  made.fans = make_fans(body, sim.scene.fracture, *sim.state->script,
                        {sim.state->step + 1, work.report.parts}, sim.scratch->fracture.components,
                        clock.watch());
  work.report.departed = sim.state->script->departure.has_value();
  return made;
}

/// Adds the fractures of a part to those of its step.
void add_fracture(StepReport& sum, FractureReport&& part) {
  FractureReport& all = sum.fracture;
  all.tested += part.tested;
  all.suspects += part.suspects;
  all.reached += part.reached;
  all.empty_fans += part.empty_fans;
  all.still_empty = part.still_empty;
  all.unfitted = std::max(all.unfitted, part.unfitted);
  all.refused_fans += part.refused_fans;
  all.relieved += part.relieved;
  all.waiting = part.waiting;
  all.not_a_number = part.not_a_number;
  for (FanEvent& fan : part.fans) {
    all.fans.push_back(std::move(fan));
    sum.fan_time.push_back(sum.time);
    sum.fan_part.push_back(sum.parts);
  }
}

/// Surface loads at `time` on the vertices as they are: rows may have come since the last part.
void update_forces(StepWork& work, double time) {
  if (work.sim.state->loads.empty()) return;
  const std::size_t count = work.sim.state->mechanics.vertices.size();
  work.loads.force.assign(count, Vec3::Zero());
  work.loads.turning.assign(count, Vec3::Zero());
  add_corner_loads(work.loads, work.sim.state->loads, work.sim.state->mechanics,
                   work.sim.state->cells.map.corners(), time);
}

/// Notes which components came off in the step that ends, and when.
void note_new_components(StepWork& work, std::size_t before) {
  SimulationState& s = *work.sim.state;
  const std::size_t count = s.cells.labels.size.size();
  s.birth_step.resize(before, 0);
  s.birth_step.resize(count, s.step);
  for (std::size_t id = before; id < count; ++id) work.report.new_components.emplace_back(id);
}

/// Section 3.3: what is drawn follows the frames smoothly.
void update_display(Simulation& sim) {
  SimulationState& s = *sim.state;
  for (const Component& c : s.mechanics.components) {
    const Pose target{c.centre, c.orientation};
    Pose& shown = s.display[c.id.index()];
    shown = approach(carry(shown, s.display_target[c.id.index()], target), target,
                     sim.scene.integrator.time_step, sim.scene.display_time_constant);
    s.display_target[c.id.index()] = target;
  }
}

}  // namespace

Vec3 gravity_at(const GravitySettings& gravity, double time) {
  if (gravity.ramp_time <= 0) return gravity.acceleration;
  return gravity.acceleration * std::min(1.0, time / gravity.ramp_time);
}

PartResult take_part(StepWork& work, const PartPlan& plan) {
  const StageTimer timer(work.report, Stage::mechanics);
  Simulation& sim = work.sim;
  SimulationState& s = *sim.state;
  IntegratorSettings settings = sim.scene.integrator;
  settings.time_step = plan.length;
  update_forces(work, s.mechanics.time + plan.length);
  begin_part(work);
  const StepInput input{s.cells.map.corners(), work.loads,     settings,
                        plan.part,             work.members(), sim.threads};
  ContactStepResult result =
      advance_with_contact({s.mechanics, s.obstacles, s.contact}, input, sim.scene.contact,
                           {sim.scratch->mechanics, sim.scratch->contact});
  if (!result.adopted) return {false, std::move(result.blows)};
  const double damping_work = work.report.status.damping_work + result.status.damping_work;
  add_solve(result.status.solve, work.report.status.solve);
  work.report.status = result.status;
  work.report.status.damping_work = damping_work;
  end_part(work, input);
  add_contact(work.report.contact, result.report);
  note_touches(work);
  work.report.time = s.mechanics.time;
  if (work.observe) work.observe(sim, {plan.part.deformation, plan.length, result.report});
  return {true, std::move(result.blows)};
}

void break_members(StepWork& work) {
  if (work.failed()) return;
  Simulation& sim = work.sim;
  FractureReport found;
  FanClock clock;
  {
    const StageTimer timer(work.report, Stage::fracture);
    FractureSettings settings = sim.scene.fracture;
    settings.max_fans -=
        std::min(settings.max_fans, static_cast<std::uint32_t>(work.report.fracture.fans.size()));
    found = sim.state->script
                ? make_scripted_fans(work, clock)
                : break_vertices({sim.state->cells, sim.state->mechanics}, settings,
                                 sim.scratch->fracture, work.members(), clock.watch());
  }
  for (const FanEvent& fan : found.fans) work.report.fan_us.push_back(clock.us(fan.vertex));
  if (!found.not_a_number && !found.fans.empty()) {
    const StageTimer timer(work.report, Stage::rebuild);
    rebuild_components(work, found);
  }
  add_fracture(work.report, std::move(found));
  ++work.report.parts;
}

StepReport advance(Simulation& sim, const StepObserver& observe) {
  SimulationState& s = *sim.state;
  StepWork work{sim, observe, {}, {}, {}, {}};
  std::swap(work.loads, sim.scratch->loads);
  const std::size_t components_before = s.cells.labels.size.size();
  const double kinetic = sim.scene.energy_ledger ? kinetic_energy(s.mechanics.vertices) : 0;
  sim.scratch->ladder.touched.assign(s.mechanics.components.size(), 0);
  work.loads.gravity =
      gravity_at(sim.scene.gravity, s.mechanics.time + sim.scene.integrator.time_step);
  s.impact.quiet.resize(s.mechanics.components.size(), ImpactWindow::closed);
  if (sim.scene.impact.window && sim.scene.integrator.integrator == Integrator::floating_frame) {
    advance_with_windows(work);
  } else if (sim.scene.integrator.integrator == Integrator::sub_stepped) {
    advance_sub_stepped(work);
  } else {
    take_part(work, {{}, sim.scene.integrator.time_step});
    break_members(work);
  }
  StepReport& report = work.report;
  report.step = ++s.step;
  note_new_components(work, components_before);
  report.time = s.mechanics.time;
  for_each_living(s.mechanics, {}, [&](const Component&) { ++report.components; });
  if (!work.failed()) choose_rungs(work);
  close_ledger(work, kinetic);
  if (!work.failed()) {
    const StageTimer timer(report, Stage::display);
    update_display(sim);
  }
  work.loads.force.clear();
  work.loads.turning.clear();
  std::swap(work.loads, sim.scratch->loads);
  return std::move(report);
}

}  // namespace sunder

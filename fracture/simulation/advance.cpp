// SPDX-License-Identifier: MIT
// One step: plan, part, break, rebuild, for every part of it; then rungs, ledger, display.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "fracture/breaking/break.hpp"
#include "fracture/breaking/fan_clock.hpp"
#include "fracture/simulation/attempt.hpp"
#include "fracture/simulation/changes/spring_load.hpp"
#include "fracture/simulation/ladder.hpp"
#include "fracture/simulation/ledger/energy_ledger.hpp"
#include "fracture/simulation/ledger/force_report.hpp"
#include "fracture/simulation/part.hpp"
#include "fracture/simulation/plan.hpp"
#include "fracture/simulation/plan_members.hpp"
#include "fracture/simulation/rebuild_pieces.hpp"
#include "fracture/simulation/rubble/rigid_pieces.hpp"
#include "fracture/simulation/rubble/rubble_tick.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/ties/release_ties.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

/// Adds the time until the end of its scope to a stage of the report.
class StageTimer {
 public:
  StageTimer(StepReport& report, Stage stage)
      : ms_(report.stage_ms[static_cast<std::size_t>(stage)]) {}
  ~StageTimer() {
    ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
               .count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& ms_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool has_failed(const StepReport& report) {
  return report.status.outcome != StepOutcome::fine || report.fracture.not_a_number.has_value() ||
         report.departed;
}

std::uint64_t budget_steps(const Scene& scene) {
  const double steps = std::round(scene.fracture.budget_time / scene.integrator.time_step);
  return std::max<std::uint64_t>(1, whole_number<std::uint64_t>(steps));
}

/// The settings with the budget that is left.
FractureSettings with_budget_left(const Scene& scene, const SimulationState& s) {
  FractureSettings settings = scene.fracture;
  if (settings.mode != FractureMode::budget) return settings;
  const auto less = [](std::uint32_t& left, std::uint64_t spent) {
    left -= static_cast<std::uint32_t>(std::min<std::uint64_t>(left, spent));
  };
  less(settings.max_fans, s.fans - s.fans_before);
  less(settings.max_new_pieces, s.cells.labels.size.size() - s.pieces_before);
  return settings;
}

/// Notes which components came off in the step that ends, and when; gives them.
std::vector<ComponentId> note_births(SimulationState& s, std::size_t before) {
  std::vector<ComponentId> born;
  s.birth_step.resize(before, 0);
  s.birth_step.resize(s.cells.labels.size.size(), s.step);
  for (std::size_t id = before; id < s.birth_step.size(); ++id) born.emplace_back(id);
  return born;
}

/// Adds the fractures of another part of the step, at `sum.time`.
void add_fracture(StepReport& sum, FractureReport&& part) {
  FractureReport& all = sum.fracture;
  add_part<SearchCounts>(all, part);
  all.not_a_number = part.not_a_number;
  for (FanEvent& fan : part.fans) {
    all.fans.push_back(std::move(fan));
    sum.fan_time.push_back(sum.time);
    sum.fan_part.push_back(sum.parts);
  }
  ++sum.parts;
}

/// The members of a part but those declared never to break; `rows` keeps them.
StepMembers breakable(const StepPlan& plan, const SimulationState& s, std::vector<char>& rows) {
  StepMembers members = plan.members();
  if (std::ranges::find(plan.declared, char{1}) == plan.declared.end()) return members;
  rows.assign(s.mechanics.components.size(), 0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k] = members.has(ComponentId{k}) && !(k < plan.declared.size() && plan.declared[k]);
  }
  members.component = rows;
  return members;
}

bool is_same(const Pose& a, const Pose& b) {
  return a.centre == b.centre && a.orientation.coeffs() == b.orientation.coeffs();
}

/// Section 3.3: drawn poses follow the frames smoothly.
void update_display(SimulationState& s, const Scene& scene) {
  for (const Component& c : s.mechanics.components) {
    const Pose target{c.centre, c.orientation};
    Pose& shown = s.display[c.id.index()];
    const Pose& last = s.display_target[c.id.index()];
    if (is_same(shown, target) && is_same(last, target)) continue;
    shown = approach(carry(shown, s.display_target[c.id.index()], target), target,
                     scene.integrator.time_step, scene.display_time_constant);
    s.display_target[c.id.index()] = target;
  }
}

/// One step at work.
struct StepWork {
  Simulation& sim;
  const StepObserver& observe;
  double kinetic;                 ///< J, as the step begins, where the ledger is kept
  std::size_t components_before;  ///< rows of components as the step begins
  StepReport report;
  StepPlan plan;
  double untested = 0;              ///< s since the last search for fractures
  std::vector<char> unbroken = {};  ///< rows of `breakable`

  const Scene& scene() const { return sim.scene; }
  SimulationState& state() const { return *sim.state; }
  SimulationScratch& scratch() const { return *sim.scratch; }
  BreakableBody body() const { return {state().cells, state().mechanics}; }
};

/// J; 0 where no ledger is kept.
double kinetic_now(const Simulation& sim) {
  const SimulationState& s = *sim.state;
  return sim.scene.energy_ledger && !all_rest(s) ? kinetic_energy(s.mechanics.vertices) : 0;
}

/// The budget of the step, the debris, which keeps its own time, and the plan.
StepWork begin_step(Simulation& sim, const StepObserver& observe) {
  SimulationState& s = *sim.state;
  StepReport report;
  if (sim.reports_forces) report.forces = no_forces(sim.scene);
  const std::size_t components = s.cells.labels.size.size();
  const double kinetic = kinetic_now(sim);
  sim.scratch->touched.assign(s.mechanics.components.size(), 0);
  if (s.step % budget_steps(sim.scene) == 0) {
    s.fans_before = s.fans;
    s.pieces_before = components;
  }
  begin_rubble(report, sim);
  StepPlan plan = plan_step(sim.scene, s, *sim.scratch);
  return {sim, observe, kinetic, components, std::move(report), std::move(plan)};
}

/// Sections 3.1 and 3.2: moves the members of a part. Gives the result of mechanics and contact;
/// not `adopted` where impacts lie ahead, or the part is taken back.
ContactStepResult move(StepWork& step, const PlannedPart& part) {
  const StageTimer timer(step.report, Stage::mechanics);
  Simulation& sim = step.sim;
  SimulationState& s = step.state();
  // One reference is kept without an allocation.
  const std::function<bool()> ends = [&step] {
    return any_breaks(step.body(), with_budget_left(step.scene(), step.state()),
                      step.scratch().fracture, breakable(step.plan, step.state(), step.unbroken));
  };
  const PartInput input{sim.scene,           sim.bodies,         part,
                        step.plan.members(), step.plan.gravity,  sim.threads,
                        sim.hurry,           sim.reports_forces, &ends};
  const std::optional<Attempt> attempt = begin_attempt(sim.scene, part, s, step.report);
  ContactStepResult taken = take_part(step.report, s, input, step.scratch());
  const bool fails = taken.status.outcome != StepOutcome::fine;
  if (attempt && taken.adopted && !fails) {
    take_back(*attempt, step.report, s, input, step.scratch().fracture, taken);
  }
  if (!taken.adopted) return taken;
  add_status(step.report.status, taken.status);
  add_contact(step.report.contact, taken.report);
  add_part(step.report.ties, taken.ties);
  note_touches(step.scratch().touched, s.mechanics, taken.contacts);
  step.report.time = s.mechanics.time;
  if (step.observe) step.observe(sim, {part.part.deformation, taken.length, taken.report});
  return taken;
}

/// Updates for new pieces: their energy, and rows copied from their ancestors in the step. Pieces
/// declared never to break become rigid.
void note_pieces(StepWork& step, const RebuildReport& rebuilt) {
  const auto& labels = step.state().cells.labels;
  step.report.energy_released += rebuilt.energy_released;
  step.report.energy.strain -= rebuilt.strain_released;
  step.plan.knows_strengths = false;
  inherit(step.scratch().touched, labels);
  inherit(step.plan.components, labels);
  inherit(step.plan.boundary.component, labels);
  harden_pieces(step.report, step.sim);
}

/// Mode `cohesive`: ties at their end let go, and pieces may come off.
void release_bonds(StepWork& step) {
  SimulationState& s = step.state();
  if (s.contact.ties.empty()) return;
  const StageTimer timer(step.report, Stage::rebuild);
  TieRelease released = release_ties(s.cells, s.contact, step.scene().fracture.detection,
                                     step.scratch().fracture.components);
  if (released.components.created > 0) {
    note_pieces(step, rebuild_released(s, step.scratch().mechanics));
  }
  if (released.faces.empty()) return;
  step.plan.knows_strengths = false;
  released.time = s.mechanics.time;
  released.part = step.report.parts;
  step.report.releases.push_back(std::move(released));
}

/// Algorithms 3 and 4: opens faces. Then masses and frames of the pieces.
void break_faces(StepWork& step) {
  SimulationState& s = step.state();
  FractureReport found;
  FanClock clock;
  {
    const StageTimer timer(step.report, Stage::fracture);
    found = break_members(step.body(), s.script, with_budget_left(step.scene(), s),
                          {s.step + 1, step.report.parts}, breakable(step.plan, s, step.unbroken),
                          step.scratch().fracture, step.untested, clock.watch());
  }
  step.untested = 0;
  step.report.departed = s.script && s.script->departure;
  for (const FanEvent& fan : found.fans) step.report.fan_us.push_back(clock.us(fan.vertex));
  if (!found.not_a_number && !found.fans.empty()) {
    const StageTimer timer(step.report, Stage::rebuild);
    note_pieces(step, rebuild_pieces(s, found.fans, step.scratch().mechanics));
    note_fans(step.plan, step.scene(), s, found.fans);
  }
  add_fracture(step.report, std::move(found));
}

/// The sums of the plan, in the report.
void note_plan(StepReport& report, const StepPlan& plan) {
  report.energy_released += plan.released;
  report.energy.gravity += plan.boundary.gravity_work;
  report.momentum.gravity += plan.boundary.gravity_impulse;
  report.impact = plan.impact;
  if (plan.phase == StepPlan::Phase::equal) report.status.solve.sub_steps = report.parts;
}

/// Activity levels of the next step, ledgers, and drawn poses (section 3.3).
StepReport finish_step(StepWork& step) {
  SimulationState& s = step.state();
  StepReport& report = step.report;
  end_boundary(step.plan.boundary, s);
  unstiffen_members(s);
  note_plan(report, step.plan);
  report.step = ++s.step;
  report.new_components = note_births(s, step.components_before);
  report.time = s.mechanics.time;
  for_each_living(s.mechanics, {}, [&](const Component&) { ++report.components; });
  if (!has_failed(report)) {
    GivenUp given_up;
    report.ladder =
        choose_rungs(given_up, s, {step.scene(), step.scratch().touched}, step.scratch().ladder);
    report.energy_released += given_up.energy;
    report.momentum.sleep -= given_up.momentum;
  }
  if (step.scene().energy_ledger) {
    close_ledger(report, step.kinetic, kinetic_now(step.sim));
  } else {
    report.energy = {};
  }
  if (!has_failed(report)) {
    const StageTimer timer(report, Stage::display);
    update_display(s, step.scene());
  }
  return std::move(report);
}

}  // namespace

StepReport advance(Simulation& sim, const StepObserver& observe) {
  const SpringLoad spring(sim);
  StepWork step = begin_step(sim, observe);
  while (const std::optional<PlannedPart> part = next_part(step.plan, sim.scene, *sim.state)) {
    step.plan.hurried = sim.hurry && *sim.hurry;
    const ContactStepResult taken = part->moves ? move(step, *part) : ContactStepResult{};
    note_part(step.plan, *part, taken, sim.scene, *sim.state);
    if (has_failed(step.report)) break;
    if (!taken.adopted) continue;
    step.untested += part->moves ? taken.length : part->length;
    release_bonds(step);
    if (part->breaks) break_faces(step);
    if (has_failed(step.report)) break;
  }
  return finish_step(step);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// One step: plan, part, break, rebuild, for every part of it; then rungs, ledger, display.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "fracture/breaking/break.hpp"
#include "fracture/breaking/fan_clock.hpp"
#include "fracture/simulation/attempt.hpp"
#include "fracture/simulation/ladder.hpp"
#include "fracture/simulation/ledger/energy_ledger.hpp"
#include "fracture/simulation/ledger/force_report.hpp"
#include "fracture/simulation/part.hpp"
#include "fracture/simulation/plan.hpp"
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

/// Updates for new pieces: their energy, and rows copied from their ancestors in the step. Pieces
/// declared never to break become rigid.
void note_pieces(StepReport& report, StepPlan& plan, std::vector<char>& touched,
                 const RebuildReport& rebuilt, Simulation& sim) {
  const SimulationState& s = *sim.state;
  report.energy_released += rebuilt.energy_released;
  report.energy.strain -= rebuilt.strain_released;
  plan.knows_strengths = false;
  inherit(touched, s.cells.labels);
  inherit(plan.components, s.cells.labels);
  inherit(plan.boundary.component, s.cells.labels);
  harden_pieces(report, sim);
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

}  // namespace

StepReport advance(Simulation& sim, const StepObserver& observe) {
  const Scene& scene = sim.scene;
  SimulationState& s = *sim.state;
  SimulationScratch& scratch = *sim.scratch;
  StepReport report;
  if (sim.reports_forces) report.forces = no_forces(scene);
  const std::size_t components_before = s.cells.labels.size.size();
  const auto kinetic_now = [&] {
    return scene.energy_ledger && !all_rest(s) ? kinetic_energy(s.mechanics.vertices) : 0;
  };
  const double kinetic = kinetic_now();
  std::vector<char>& touched = scratch.touched;
  touched.assign(s.mechanics.components.size(), 0);

  if (s.step % budget_steps(scene) == 0) {
    s.fans_before = s.fans;
    s.pieces_before = s.cells.labels.size.size();
  }
  begin_rubble(report, sim);
  StepPlan plan = plan_step(scene, s, scratch);
  double untested = 0;  // s
  std::vector<char> unbroken;  // rows of `breakable`
  const auto anything_breaks = [&] {
    return any_breaks({s.cells, s.mechanics}, with_budget_left(scene, s), scratch.fracture,
                      breakable(plan, s, unbroken));
  };
  const std::function<bool()> ends = std::ref(anything_breaks);
  while (const std::optional<PlannedPart> part = next_part(plan, scene, s)) {
    plan.hurried = sim.hurry && *sim.hurry;
    ContactStepResult taken;
    if (part->moves) {
      const StageTimer timer(report, Stage::mechanics);
      const PartInput input{scene,          sim.bodies,         *part,
                            plan.members(), plan.gravity,       sim.threads,
                            sim.hurry,      sim.reports_forces, &ends};
      const std::optional<Attempt> attempt = begin_attempt(scene, *part, s, report);
      taken = take_part(report, s, input, scratch);
      const bool fails = taken.status.outcome != StepOutcome::fine;
      if (attempt && taken.adopted && !fails)
        take_back(*attempt, report, s, input, scratch.fracture, taken);
      if (taken.adopted) {
        add_status(report.status, taken.status);
        add_contact(report.contact, taken.report);
        add_part(report.ties, taken.ties);
        note_touches(touched, s.mechanics, taken.contacts);
        report.time = s.mechanics.time;
        if (observe) observe(sim, {part->part.deformation, taken.length, taken.report});
      }
    }
    note_part(plan, *part, taken, scene, s);
    if (has_failed(report)) break;
    if (!taken.adopted) continue;
    if (!s.contact.ties.empty()) {
      const StageTimer timer(report, Stage::rebuild);
      TieRelease released = release_ties(s.cells, s.contact, scene.fracture.detection,
                                         scratch.fracture.components);
      if (released.components.created > 0)
        note_pieces(report, plan, touched, rebuild_released(s, scratch.mechanics), sim);
      if (!released.faces.empty()) {
        plan.knows_strengths = false;
        released.time = s.mechanics.time;
        released.part = report.parts;
        report.releases.push_back(std::move(released));
      }
    }
    untested += part->moves ? taken.length : part->length;
    if (!part->breaks) continue;

    FractureReport found;
    FanClock clock;
    {
      const StageTimer timer(report, Stage::fracture);
      found = break_members({s.cells, s.mechanics}, s.script, with_budget_left(scene, s),
                            {s.step + 1, report.parts}, breakable(plan, s, unbroken),
                            scratch.fracture, untested, clock.watch());
      untested = 0;
      report.departed = s.script && s.script->departure;
    }
    for (const FanEvent& fan : found.fans) report.fan_us.push_back(clock.us(fan.vertex));
    if (!found.not_a_number && !found.fans.empty()) {
      const StageTimer timer(report, Stage::rebuild);
      note_pieces(report, plan, touched, rebuild_pieces(s, found.fans, scratch.mechanics), sim);
      note_fans(plan, scene, s, found.fans);
    }
    add_fracture(report, std::move(found));
    if (has_failed(report)) break;
  }
  end_boundary(plan.boundary, s);
  report.energy_released += plan.released;
  report.energy.gravity += plan.boundary.gravity_work;
  report.momentum.gravity += plan.boundary.gravity_impulse;
  report.impact = plan.impact;
  if (plan.phase == StepPlan::Phase::equal) report.status.solve.sub_steps = plan.parts;

  report.step = ++s.step;
  report.new_components = note_births(s, components_before);
  report.time = s.mechanics.time;
  for_each_living(s.mechanics, {}, [&](const Component&) { ++report.components; });
  if (!has_failed(report)) {
    GivenUp given_up;
    report.ladder = choose_rungs(given_up, s, {scene, touched}, scratch.ladder);
    report.energy_released += given_up.energy;
    report.momentum.sleep -= given_up.momentum;
  }
  if (scene.energy_ledger) {
    close_ledger(report, kinetic, kinetic_now());
  } else {
    report.energy = {};
  }
  if (!has_failed(report)) {
    const StageTimer timer(report, Stage::display);
    update_display(s, scene);
  }
  return report;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Impact windows: which components are stepped finely, from when, until when; and the other plans.
#include "fracture/simulation/plan.hpp"

#include <algorithm>
#include <cmath>

#include "fracture/simulation/integrator_bounds.hpp"
#include "fracture/simulation/plan_members.hpp"
#include "mechanics/baselines/verlet.hpp"
#include "mechanics/contact/impact/impact_energy.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

/// L/c for which a window stays open after its component last felt a blow: the waves of the last
/// push go to the far end and come back once.
constexpr double waves_stay = 2;

/// Sub-steps of a step at most that struck components are taken through whole, with no way ahead of
/// the blow and none after the last window.
constexpr double most_throughout = 32;

/// Parts of a step at most in which pieces would pass each other in longer ones.

bool has_windows(const Scene& scene) {
  return scene.impact.window && scene.integrator.integrator == Integrator::floating_frame &&
         scene.contact.method == ContactMethod::impulses;
}

/// Whether pieces that came off deform in windows alone.
bool stiffens_all(const Scene& scene) {
  return has_windows(scene) && scene.ladder.rubble == RubbleMode::until_struck;
}

bool is_open(const ImpactWindow& window, std::size_t component) {
  return window.quiet[component] != ImpactWindow::closed;
}

/// Opens windows for struck components. The first one decides the sub-step: the step over a power
/// of two. So runs with steps that differ by such a power take the same sub-steps. Ties may demand
/// a shorter one later. During the members' step, the number of sub-steps left is counted again.
void open(StepPlan& plan, ImpactWindow& window, const Blows& blows, const Scene& scene) {
  const double time_step = scene.integrator.time_step;
  const bool refines = scene.fracture.crack == CrackMode::cohesive;
  // No computer takes more sub-steps than that; their count stays exact.
  constexpr int most_halvings = 40;
  double sub_step = time_step;
  for (int k = 0; k < most_halvings && sub_step > blows.sub_step; ++k) sub_step /= 2;
  if (open_windows(window).empty() || (refines && sub_step < window.sub_step)) {
    if (plan.phase == StepPlan::Phase::members) {
      sub_step = std::min(sub_step, window.sub_step);
      plan.left *= whole_number<std::uint64_t>(std::round(window.sub_step / sub_step));
    }
    window.sub_step = sub_step;
  }
  for (ComponentId id : blows.struck) {
    plan.impact.opened += !is_open(window, id.index());
    window.quiet[id.index()] = 0;
  }
}

/// Where cracks take energy, not every peak of a wave front decides: a third of the viscosity that
/// bare strengths need, which cost rings a tenth of their fragments (docs/lab/accuracy.md).
double wave_viscosity(const Scene& scene) {
  return scene.fracture.crack == CrackMode::cohesive ? 0.1 : StepPart{}.viscosity;
}

double time_left(const StepPlan& plan, const SimulationState& s) {
  return static_cast<double>(plan.left) * s.impact.sub_step;
}

/// Carried components for which windows have opened are members from here on.
void release_struck(StepPlan& plan, SimulationState& s) {
  const double left = time_left(plan, s);
  for (ComponentId id : open_windows(s.impact)) {
    release(plan.boundary, s, id, plan.gravity, left);
  }
}

/// How many sub-steps the members go on with frozen deformations: to the one in which the first
/// blow falls.
std::uint64_t sub_steps_before(double blow, std::uint64_t left, double sub_step) {
  const double most = static_cast<double>(left - 1);
  return whole_number<std::uint64_t>(std::clamp(std::floor(blow / sub_step), 0.0, most));
}

/// Driven obstacles where they are as the step ends.
void move_obstacles(const Scene& scene, std::vector<Obstacle>& obstacles) {
  for (Obstacle& obstacle : obstacles) {
    if (!obstacle.mass) translate(obstacle.shape, scene.integrator.time_step * obstacle.velocity);
  }
}

/// Driven obstacles where they were when the step began.
void put_back_obstacles(const StepPlan& plan, std::vector<Obstacle>& obstacles) {
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (!plan.obstacles[k].mass) obstacles[k] = plan.obstacles[k];
  }
}

void begin_others(StepPlan& plan, const SimulationState& s) {
  plan.phase = StepPlan::Phase::others;
  plan.obstacles = s.obstacles;
}

PlannedPart next_of_others(StepPlan& plan, const StepPart& whole, const Scene& scene,
                           SimulationState& s) {
  const bool moves = take_the_others(plan, s);
  if (stiffens_all(scene)) stiffen_members(plan, s);
  return {.part = whole, .length = scene.integrator.time_step, .moves = moves};
}

/// The others have taken the step; now the members take it. Steps that are no longer than the
/// minimal length of a window are sub-stepped whole. To freeze moving components for a part of them
/// would cost more accuracy than it saves.
void begin_members(StepPlan& plan, const Scene& scene, SimulationState& s) {
  put_back_obstacles(plan, s.obstacles);
  begin_boundary(plan.boundary, s, plan.gravity, scene.integrator.time_step);
  take_the_members(plan, s);
  s.mechanics.time = plan.start;
  const double count = std::round(scene.integrator.time_step / s.impact.sub_step);
  plan.throughout = count <= most_throughout;
  plan.left = whole_number<std::uint64_t>(count);
  if (plan.throughout) {
    // Quiet begins with the blow, which lies ahead.
    for (double& quiet : s.impact.quiet) quiet = quiet == 0 ? -plan.blow : quiet;
  }
  if (!plan.throughout) plan.still = sub_steps_before(plan.blow, plan.left, s.impact.sub_step);
}

/// How many sub-steps are taken at once, and for how long their contacts serve.
void plan_waves(StepPart& wave, StepPlan& plan, const Scene& scene, SimulationState& s) {
  stiffen_members(plan, s);
  if (plan.served == 0) {
    plan.served = sub_steps_of_contacts(plan, s, time_left(plan, s));
    wave.contacts_for = static_cast<double>(plan.served) * s.impact.sub_step;
  }
  const std::uint32_t most = scene.impact.max_sub_steps - plan.impact.sub_steps;
  wave.sub_steps = static_cast<std::uint32_t>(
      std::min<std::uint64_t>({plan.together, plan.served, plan.left, most}));
}

PlannedPart next_of_members(StepPlan& plan, const Scene& scene, SimulationState& s) {
  const double sub_step = s.impact.sub_step;
  // A tenth of a depth that is never pushed out.
  spread_boundary(plan.boundary, s, plan.gravity, time_left(plan, s), plan.reach,
                  0.1 * scene.contact.allowed_penetration);
  const std::vector<char> before = plan.components;
  take_the_members(plan, s);
  // A new member may meet others at once.
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (plan.components[k] && !before[k]) plan.served = 0;
  }
  if (plan.still > 0) {
    return {.part = {Deformation::frozen, scene.integrator.time_step, &scene.impact, plan.strength,
                     plan.threshold},
            .length = static_cast<double>(plan.still) * sub_step,
            .breaks = false};
  }
  plan.impact.stopped = plan.impact.sub_steps >= scene.impact.max_sub_steps;
  const bool fine = plan.throughout || !open_windows(s.impact).empty();
  const bool at_once = plan.impact.stopped || plan.hurried;
  if (fine && !at_once) {
    StepPart wave{Deformation::wave,    0, &scene.impact, plan.strength, plan.threshold,
                  wave_viscosity(scene)};
    plan_waves(wave, plan, scene, s);
    return {wave, wave.sub_steps * sub_step};
  }
  if (!stiffens_all(scene)) unstiffen_members(s);
  // The rest of the step at once, or the way to the next blow.
  const ImpactSettings* impact = at_once ? nullptr : &scene.impact;
  return {
      {Deformation::catch_up, scene.integrator.time_step, impact, plan.strength, plan.threshold},
      static_cast<double>(plan.left) * sub_step};
}

/// A part of an explicit integrator has the length that is stable, that of a divided step may grow.
void note_equal(StepPlan& plan) {
  if (plan.divides) return take_part(plan.division);
  ++plan.division.taken;
}

/// How many components were struck without the energy to break.
void count_spared(ImpactReport& report, const Blows& blows) {
  report.spared_by_pair += static_cast<std::uint32_t>(blows.spared_by_pair.size());
  report.spared_by_island += static_cast<std::uint32_t>(blows.spared_by_island.size());
}

/// Whether all that is in a component is too little to break it.
bool has_calmed(const StepPlan& plan, const SimulationState& s, const Component& component) {
  return !plan.threshold.empty() &&
         !deforms_by(s.mechanics, component, plan.threshold[component.id.index()]);
}

/// After sub-steps: windows close once their waves have died away, and struck components open
/// theirs.
void note_sub_steps(StepPlan& plan, std::uint32_t count, const Blows& blows, SimulationState& s) {
  const double length = count * s.impact.sub_step;
  plan.impact.sub_steps += count;
  plan.impact.time += length;
  plan.impact.coarseness = std::max(plan.impact.coarseness, s.impact.sub_step / blows.sub_step);
  for (const Component& c : s.mechanics.components) {
    double& quiet = s.impact.quiet[c.id.index()];
    if (quiet == ImpactWindow::closed) continue;
    quiet += length;
    if (std::ranges::binary_search(blows.struck, c.id)) continue;
    const bool over = c.tetrahedra.empty() || quiet > waves_stay * extent_travel(s.mechanics, c);
    if (!over && !(quiet > 0 && has_calmed(plan, s, c))) continue;
    quiet = ImpactWindow::closed;
    ++(over ? plan.impact.closed_by_time : plan.impact.closed_by_energy);
  }
  for (ComponentId id : blows.struck) {
    plan.impact.opened += !is_open(s.impact, id.index());
    s.impact.quiet[id.index()] = 0;
  }
}

/// Parts of waves are twice as long as the one before, unless that ended early. Supports
/// that are raised have one velocity in a part: then each has one sub-step.
void note_length(StepPlan& plan, const PlannedPart& part, const ContactStepResult& result,
                 const Scene& scene, const MechanicsState& m) {
  const bool is_raised = std::ranges::any_of(
      m.motions, [](const PrescribedMotion& motion) { return !motion.raised.empty(); });
  const std::uint32_t most = is_raised ? 1 : scene.impact.at_once;
  const bool is_whole = result.sub_steps == part.part.sub_steps;
  plan.together = is_whole ? std::min(most, 2 * result.sub_steps) : result.sub_steps;
}

void note_members(StepPlan& plan, const PlannedPart& part, const ContactStepResult& result,
                  const Scene& scene, SimulationState& s) {
  switch (part.part.deformation) {
    case Deformation::frozen:
      plan.left -= plan.still;
      plan.still = 0;
      return;
    case Deformation::wave:
      note_sub_steps(plan, result.sub_steps, result.blows, s);
      plan.left -= result.sub_steps;
      plan.served -= std::min<std::uint64_t>(plan.served, result.sub_steps);
      note_length(plan, part, result, scene, s.mechanics);
      return;
    default:
      if (result.adopted) {
        plan.left = 0;
      } else {
        open(plan, s.impact, result.blows, scene);
        plan.still = sub_steps_before(result.blows.time, plan.left, s.impact.sub_step);
      }
  }
}

/// Ends the members' step: all bodies are at the same time again.
void finish_members(StepPlan& plan, const Scene& scene, SimulationState& s) {
  end_boundary(plan.boundary, s);
  if (plan.impact.stopped) std::ranges::fill(s.impact.quiet, ImpactWindow::closed);
  put_back_obstacles(plan, s.obstacles);
  move_obstacles(scene, s.obstacles);
}

}  // namespace

Blows struck_by_cracks(std::vector<ComponentId> components, const MechanicsState& m) {
  Blows cracked;
  for (const ComponentId id : components) {
    const Component& c = m.components[id.index()];
    if (c.rigid) continue;
    cracked.struck.push_back(id);
    cracked.sub_step = std::min(cracked.sub_step, c.cell_travel);
  }
  return cracked;
}

StepPlan plan_step(const Scene& scene, SimulationState& s, SimulationScratch& scratch) {
  StepPlan plan{.strength = scratch.strength,
                .threshold = scratch.threshold,
                .break_energy = scratch.break_energy,
                .declared = scratch.rubble.declared};
  plan.start = s.mechanics.time;
  plan.gravity = gravity_at(scene.gravity, s.mechanics.time + scene.integrator.time_step);
  s.impact.quiet.resize(s.mechanics.components.size(), ImpactWindow::closed);
  begin_without_rubble(plan, s);
  if (scene.integrator.integrator == Integrator::sub_stepped) {
    plan.phase = StepPlan::Phase::equal;
    plan.division.parts =
        sub_step_count(scene.integrator.time_step,
                       least_step_bound(scratch.mechanics, s.mechanics, scene.integrator.damping));
  } else if (has_windows(scene)) {
    if (!open_windows(s.impact).empty()) begin_others(plan, s);
  }
  return plan;
}

std::optional<PlannedPart> next_part(StepPlan& plan, const Scene& scene, SimulationState& s) {
  using Phase = StepPlan::Phase;
  const double h = scene.integrator.time_step;
  const bool goes_on = plan.phase != Phase::whole_done && plan.phase != Phase::equal;
  if (has_windows(scene) && goes_on && !plan.knows_strengths && anybody_moves(plan, s)) {
    note_strengths(plan, scene, s);
  }
  // Explicit parts cannot be longer; all bodies are at the same time, so the step may end here.
  if (plan.hurried && plan.phase == Phase::equal) return std::nullopt;
  const StepPart whole{Deformation::whole, 0, has_windows(scene) ? &scene.impact : nullptr,
                       plan.strength, plan.threshold};
  if (plan.phase == Phase::others_done) {
    begin_members(plan, scene, s);
    plan.phase = Phase::members;
  }
  const bool is_through =
      (plan.phase == Phase::equal && plan.division.taken == plan.division.parts) ||
      (plan.phase == Phase::members && plan.left == 0);
  if (is_through) {
    if (plan.phase == Phase::members) finish_members(plan, scene, s);
    s.mechanics.time = plan.start + h;
    return std::nullopt;
  }
  switch (plan.phase) {
    case Phase::whole: {
      if (stiffens_all(scene)) stiffen_members(plan, s);
      StepPart undivided = whole;
      undivided.divides = is_floating(scene.integrator.integrator);
      return anybody_moves(plan, s)
                 ? PlannedPart{undivided, h}
                 : PlannedPart{.part = whole, .length = h, .moves = false, .breaks = false};
    }
    case Phase::equal: {
      StepPart part;
      part.divides = plan.divides && plan.division.may_divide();
      return PlannedPart{part, h / plan.division.parts};
    }
    case Phase::others:
      gather_members(plan, s, h);
      return next_of_others(plan, whole, scene, s);
    case Phase::members:
      return next_of_members(plan, scene, s);
    case Phase::others_done:
    case Phase::whole_done:
      break;
  }
  return std::nullopt;
}

void note_part(StepPlan& plan, const PlannedPart& part, const ContactStepResult& result,
               const Scene& scene, SimulationState& s) {
  using Phase = StepPlan::Phase;
  if (result.passing_way > 0) {
    plan.phase = Phase::equal;
    plan.divides = true;
    return divide(plan.division, result.passing_way);
  }
  if (plan.phase == Phase::equal) note_equal(plan);
  count_spared(plan.impact, result.blows);
  if (result.trace) {
    plan.impact.scaled_cells = std::max(plan.impact.scaled_cells, result.trace->scaled_cells);
  }
  if (plan.phase == Phase::members) {
    if (result.adopted) note_pushed(plan.boundary, s.mechanics, result.contacts);
    note_members(plan, part, result, scene, s);
    return release_struck(plan, s);
  }
  if (result.adopted) {
    if (plan.phase == Phase::whole && !part.moves) {
      // No part has moved them.
      move_obstacles(scene, s.obstacles);
      s.mechanics.time = plan.start + scene.integrator.time_step;
    }
    if (plan.phase == Phase::whole) plan.phase = Phase::whole_done;
    if (plan.phase == Phase::others) plan.phase = Phase::others_done;
    return;
  }
  // The others go first, as long as no blow makes members of them.
  open(plan, s.impact, result.blows, scene);
  plan.blow =
      plan.phase == Phase::whole ? result.blows.time : std::min(plan.blow, result.blows.time);
  if (plan.phase == Phase::whole) begin_others(plan, s);
}

void note_fans(StepPlan& plan, const Scene& scene, SimulationState& s,
               std::span<const FanEvent> fans) {
  if (!has_windows(scene) || scene.fracture.crack == CrackMode::paper) return;
  s.impact.quiet.resize(s.mechanics.components.size(), ImpactWindow::closed);
  const Blows cracked = struck_by_cracks(cracked_by(fans, s.mechanics), s.mechanics);
  if (!cracked.struck.empty()) open(plan, s.impact, cracked, scene);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Who takes the part of a step that comes next.
#pragma once

#include "fracture/simulation/step_plan.hpp"

namespace sunder {

/// The components whose windows are open, ascending.
std::vector<ComponentId> open_windows(const ImpactWindow& window);

/// Makes members of those with open windows and of what they touch, and rigid bodies of what is
/// round those.
void gather_members(StepPlan& plan, const SimulationState& state, double time_step);

/// Everybody but the rubble takes the part.
void begin_without_rubble(StepPlan& plan, const SimulationState& state);

/// Whether a member of the part to come could move.
bool anybody_moves(const StepPlan& plan, const SimulationState& state);

/// All but the members, for the whole step. True when there are any that could move.
bool take_the_others(StepPlan& plan, const SimulationState& state);

/// The members, and the carried among which they are.
void take_the_members(StepPlan& plan, const SimulationState& state);

/// The strengths and energies at which components break, as the part to come begins: pieces that came
/// off take their vertices' with them.
void note_strengths(StepPlan& plan, const Scene& scene, const SimulationState& state);

/// m/s: the largest speed of a member's vertex against the affine field that fits the members'
/// vertices, or of an obstacle against their mean.
double fastest_member(const StepPlan& plan, const SimulationState& state);

/// Pieces that came off some body and that no blow has struck, nor a crack: they move as rigid
/// bodies in explicit steps (`Rung::stiff`), and deform again once their windows open. Supported
/// and tied pieces, and bodies that are still whole, deform always.
void stiffen_members(StepPlan& plan, SimulationState& state);

/// All of them deform from here on.
void unstiffen_members(SimulationState& state);

}  // namespace sunder

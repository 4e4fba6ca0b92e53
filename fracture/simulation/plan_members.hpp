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

/// m/s: the larger of two speeds. One vertex in a hundred of the members exceeds the first, against the
/// affine field that fits their vertices. The fastest obstacle has the second, against their mean.
double speed_among_members(const StepPlan& plan, const SimulationState& state);

/// Makes rigid bodies (`Rung::stiff`) of members that came off a body and have no open window. They
/// deform again once their windows open. Supported and tied pieces, and whole bodies, deform always.
void stiffen_members(StepPlan& plan, SimulationState& state);

/// Members that were stiff deform from here on.
void unstiffen_members(SimulationState& state);

}  // namespace sunder

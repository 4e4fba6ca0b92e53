// SPDX-License-Identifier: MIT
// The members of the next part of a step.
#pragma once

#include "fracture/simulation/step_plan.hpp"

namespace sunder {

/// The components whose windows are open, ascending.
std::vector<ComponentId> open_windows(const ImpactWindow& window);

/// Makes members of components with open windows and of bodies that they touch, and rigid bodies of
/// the bodies round those.
void gather_members(StepPlan& plan, const SimulationState& state, double time_step);

/// All bodies except the rubble take the part.
void begin_without_rubble(StepPlan& plan, const SimulationState& state);

/// Whether a member of the part to come could move.
bool anybody_moves(const StepPlan& plan, const SimulationState& state);

/// All but the members, for the whole step. True when there are any that could move.
bool take_the_others(StepPlan& plan, const SimulationState& state);

/// The members, and the carried among which they are.
void take_the_members(StepPlan& plan, const SimulationState& state);

/// The strengths and energies at which components break, as the part to come begins: pieces that
/// came off take their vertices' with them.
void note_strengths(StepPlan& plan, const Scene& scene, const SimulationState& state);

/// Components that fans have cracked, ascending, none twice.
std::vector<ComponentId> cracked_by(std::span<const FanEvent> fans,
                                    const MechanicsState& mechanics);

/// For how many sub-steps contacts are found at once, with `left` s to go: members move against
/// each other by a tenth of the smallest mean cell in them, and the step does not end before.
std::uint64_t sub_steps_of_contacts(const StepPlan& plan, const SimulationState& state,
                                    double left);

/// Makes rigid bodies (`Rung::stiff`) of members that came off a body and have no open window. They
/// deform again once their windows open. Supported and tied pieces, and whole bodies, deform
/// always.
void stiffen_members(StepPlan& plan, SimulationState& state);

/// Members that were stiff deform from here on.
void unstiffen_members(SimulationState& state);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// In which parts a step is taken: whole, in equal sub-steps, or through impact windows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fracture/simulation/part.hpp"
#include "fracture/simulation/step_plan.hpp"

namespace sunder {

/// The plan of a step from the state as it is. With impact windows a part may be refused for blows
/// that lie ahead; windows open, and the plan goes on from there
/// (docs/explanation/time_and_contact.md).
StepPlan plan_step(const Scene& scene, SimulationState& state, SimulationScratch& scratch);

/// The next part; nothing when the step is through. Times and driven obstacles go back to where the
/// part begins; windows close where the limit on sub-steps is reached.
std::optional<PlannedPart> next_part(StepPlan& plan, const Scene& scene, SimulationState& state);

/// Reports the result of its last part to the plan: windows open, stay or close.
void note_part(StepPlan& plan, const PlannedPart& part, const ContactStepResult& result,
               const Scene& scene, SimulationState& state);

/// Components in which cracks run, ascending, none twice, as components struck by a blow.
Blows struck_by_cracks(std::vector<ComponentId> components, const MechanicsState& mechanics);

/// Opens windows for components that fans have just cracked, after `rebuild_pieces`
/// (`CrackMode::object`). A crack runs on with the waves. A step with a load that grows meanwhile
/// would break vertices that the crack relieves.
void note_fans(StepPlan& plan, const Scene& scene, SimulationState& s,
               std::span<const FanEvent> fans);

}  // namespace sunder

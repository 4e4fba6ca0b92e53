// SPDX-License-Identifier: MIT
// A part of a step that may be taken back: with ties a crack must not run in one long step.
#pragma once

#include <optional>
#include <vector>

#include "fracture/simulation/part.hpp"

namespace sunder {

/// What a part changes, as it was before.
struct Attempt {
  VertexColumns vertices;
  std::vector<Component> components;
  std::vector<Mat3> stress;
  std::vector<std::array<Mat3, 4>> corner_stress;
  double time = 0;
  std::vector<Obstacle> obstacles;
  ContactMemory contact;
  StepReport report;
};

/// The state before a part that may have to be taken back: one of `CrackMode::cohesive` that is
/// longer than a sub-step; nothing for others.
std::optional<Attempt> begin_attempt(const Scene& scene, const PlannedPart& part,
                                     const SimulationState& state, const StepReport& report);

/// Whether the part let a tie open by more than a hundredth of what ends it, or overloaded a vertex
/// by more than a tenth, in a component that is not rigid. If so all is put back, and `taken` is a
/// part that was not adopted, with the components concerned as struck at its start: their windows
/// open, and cracks grow in sub-steps that resolve their waves, whatever the scene's step.
bool take_back(const Attempt& attempt, StepReport& report, SimulationState& state,
               const PartInput& input, FractureScratch& scratch, ContactStepResult& taken);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// A part of a step that may be taken back: with ties a crack must not run in one long step.
#pragma once

#include <optional>
#include <vector>

#include "fracture/simulation/part.hpp"

namespace sunder {

/// The state that a part changes, as it was before.
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

/// Whether the part opened a tie by more than a hundredth of its final opening, or overloaded a
/// vertex by more than a tenth. Rigid components do not count. If so, the state before the part is
/// put back, and `taken` is a part that was not adopted. The components concerned count as struck
/// at its start. Their windows open, and cracks grow in sub-steps that resolve their waves, for any
/// step of the scene.
bool take_back(const Attempt& attempt, StepReport& report, SimulationState& state,
               const PartInput& input, FractureScratch& scratch, ContactStepResult& taken);

}  // namespace sunder

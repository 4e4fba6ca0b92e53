// SPDX-License-Identifier: MIT
// One part of a step: contact and mechanics, and where the energy of it went.
#pragma once

#include <functional>
#include <span>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/state.hpp"
#include "fracture/simulation/step_report.hpp"

namespace sunder {

/// Which part of a step comes next.
struct PlannedPart {
  StepPart part;
  double length = 0;   ///< s
  bool moves = true;   ///< false: it has no member that could move
  bool breaks = true;  ///< whether fractures are looked for at its end
};

/// Inputs to a part, in addition to the state.
struct PartInput {
  const Scene& scene;
  std::span<const BodyRows> bodies;
  PlannedPart plan;
  StepMembers members;
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  unsigned threads = 1;
  const std::atomic<bool>* hurry = nullptr;     ///< `Simulation::hurry`
  bool reports_forces = false;                  ///< `Simulation::reports_forces`
  const std::function<bool()>* ends = nullptr;  ///< `StepInput::ends`
};

/// Takes one part of a step for its members: surface loads at its end, contact, mechanics. Its
/// energies and the impulses of loads are added to `report.energy`, `report.momentum`,
/// `report.forces` and `report.cracks`; the rest is returned. Where there are blows ahead that the
/// part must not run into, nothing is done (`ContactStepResult::adopted`).
ContactStepResult take_part(StepReport& report, SimulationState& state, const PartInput& input,
                            SimulationScratch& scratch);

}  // namespace sunder

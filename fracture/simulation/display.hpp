// SPDX-License-Identifier: MIT
// Where components are drawn after a step (section 3.3 of the paper).
#pragma once

#include "fracture/simulation/scene.hpp"
#include "fracture/simulation/state.hpp"

namespace sunder {

/// Lets what is drawn follow the frames of the components smoothly over one step.
void update_display(SimulationState& state, const Scene& scene);

}  // namespace sunder

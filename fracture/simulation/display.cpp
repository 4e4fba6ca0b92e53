// SPDX-License-Identifier: MIT
// Display states of all components, one step on.
#include "fracture/simulation/display.hpp"

namespace sunder {

void update_display(SimulationState& s, const Scene& scene) {
  for (const Component& c : s.mechanics.components) {
    const Pose target{c.centre, c.orientation};
    Pose& shown = s.display[c.id.index()];
    shown = approach(carry(shown, s.display_target[c.id.index()], target), target,
                     scene.integrator.time_step, scene.display_time_constant);
    s.display_target[c.id.index()] = target;
  }
}

}  // namespace sunder

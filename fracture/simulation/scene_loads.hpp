// SPDX-License-Identifier: MIT
// From the load boxes of a scene's bodies to loads on corners.
#pragma once

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Makes `sim.state->loads` of every `loads` entry of every body. Needs: map, columns and components at
/// rest, nothing split. Errors: "no_load" for an entry with neither pressure nor force,
/// "nothing_loaded" for one whose box holds no boundary face (pressure) or no vertex (force).
std::vector<Finding> make_scene_loads(Simulation& sim);

}  // namespace sunder

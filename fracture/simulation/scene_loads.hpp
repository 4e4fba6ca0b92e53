// SPDX-License-Identifier: MIT
// From the load boxes of a scene's bodies to loads on corners.
#pragma once

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Makes `sim.state->loads` of every `loads` entry of every body. Needs: map, columns and
/// components at rest, nothing split, settings without errors. Error nothing_loaded: the box of a
/// pressure holds no whole boundary face.
std::vector<Finding> make_scene_loads(Simulation& sim);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Rows of a state leave it, or those of another state are appended to it.
#pragma once

#include "fracture/simulation/changes/renumber.hpp"

namespace sunder {

/// Appends the rows of `more`, a state at its start without nodes in the middles of edges in
/// `state`: new rows of every kind behind the old ones, which keep their numbers. Obstacles, time
/// and counts of steps and fans stay those of `state`. O(both states).
void append_state(SimulationState& state, SimulationState more);

/// Drops the tetrahedra of those components with all that belongs to them. Rows of vertices,
/// tetrahedra and points close up in their order. Rows of components, materials, motions and cracks
/// stay, without content. `points`: 1 for a point of the mesh that stays. Gives the new row
/// numbers. O(state).
Renumbering drop_components(SimulationState& state, const std::vector<char>& dropped,
                            std::vector<char> points);

}  // namespace sunder

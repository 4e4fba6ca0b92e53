// SPDX-License-Identifier: MIT
// Components far over their thresholds, before anything is split.
#pragma once

#include <vector>

#include "fracture/breaking/break_vertices.hpp"

namespace sunder {

/// Components of `members` with a vertex that would break now at more than `most` times its
/// threshold, ascending. Vertices that a long step has brought so far would have broken one after
/// the other. Vertices that wait, at a flank or with an empty fan, are left out. Leaves the node
/// stresses in the scratch. O(|T|).
std::vector<ComponentId> overloaded_components(BreakableBody body, const FractureSettings& settings,
                                               FractureScratch& scratch, const StepMembers& members,
                                               double most);

}  // namespace sunder

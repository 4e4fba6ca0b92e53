// SPDX-License-Identifier: MIT
// Many small patches between two bodies to few. For the sources of this room only.
#pragma once

#include <span>
#include <vector>

#include "mechanics/rubble/rubble_patch.hpp"

namespace sunder {

/// Merges patches between the same two bodies with normals within 25 degrees of the deepest of
/// them. The result has the normal of the deepest and four points that span the patches: the
/// deepest point, and the farthest apart among those not much higher. Sorted by bodies. Needs:
/// places and separations of all points.
void merge_patches(std::vector<RubblePatch>& patches, std::span<const MovingBody> bodies);

}  // namespace sunder

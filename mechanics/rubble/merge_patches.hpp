// SPDX-License-Identifier: MIT
// Many small patches between two bodies to few. For the sources of this room only.
#pragma once

#include <span>
#include <vector>

#include "mechanics/rubble/rubble_patch.hpp"

namespace sunder {

/// Patches between the same two bodies whose normals lie within 25 degrees of the deepest of them
/// become one, with its normal and four points that span them: the deepest, and those farthest
/// apart among what is not much higher. Sorted by bodies. Needs: places and separations of all
/// points.
void merge_patches(std::vector<RubblePatch>& patches, std::span<const MovingBody> bodies);

}  // namespace sunder

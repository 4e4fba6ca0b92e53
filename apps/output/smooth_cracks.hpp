// SPDX-License-Identifier: MIT
// Cracks as smooth surfaces, for drawing alone: how far the points of a body move at rest.
#pragma once

#include <vector>

#include "fracture/algorithms/cells.hpp"

namespace sunder {

/// Moves of the points of a body at rest that bring those on crack faces towards the planes of
/// their cracks: m, rest frame, row = point (`VolumeMap::points`). Crack faces are faces of the
/// mesh, so a crack zigzags by about half an edge; on its plane it does not. A row a point and not
/// a vertex: all copies of a point move alike, so the sides of a crack still match.
///
/// The plane of a crack at a point is the mean of its anchors there (`anchors_near`, in all
/// pieces); a point of several cracks goes to where their planes meet, and where they are too
/// nearly parallel for that to their mean. A point of the outer surface slides on that, one of its
/// sharp edges along the edge, and its corners stay. Moves are shortened until each tetrahedron
/// keeps `smooth_shape_share` of its shape (mean ratio) and hence its orientation.
/// All zero where no crack has an anchor, and so with `CrackMode::paper`.
/// O(|T| + points on crack faces x anchors of their cracks).
std::vector<Vec3> smooth_crack_moves(const Cells& cells);

/// Least share that a tetrahedron keeps of its mean ratio, 12 (3 V)^(2/3) / (sum of squared edges).
inline constexpr double smooth_shape_share = 0.25;

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Open edges of a surface that lie at one place, joined.
#pragma once

#include <cstddef>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/surface/edges.hpp"

namespace sunder {

struct Stitching {
  std::size_t points = 0;  ///< that became one with another
  std::size_t sides = 0;   ///< that were divided at points which lay on them
  double distance = 0;     ///< the largest way that a point moved, in the unit of the points
};

/// Joins points at open edges within a distance, and divides open sides at such points that lie on
/// them: triangles without area may be among the input, and are gone. The distance grows from none
/// to a 10 000th of the box's diagonal, and ends where fewer edges are open and no more edges have
/// three triangles. Points that no triangle uses any more stay. O(n log n) where few points lie
/// near each other.
Stitching stitch(const std::vector<Point>& points, std::vector<Triangle>& triangles);

}  // namespace sunder

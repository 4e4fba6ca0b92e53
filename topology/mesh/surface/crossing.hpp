// SPDX-License-Identifier: MIT
// Triangles that cross each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// A triangle of a surface: its corners, and the face that it is a part of.
struct SurfaceTriangle {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t face;
};

/// Whether three points do not lie on a line. Exact.
bool has_area(const std::vector<Point>& points, const std::array<std::uint32_t, 3>& corners);

/// Whether two triangles have a point in common besides the corners and the edge that they share.
/// Exact; corners are the same where their numbers are. Needs: triangles with an area, finite
/// points, two that lie in one place having one number.
bool triangles_cross(const std::vector<Point>& points, const std::array<std::uint32_t, 3>& a,
                     const std::array<std::uint32_t, 3>& b);

struct Crossings {
  /// Pairs of faces, the lower first, each once.
  std::vector<std::array<std::uint32_t, 2>> pairs;
  /// Whether all were looked at: where thousands lie through each other the search ends.
  bool is_finished = true;
};

/// Faces that cross each other, by their triangles. Triangles of one face are not compared with
/// each other, and those without area with none. O(n log n) where few boxes of triangles overlap.
/// Ends after 400 comparisons per triangle.
Crossings find_crossings(const std::vector<Point>& points,
                         const std::vector<SurfaceTriangle>& triangles);

}  // namespace sunder

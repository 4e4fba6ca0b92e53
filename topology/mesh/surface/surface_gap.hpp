// SPDX-License-Identifier: MIT
// Distances between two surfaces of triangles, by samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/box_tree.hpp"

namespace sunder {

/// Triangles that answer how far a point lies from them.
class NearTriangles {
 public:
  /// Needs: at least one triangle, finite points. O(n log n).
  NearTriangles(std::vector<Point> points, std::vector<std::array<std::uint32_t, 3>> triangles);

  /// The distance from a point to the nearest triangle. About log n where the last question was
  /// about a point near by.
  double distance(const Point& p) const;

 private:
  std::vector<Point> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  BoxTree tree_;
  mutable std::uint32_t last_ = 0;  ///< the nearest triangle of the last question
};

/// How far one surface lies from another, in the unit of the points.
struct SurfaceGap {
  double largest = 0, mean = 0;
  Point place{};  ///< of the largest
};

/// Distances of points of `triangles` to `other`: about `samples` of them spread evenly over the
/// area, and all corners that triangles use. The largest is a lower bound of the one-sided
/// Hausdorff distance.
SurfaceGap gap_to(const NearTriangles& other, const std::vector<Point>& points,
                  const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  std::size_t samples = 20000);

/// The larger of the two sides: of the first surface to the second, and back.
SurfaceGap gap_between(const std::vector<Point>& points,
                       const std::vector<std::array<std::uint32_t, 3>>& triangles,
                       const std::vector<Point>& other_points,
                       const std::vector<std::array<std::uint32_t, 3>>& other_triangles);

}  // namespace sunder

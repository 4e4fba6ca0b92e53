// SPDX-License-Identifier: MIT
// A cube of twelve triangles, for tests of repairs.
#pragma once

#include <vector>

#include "topology/mesh/file_mesh.hpp"

namespace sunder::test {

/// From `low` to `low` + `side` along each axis, the triangles outward.
inline FileMesh cube_surface(double low = 0, double side = 1) {
  FileMesh cube;
  for (const Point& p : std::vector<Point>{{0, 0, 0},
                                           {1, 0, 0},
                                           {1, 1, 0},
                                           {0, 1, 0},
                                           {0, 0, 1},
                                           {1, 0, 1},
                                           {1, 1, 1},
                                           {0, 1, 1}}) {
    cube.points.push_back({low + side * p[0], low + side * p[1], low + side * p[2]});
  }
  cube.triangles.corners = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                            {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return cube;
}

/// Both, without a point in common.
inline FileMesh together(FileMesh a, const FileMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles.corners) {
    a.triangles.corners.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return a;
}

}  // namespace sunder::test

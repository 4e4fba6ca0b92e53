// SPDX-License-Identifier: MIT
// Tetrahedra of solids: paths through cubes, positive order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Orders of the axes: each is a path along edges of a cube between two opposite corners, and the
/// four points of a path are one of its six tetrahedra.
inline constexpr std::array<std::array<std::size_t, 3>, 6> axis_orders = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// Adds the tetrahedron of four points that do not lie in a plane, in positive order.
inline void add_positive(TetMesh& mesh, std::array<std::uint32_t, 4> corners) {
  std::array<Point, 3> edge{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      edge[k][axis] = mesh.points[corners[k + 1]][axis] - mesh.points[corners[0]][axis];
    }
  }
  const double determinant = edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) -
                             edge[0][1] * (edge[1][0] * edge[2][2] - edge[1][2] * edge[2][0]) +
                             edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
  if (determinant < 0) std::swap(corners[2], corners[3]);
  mesh.tetrahedra.push_back(corners);
}

}  // namespace sunder

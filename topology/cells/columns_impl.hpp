// SPDX-License-Identifier: MIT
// How the volume of a vertex' star was parted by a split: for the file that instantiates it.
#pragma once

#include <cmath>

#include "topology/base/point_math.hpp"
#include "topology/cells/columns.hpp"
#include "topology/kernel/fan_impl.hpp"

namespace sunder {

namespace detail {

/// m^3 at rest, of all tetrahedra at a vertex.
template <Kernel K>
double star_volume(const K& map, VertexId vertex) {
  double six_volumes = 0;
  for (const TetId t : star(map, vertex)) {
    const auto corners = map.corners(t);
    const Point a = map.point(corners[0]);
    const auto edge = [&](int i) { return difference(map.point(corners[i]), a); };
    six_volumes += std::abs(dot(edge(1), cross(edge(2), edge(3))));
  }
  return six_volumes / 6;
}

}  // namespace detail

template <Kernel K>
std::array<double, 3> parted_shares(const K& map, const FaceSplit& split) {
  std::array<double, 3> shares{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(split.vertex_count); ++i) {
    const double kept = detail::star_volume(map, split.split_vertices[i].old_row);
    const double left = detail::star_volume(map, split.split_vertices[i].new_row);
    shares[i] = kept + left > 0 ? left / (kept + left) : 0.5;
  }
  return shares;
}

}  // namespace sunder

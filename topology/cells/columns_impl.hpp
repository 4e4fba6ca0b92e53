// SPDX-License-Identifier: MIT
// How the volume of a vertex' star was parted by a split: for the file that instantiates it.
#pragma once

#include <cmath>

#include "topology/base/point_math.hpp"
#include "topology/cells/columns.hpp"
#include "topology/kernel/fan_impl.hpp"

namespace sunder {

namespace detail {

/// Six times the rest volume of all tetrahedra at a vertex, m^3.
template <Kernel K>
double six_star_volumes(const K& map, VertexId vertex) {
  double sum = 0;
  for (const TetId t : star(map, vertex)) {
    const auto v = map.corners(t);
    sum +=
        std::abs(six_volumes(map.point(v[0]), map.point(v[1]), map.point(v[2]), map.point(v[3])));
  }
  return sum;
}

}  // namespace detail

template <Kernel K>
std::array<double, 3> parted_shares(const K& map, const FaceSplit& split) {
  std::array<double, 3> shares{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(split.vertex_count); ++i) {
    const double kept = detail::six_star_volumes(map, split.split_vertices[i].old_row);
    const double left = detail::six_star_volumes(map, split.split_vertices[i].new_row);
    shares[i] = kept + left > 0 ? left / (kept + left) : 0.5;
  }
  return shares;
}

}  // namespace sunder

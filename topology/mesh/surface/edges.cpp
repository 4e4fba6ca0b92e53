// SPDX-License-Identifier: MIT
#include "topology/mesh/surface/edges.hpp"

#include <algorithm>

namespace sunder {

std::vector<FaceSide> sides_of(const std::vector<Triangle>& triangles) {
  std::vector<FaceSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      if (a == b) continue;
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(t), a < b});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

EdgeCounts count_edges(const std::vector<Triangle>& triangles) {
  EdgeCounts counts;
  for_each_edge(sides_of(triangles), [&](std::span<const FaceSide> edge) {
    counts.open += edge.size() == 1;
    counts.thick += edge.size() > 2;
  });
  return counts;
}

std::vector<FaceSide> open_sides(const std::vector<Triangle>& triangles) {
  std::vector<FaceSide> open;
  for_each_edge(sides_of(triangles), [&](std::span<const FaceSide> edge) {
    if (edge.size() == 1) open.push_back(edge[0]);
  });
  return open;
}

}  // namespace sunder

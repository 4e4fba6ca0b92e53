// SPDX-License-Identifier: MIT
#include "topology/mesh/surface/repair/walls.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace sunder {
namespace {

Triangle sorted(Triangle t) {
  std::ranges::sort(t);
  return t;
}

}  // namespace

Walls drop_walls(std::vector<Triangle>& triangles) {
  std::map<Triangle, std::vector<std::size_t>> places;
  for (std::size_t t = 0; t < triangles.size(); ++t) places[sorted(triangles[t])].push_back(t);
  // How many places lie on each edge.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> on_edge;
  for (const auto& [corners, rows] : places) {
    ++on_edge[{corners[0], corners[1]}];
    ++on_edge[{corners[0], corners[2]}];
    ++on_edge[{corners[1], corners[2]}];
  }
  Walls walls;
  std::vector<char> goes(triangles.size(), 0);
  for (const auto& [corners, rows] : places) {
    if (rows.size() < 2) continue;
    int needs = 0;
    for (const auto& edge : {std::pair{corners[0], corners[1]}, std::pair{corners[0], corners[2]},
                             std::pair{corners[1], corners[2]}}) {
      needs += on_edge[edge] % 2 == 0 ? 1 : -1;
    }
    const std::size_t kept = needs > 0 ? 1 : 0;
    for (std::size_t k = kept; k < rows.size(); ++k) goes[rows[k]] = 1;
    (kept == 1 ? walls.doubled : walls.inner) += rows.size() - kept;
  }
  std::size_t row = 0;
  std::erase_if(triangles, [&](const Triangle&) { return goes[row++] != 0; });
  return walls;
}

}  // namespace sunder

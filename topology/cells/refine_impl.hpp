// SPDX-License-Identifier: MIT
// Body of refine_marked, for the source that instantiates it for a kernel.
#pragma once

#include <bit>

#include "topology/cells/refine.hpp"
#include "topology/cells/subdivide_impl.hpp"

namespace sunder::detail {

/// Sets of edges that a green tetrahedron may have: one, two, or the three of a face.
inline bool is_green(unsigned edges) {
  for (int p = 0; p < 4; ++p) {
    if (edges == edges_of_face(p)) return true;
  }
  return std::popcount(edges) <= 2;
}

/// The edges that have to be divided when all of `marked` are: bits of each tetrahedron.
struct Closure {
  std::vector<unsigned> of_cell;
  std::vector<char> is_marked;  // of each edge row

  template <CellKernel K>
  Closure(const K& map, const EdgeRows& edges, std::span<const TetId> marked)
      : of_cell(map.tetrahedra(), 0), is_marked(edges.first.size(), 0) {
    std::vector<TetId> red(marked.begin(), marked.end());
    while (!red.empty()) {
      const TetId t = red.back();
      red.pop_back();
      for (const std::uint32_t row : edges.of_cell[t.index()]) {
        if (is_marked[row] != 0) continue;
        is_marked[row] = 1;
        for (const auto& [u, place] : edge_ring(map, edges.first[row])) {
          unsigned& bits = of_cell[u.index()];
          bits |= 1U << place;
          if (!is_green(bits)) red.push_back(u);
        }
      }
    }
  }
};

}  // namespace sunder::detail

namespace sunder {

template <CellKernel K>
RefinedLevel refine_marked(K& map, std::span<const TetId> marked,
                           std::span<const char> as_they_stand) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return refine_marked(kernel, marked, as_they_stand); });
  } else {
    const EdgeRows edges = edge_rows(map);
    const detail::Closure closure(map, edges, marked);
    RefinedLevel level;
    for (const unsigned bits : closure.of_cell) {
      level.red += bits == detail::all_edges;
      level.green += bits != detail::all_edges && bits != 0;
    }
    std::vector<EdgeMark> marks;
    for (std::size_t row = 0; row < edges.first.size(); ++row) {
      if (closure.is_marked[row] != 0) marks.push_back({edges.first[row], 0.5});
    }
    level.edit = divide_edges(map, marks, as_they_stand);
    return level;
  }
}

}  // namespace sunder

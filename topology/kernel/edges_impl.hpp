// SPDX-License-Identifier: MIT
// Bodies of edges.hpp, for the source that instantiates them for a kernel.
#pragma once

#include "topology/kernel/edges.hpp"

namespace sunder::detail {

/// Goes on round the edge between rows `a` and `b`, until the boundary or `first`. The way begins
/// at `at`, out of its face opposite to the corner at place `leave`. Appends the edges met. True if
/// it reached `first`.
template <Kernel K>
bool go_round(const K& map, TetId first, TetId at, int leave, VertexId a, VertexId b,
              std::vector<CellEdge>& ring) {
  while (true) {
    const HalfFaceId entered = map.neighbour(half_face(at, leave));
    if (entered.is_none()) return false;
    at = tetrahedron_of(entered);
    if (at == first) return true;
    const auto corners = map.corners(at);
    const int i = place_of_vertex(corners, a), j = place_of_vertex(corners, b);
    ring.push_back({at, edge_between(i, j)});
    leave = 6 - place_of(entered) - i - j;
  }
}

}  // namespace sunder::detail

namespace sunder {

template <Kernel K>
std::vector<CellEdge> edge_ring(const K& map, CellEdge edge) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](const auto& kernel) { return edge_ring(kernel, edge); });
  } else {
    const TetId t = edge.tetrahedron;
    const auto [i, j] = edge_ends[static_cast<std::size_t>(edge.place)];
    const auto corners = map.corners(t);
    std::array<int, 2> others{};
    for (int k = 0, n = 0; k < 4; ++k) {
      if (k != i && k != j) others[static_cast<std::size_t>(n++)] = k;
    }
    std::vector<CellEdge> ring{edge};
    if (!detail::go_round(map, t, t, others[0], corners[i], corners[j], ring)) {
      detail::go_round(map, t, t, others[1], corners[i], corners[j], ring);
    }
    return ring;
  }
}

template <Kernel K>
EdgeRows edge_rows(const K& map) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](const auto& kernel) { return edge_rows(kernel); });
  } else {
    constexpr std::uint32_t none = 0xffffffffU;
    EdgeRows rows;
    rows.of_cell.assign(map.tetrahedra(), {none, none, none, none, none, none});
    for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
      for (int e = 0; e < 6; ++e) {
        if (rows.of_cell[t][static_cast<std::size_t>(e)] != none) continue;
        const auto row = static_cast<std::uint32_t>(rows.first.size());
        rows.first.push_back({TetId{t}, e});
        for (const auto& [u, place] : edge_ring(map, rows.first.back())) {
          rows.of_cell[u.index()][static_cast<std::size_t>(place)] = row;
        }
      }
    }
    return rows;
  }
}

}  // namespace sunder

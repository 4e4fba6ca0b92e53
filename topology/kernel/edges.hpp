// SPDX-License-Identifier: MIT
// Edges of a map: orbits, each known by rows, and the ring of tetrahedra round one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/kernel/kernel.hpp"

namespace sunder {

/// An edge seen from one tetrahedron.
struct CellEdge {
  TetId tetrahedron;
  /// 0 to 5, see `edge_ends`.
  int place = 0;
  friend bool operator==(const CellEdge&, const CellEdge&) = default;
};

/// The tetrahedra round an edge (the orbit of beta2 beta3), each with the edge's place, in the
/// order of a walk from the given one. At a boundary the walk continues from the given one in the
/// other direction. O(ring).
template <Kernel K>
std::vector<CellEdge> edge_ring(const K& map, CellEdge edge);

/// A row for every edge orbit of a map.
struct EdgeRows {
  /// Rows of the six edges of each tetrahedron.
  std::vector<std::array<std::uint32_t, 6>> of_cell;
  /// Each edge, seen from its tetrahedron of lowest row.
  std::vector<CellEdge> first;
};

/// Numbers the edges in the order of their lowest tetrahedra and of the places there. O(|T|).
template <Kernel K>
EdgeRows edge_rows(const K& map);

}  // namespace sunder

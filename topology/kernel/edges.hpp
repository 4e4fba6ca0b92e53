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

/// The tetrahedra round an edge (the orbit of beta2 beta3), each by its place of the edge, as a walk
/// meets them that begins at the one given; round an edge on the boundary the walk goes on from there
/// the other way. O(ring).
template <Kernel K>
std::vector<CellEdge> edge_ring(const K& map, CellEdge edge);

/// A row for every edge orbit of a map.
struct EdgeRows {
  /// Of the six edges of each tetrahedron.
  std::vector<std::array<std::uint32_t, 6>> of_cell;
  /// Each edge from the tetrahedron of lowest row that has it.
  std::vector<CellEdge> first;
};

/// In the order of their lowest tetrahedra and of places there. O(|T|).
template <Kernel K>
EdgeRows edge_rows(const K& map);

}  // namespace sunder

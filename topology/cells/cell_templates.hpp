// SPDX-License-Identifier: MIT
// How one tetrahedron is divided at the middles of some of its edges. No map here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/cells/edges.hpp"

namespace sunder {

/// A part of a tetrahedron by its nodes: 0 to 3 corners, 4 + e the middle of edge e.
using CellPart = std::array<int, 4>;

/// The parts of a tetrahedron, oriented as it is. `edges`: bit e for each edge divided, a divisible
/// set; `order`: the numbers by which divided edges take their turn, different from each other.
/// All six edges: the eight tetrahedra of Bey (Computing 55, 1995), in an order of corners that keeps
/// to three classes of shapes however often it is done again.
std::vector<CellPart> parts_of_cell(unsigned edges, const std::array<std::uint32_t, 6>& order);

/// Bits of the three edges of the face opposite to corner p.
constexpr unsigned edges_of_face(int p) {
  unsigned bits = 0;
  for (unsigned e = 0; e < 6; ++e) {
    if (edge_ends[e][0] != p && edge_ends[e][1] != p) bits |= 1U << e;
  }
  return bits;
}

/// The face (0 to 3) of the tetrahedron that three of its nodes lie in; 4 where there is none.
constexpr int face_of_nodes(const std::array<int, 3>& nodes) {
  for (int p = 0; p < 4; ++p) {
    bool lies_in_it = true;
    for (const int n : nodes) {
      lies_in_it = lies_in_it && (n < 4 ? n != p : (edges_of_face(p) >> (n - 4) & 1) != 0);
    }
    if (lies_in_it) return p;
  }
  return 4;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// How one tetrahedron is divided at the middles of some of its edges. No map here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/kernel/edges.hpp"

namespace sunder {

/// A part of a tetrahedron by its nodes: 0 to 3 corners, 4 + e the middle of edge e.
using CellPart = std::array<int, 4>;

/// The parts of a tetrahedron, oriented as it is. `edges`: bit e for each edge divided, a divisible
/// set; `order`: the numbers by which divided edges take their turn, different from each other.
/// All six edges: `parts_by_eight(0)`.
std::vector<CellPart> parts_of_cell(unsigned edges, const std::array<std::uint32_t, 6>& order);

/// The eight tetrahedra of Bey (Computing 55, 1995), made of one with its corners taken in some
/// order. 0: as they stand, so that the edge inside joins the middles of 0 2 and 1 3; 1: those of 0
/// 3 and 1 2; 2: those of 0 1 and 2 3. First the four at the corners, then those round the edge
/// inside. Their corners are ordered so that dividing them again, as they stand, gives only three
/// classes of shapes.
const std::array<CellPart, 8>& parts_by_eight(int turn);

/// Bits of the three edges of the face opposite to corner p.
constexpr unsigned edges_of_face(int p) {
  unsigned bits = 0;
  for (unsigned e = 0; e < 6; ++e) {
    if (edge_ends[e][0] != p && edge_ends[e][1] != p) bits |= 1U << e;
  }
  return bits;
}

/// Bits of the six nodes in the face opposite to each corner.
inline constexpr std::array<unsigned, 4> nodes_of_face = {
    edges_of_face(0) << 4 | 0b1110U, edges_of_face(1) << 4 | 0b1101U,
    edges_of_face(2) << 4 | 0b1011U, edges_of_face(3) << 4 | 0b0111U};

/// The face (0 to 3) of the tetrahedron that three of its nodes lie in; 4 where there is none.
inline int face_of_nodes(const std::array<int, 3>& nodes) {
  const unsigned bits = 1U << nodes[0] | 1U << nodes[1] | 1U << nodes[2];
  int p = 0;
  while (p < 4 && (bits & ~nodes_of_face[static_cast<std::size_t>(p)]) != 0) ++p;
  return p;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Division of tetrahedra at the middles of their edges, the basis of all operations on cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/kernel/edges.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {

/// A new vertex on an edge.
struct MiddleVertex {
  VertexId vertex;
  /// The ends of the edge, the one of the lower file point first.
  std::array<VertexId, 2> ends;
  /// Its position is (1 - weight) x first end + weight x second end.
  double weight = 0.5;
};

/// A part of a divided tetrahedron.
struct ChildCell {
  TetId tetrahedron;
  /// The first of the children has the row of the parent.
  TetId parent;
  /// Share of the parent's volume; the shares of one parent sum to 1.
  double share = 1;
  /// For each face, the parent's face (0 to 3) that contains it; 4: inside the parent.
  std::array<std::uint8_t, 4> face = {4, 4, 4, 4};
};

/// The effect of an operation on cells, with all data for extending columns.
struct CellEdit {
  std::vector<MiddleVertex> vertices;
  /// Children of one parent stand together, the one with the parent's row first.
  std::vector<ChildCell> cells;
  /// Undoes the operation when it is applied to the map.
  CellChange undo;
};

/// An edge to divide, by any of its tetrahedra, and the place on it: weight 0 at the end with the
/// lower row of its file point, 1 at the other end.
struct EdgeMark {
  CellEdge edge;
  double weight = 0.5;
};

/// True if a tetrahedron with these divided edges can be divided; bit e stands for edge e of
/// `edge_ends`. Possible are the three edges of one face (four parts), all six (eight parts), and
/// all sets without a face of three such edges (edge by edge, by rising points of the middles).
bool is_divisible(unsigned edges);

/// Divides marked edges and all tetrahedra round them. Faces are divided alike from both sides. So
/// are the faces of a crack if both sides are marked: their new vertices share one point.
///
///     one edge          two edges               a face             all (Bey 1995)
///        /|\          /|\  the lower point     /\                 4 corners, and 4 round an
///       / | \        / |_\ first               /__\               edge between the middles of
///      /  |  \      /__|/ \                   /\  /\              two opposite ones
///
/// A division into eight has an inner edge. Of three candidates the one with the best smallest
/// radius ratio is taken; the corners' own choice (cell_templates.hpp) wins unless another is
/// better by 1e-9. A 1 in `as_they_stand`, by rows of tetrahedra, takes the corners' choice always.
/// Parts that are divided again in this way have at most three shapes (Bey). New vertices are
/// appended in the order of `marks`, points likewise; the first child of a tetrahedron keeps its
/// row, the others are appended in the order of parents. Children are oriented as parents.
/// Requires: each edge marked once, sets that `is_divisible` accepts, weights inside (0, 1), and
/// `as_they_stand` for all tetrahedra or for none. O(tetrahedra round the edges).
template <CellKernel K>
CellEdit divide_edges(K& map, std::span<const EdgeMark> marks,
                      std::span<const char> as_they_stand = {});

/// Inserts one vertex in one edge and bisects every tetrahedron round it. `weight` as in
/// `EdgeMark`.
template <CellKernel K>
CellEdit insert_vertex(K& map, CellEdge edge, double weight = 0.5);

}  // namespace sunder

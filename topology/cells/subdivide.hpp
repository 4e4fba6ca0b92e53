// SPDX-License-Identifier: MIT
// Tetrahedra divided at the middles of their edges: what every operation that changes cells is made of.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/kernel/edges.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {

/// A vertex that came to be on an edge.
struct MiddleVertex {
  VertexId vertex;
  /// The ends of the edge, the one of the lower file point first.
  std::array<VertexId, 2> ends;
  /// It lies at (1 - weight) x first end + weight x second end.
  double weight = 0.5;
};

/// A tetrahedron that came from dividing another one.
struct ChildCell {
  TetId tetrahedron;
  /// The first of the children has the row of the parent.
  TetId parent;
  /// Part of the parent's volume; the parts of one parent sum to 1.
  double share = 1;
  /// For each of its faces the parent's face (0 to 3) that it is a part of; 4: inside the parent.
  std::array<std::uint8_t, 4> face = {4, 4, 4, 4};
};

/// What an operation did to cells: all that columns need to go along.
struct CellEdit {
  std::vector<MiddleVertex> vertices;
  /// Children of one parent stand together, the one with the parent's row first.
  std::vector<ChildCell> cells;
  /// Takes the operation back when it is applied to the map.
  CellChange undo;
};

/// An edge to be divided, by any one of its tetrahedra, and where: 0 at the end whose file point has
/// the lower row, 1 at the other.
struct EdgeMark {
  CellEdge edge;
  double weight = 0.5;
};

/// Which edges of one tetrahedron are divided: bit e for edge e of `edge_ends`. Divisible are all sets
/// without a face of three such edges (each edge in turn, by rising points of the middles), the three
/// edges of one face (into four) and all six (into eight).
bool is_divisible(unsigned edges);

/// Divides marked edges and all tetrahedra round them. Faces are divided alike from both of their
/// sides, those of a crack as well when both sides are marked: their new vertices have one point.
///
///     one edge          two edges               a face             all (Bey 1995)
///        /|\          /|\  the lower point     /\                 4 corners, and 4 round an
///       / | \        / |_\ first               /__\               edge between the middles of
///      /  |  \      /__|/ \                   /\  /\              two opposite ones
///
/// The edge inside one divided into eight is the one of three that gives the best least radius ratio
/// inside, the one that its corners tell (cell_templates.hpp) unless another is better by 1e-9; with a 1
/// in `as_they_stand`, by rows of tetrahedra, the one that they tell. Parts of eight that are divided
/// again as they stand have three shapes at most with their parent (Bey).
/// New vertices are appended in the order of `marks`, points likewise; the first child of a tetrahedron
/// keeps its row, the others are appended in the order of parents. Children are oriented as parents.
/// Needs: each edge marked once, sets that `is_divisible`, weights inside (0, 1); `as_they_stand` for
/// all tetrahedra or for none.
/// O(tetrahedra round the edges).
template <CellKernel K>
CellEdit divide_edges(K& map, std::span<const EdgeMark> marks,
                      std::span<const char> as_they_stand = {});

/// One vertex in one edge: every tetrahedron round it is bisected. `weight` as in `EdgeMark`.
template <CellKernel K>
CellEdit insert_vertex(K& map, CellEdge edge, double weight = 0.5);

}  // namespace sunder

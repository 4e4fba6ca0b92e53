// SPDX-License-Identifier: MIT
// Cells get nodes in the middles of their edges; cells with bent edges are found.
#pragma once

#include <cstddef>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// All cells of first order become those of second order with the same corners and a node in the
/// middle of each edge; their columns go with them. Cells that share an edge share its node, also
/// with existing cells of second order. Vertices and polygons stay. New points stand behind the
/// others: numbers count on; data are the mean of the ends', integers and references the common
/// value of both ends, or 0. Gives how many points are new. O(n log n).
std::size_t raise_order(FileMesh& mesh);

/// Cells of second order of one kind with a middle node off the middle of its edge by more than a
/// millionth of the edge.
struct CurvedCells {
  std::size_t count = 0;
  std::size_t first = 0;  ///< row of the first, if any
  double most = 0;        ///< largest distance from the middle over the edge's length
};
CurvedCells curved_cells(const FileMesh& mesh, CellKind kind);

}  // namespace sunder

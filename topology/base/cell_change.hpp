// SPDX-License-Identifier: MIT
// The rows that an operation on cells writes into a map. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Rows of a map that are rewritten, appended or (by an undo) dropped from the end. The map's
/// `apply` carries the change out and returns the inverse change, which restores the same bytes.
struct CellChange {
  /// The new content of a row of tetrahedra.
  struct Cell {
    TetId row;
    std::array<VertexId, 4> corners;
    std::array<HalfFaceId, 4> neighbours;
  };
  /// The tetrahedron from which walks round a vertex start.
  struct Begin {
    VertexId vertex;
    TetId tetrahedron;
  };

  /// Numbers of rows that stay. The rows behind them are dropped before others are appended.
  std::size_t kept_points = 0, kept_vertices = 0, kept_tetrahedra = 0;
  /// Rest positions of the appended points, m.
  std::vector<Point> points;
  /// The point of each appended vertex.
  std::vector<std::uint32_t> vertices;
  /// Rewritten rows, each once, and all appended rows from `kept_tetrahedra` on in rising order.
  /// The rows include both sides of every face that is sewn, unsewn or sewn to another face.
  std::vector<Cell> cells;
  /// Starts of appended vertices, and of vertices that leave the tetrahedron of their former start.
  std::vector<Begin> begins;
};

}  // namespace sunder

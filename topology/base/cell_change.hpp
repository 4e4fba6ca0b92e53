// SPDX-License-Identifier: MIT
// What an operation that changes cells writes into a map: rows as they shall be. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Rows of a map that are rewritten, appended or, as an undo has it, dropped from the end. `apply` of
/// a map carries it out and gives the change that takes it back to the same bytes.
struct CellChange {
  /// A tetrahedron as it shall be.
  struct Cell {
    TetId row;
    std::array<VertexId, 4> corners;
    std::array<HalfFaceId, 4> neighbours;
  };
  /// Where walks round a vertex begin.
  struct Begin {
    VertexId vertex;
    TetId tetrahedron;
  };

  /// How many rows stay; those behind are dropped before others are appended.
  std::size_t kept_points = 0, kept_vertices = 0, kept_tetrahedra = 0;
  /// Rest positions of the points appended, m.
  std::vector<Point> points;
  /// The point of each vertex appended.
  std::vector<std::uint32_t> vertices;
  /// Rewritten rows, each once, and behind `kept_tetrahedra` all appended ones in rising order. Both
  /// sides of every face that is sewn, unsewn or sewn to another one are among them.
  std::vector<Cell> cells;
  /// Of appended vertices, and of all whose walks began in a tetrahedron that they leave.
  std::vector<Begin> begins;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Edges divided by CGAL's own insertions, timed, as a comparison for `divide_edges`.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder::test {

/// An edge between two places, m, and the place of its new vertex.
struct DividedEdge {
  std::array<Point, 2> ends;
  Point middle;
};

/// CGAL's cells, and the corners of each tetrahedron as places, sorted, all sorted.
struct CgalBody {
  std::vector<unsigned> cells;
  std::vector<std::array<Point, 4>> tetrahedra;
  bool is_valid = false;
  std::size_t bytes = 0;
};

/// CGAL's Linear_cell_complex of a body, attributes managed, with points alone ("points") or with
/// the attributes of our own darts ("rows": of vertices their rows, of tetrahedra theirs).
class CgalBisection {
 public:
  CgalBisection(const TetMesh& mesh, bool with_rows);
  CgalBisection(CgalBisection&&) noexcept;
  ~CgalBisection();

  /// Divides edges with rings that have no tetrahedron in common, one after another:
  /// `insert_cell_0_in_cell_1` in the edge, `insert_cell_1_in_cell_2` in every face round it,
  /// `insert_cell_2_in_cell_3` in every tetrahedron. Gives microseconds of this thread, without the
  /// search of edges by their places.
  double divide(const std::vector<DividedEdge>& edges);
  CgalBody body();

  struct Complex;

 private:
  std::unique_ptr<Complex> complex_;
};

}  // namespace sunder::test

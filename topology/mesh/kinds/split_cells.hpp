// SPDX-License-Identifier: MIT
// Cells of all kinds cut into simplices, neighbours alike.
#pragma once

#include <cstddef>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Counts of the cells that were cut.
struct SplitCells {
  /// By kind: how many there were.
  std::array<std::size_t, cell_kinds> cut{};
  std::size_t triangles = 0, tetrahedra = 0;
  /// Parts with a corner twice, which are left out: of cells that repeat a corner.
  std::size_t empty_parts = 0;
  /// Volume cells with a part that is flat, or turned inside out against the whole; faces with a
  /// part that looks away from the whole: they are concave there, or twisted.
  std::size_t concave_volumes = 0, concave_faces = 0;
  /// Polygons with corners that do not lie in a plane (to a millionth of their size).
  std::size_t bent_polygons = 0;
  /// Parts that were given numbers behind the highest of the file.
  std::size_t numbers_added = 0;
};

/// Hexahedra, prisms, pyramids become tetrahedra, quadrilaterals and polygons triangles; those of
/// second order by their corners. Simplices stay as they are, of second order too.
///
/// A cell is cut from its corner with the least row: a face becomes a fan around its least corner,
/// and a tetrahedron goes from the cell's least corner to each triangle of the faces that do not
/// have it. So two cells cut a face that they share alike, whatever the order of their corners. No
/// point is added. Parts have the region, entity and data of their cell, and stand behind the cells
/// that are there, in its place among others; the first keeps its number. Needs: nodes below the
/// number of points, columns empty or complete. O(n).
SplitCells split_cells(FileMesh& mesh);

/// Drops points that cells used in `before` and none uses now; returns how many. Rows of the others
/// keep their order, and their numbers name their origins.
std::size_t drop_points_out_of_use(FileMesh& mesh, const std::vector<bool>& used_before);

/// Which points a cell uses.
std::vector<bool> used_points(const FileMesh& mesh);

}  // namespace sunder

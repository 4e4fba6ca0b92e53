// SPDX-License-Identifier: MIT
// The skin of a mesh of volume cells, as formats of surfaces hold it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

struct BoundarySurface {
  /// No volume cells, and none of second order. Points that no face uses are gone; where some are,
  /// `source_point_id` gives the numbers of the others (counted from 1 where the mesh gave none).
  FileMesh mesh;
  /// Cells below dimension 3 that are not in it, by kind of first order.
  std::array<std::size_t, cell_kinds> lost_cells{};
  std::size_t lost_points = 0;
};

/// Whether there are volume cells of any kind.
bool has_volume_cells(const FileMesh& mesh);

/// The boundary of the volume cells: one triangle or quadrilateral a face that belongs to exactly
/// one of them, outward (that of an inverted cell too), in the order of their kinds, their rows and
/// their faces; cells of second order are taken by their corners. A cell of the mesh on the same
/// points gives it its region, entity, number and data, of several the first; where some have none,
/// they get region and entity 0, data not-a-number (integers: 0), and numbers after all others.
/// Other cells of dimension 2 are lost, and vertices and edges with a point that the boundary does
/// not use. Names of regions stay, but for those of volume cells. Needs: nodes below the number of
/// points, columns empty or complete. O(n log n).
BoundarySurface boundary_surface(const FileMesh& mesh);

/// Six times the volume of a cell of first order, by its faces cut into triangles.
double six_volumes_of(const FileMesh& mesh, CellKind linear,
                      std::span<const std::uint32_t> corners);

}  // namespace sunder

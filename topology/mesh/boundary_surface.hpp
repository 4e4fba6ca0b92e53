// SPDX-License-Identifier: MIT
// The skin of a tetrahedral mesh, as formats of surfaces hold it.
#pragma once

#include <array>
#include <cstddef>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

struct BoundarySurface {
  /// No tetrahedra. Points that no triangle uses are gone; where some are, `source_point_id` tells
  /// the numbers of the others (counted from 1 where the mesh gave none).
  FileMesh mesh;
  /// Vertices, edges and triangles of the mesh that are not in it, by dimension.
  std::array<std::size_t, 3> lost_cells{};
  std::size_t lost_points = 0;
};

/// The boundary of the tetrahedra: one triangle a face that belongs to exactly one of them, outward
/// (that of an inverted tetrahedron too), in the order of their rows and of the corner left out. A
/// triangle of the mesh on the same three points gives it its region, entity, number and data, of
/// several the first; where some have none, they get region and entity 0, data not-a-number
/// (integers: 0), and numbers after all others. Other triangles are lost, and vertices and edges
/// with a point that the boundary does not use. Names of regions stay, but for those of tetrahedra.
/// Needs: corners below the number of points, columns empty or complete. O(n log n).
BoundarySurface boundary_surface(const FileMesh& mesh);

}  // namespace sunder

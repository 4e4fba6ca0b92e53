// SPDX-License-Identifier: MIT
// Properties of a mesh of faces without a body: closed, manifold, oriented, crossing itself; its
// area and the volume that it encloses.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Where cells lie.
struct Extent {
  BoundingBox box;
  /// Centre of the volume, m; of a surface that encloses none, of its area.
  Point centre{};
};

/// Box and centre of the tetrahedra of first order; none where there is no volume.
std::optional<Extent> extent_of_tetrahedra(const FileMesh& mesh);

struct SurfaceCheck {
  std::vector<Finding> findings;
  std::size_t triangles = 0, quadrilaterals = 0, polygons = 0;
  /// Points that faces use, by place: points with the same coordinates are one.
  std::size_t vertices = 0;
  std::size_t edges = 0, boundary_edges = 0, components = 0;
  std::ptrdiff_t euler_characteristic = 0;
  /// Each edge has two faces.
  bool is_closed = false;
  /// No edge has more than two faces, and the faces at each vertex hang together around it.
  bool is_manifold = false;
  /// Two faces go through an edge that they share in opposite ways.
  bool is_oriented = false;
  /// None where the search was not finished.
  std::optional<bool> crosses_itself;
  /// m^2
  double area = 0;
  /// m^3, where it is closed and oriented: negative where faces look inward.
  std::optional<double> volume;
  Extent extent;
};

/// Checks triangles, quadrilaterals and polygons (those of second order by their corners). Faces
/// with more than three corners are fans where their shape matters: around their least corner, or
/// the next one from which no triangle is a line.
///
/// | code | severity | ids |
/// |---|---|---|
/// | self_intersection: faces that cross | error | pairs of faces |
/// | duplicate_face | warning | faces, the later of each pair |
/// | flat_face: no area | warning | faces |
/// | nonmanifold_edge: of three faces or more | warning | pairs of points |
/// | open_edge: of one face | warning | pairs of points |
/// | inconsistent_orientation | warning | pairs of points |
/// | inside_out: closed, and the faces look inward | warning | - |
/// | nonmanifold_vertex | note | points |
/// | coincident_points: points that are one place | note | points, the later ones |
/// | crossings_unfinished | warning | - |
///
/// Faces are counted through triangles, quadrilaterals, polygons. O(n log n). Needs: finite points,
/// nodes below their number.
SurfaceCheck check_surface(const FileMesh& mesh);

}  // namespace sunder

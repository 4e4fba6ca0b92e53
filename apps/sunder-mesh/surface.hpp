// SPDX-License-Identifier: GPL-3.0-or-later
// Closed triangle surfaces that a solid is meshed from: read from a file, made, placed. No CGAL.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// A triangle surface: three rows of `points` a triangle, oriented alike across every edge.
struct Surface {
  /// Coordinates, m (of a file: whatever unit it is in, until `place` scales it).
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The axis of a file that shall point up.
enum class UpAxis { x, minus_x, y, minus_y, z, minus_z };

/// A closed, edge-manifold surface from an OFF, OBJ or STL file (known by the name's ending).
/// Points at the same place are merged (STL holds every corner apart), polygons cut into triangles
/// fanwise, triangles turned to agree.
/// Errors: cannot_open, unknown_format, not_a_surface, nan_coordinate, empty_surface,
/// non_manifold_surface, open_surface; the warning self_intersecting_surface comes with a value.
Result<Surface> read_surface(const std::filesystem::path& path);

/// The box [-x/2, x/2] x [-y/2, y/2] x [0, z] of the given edge lengths, m, all > 0.
Surface box_surface(const std::array<double, 3>& edge_lengths);

/// A tube about the z axis standing on z = 0, made of `ring_segments` flat pieces.
struct RingShape {
  /// m; outer_radius > inner_radius > 0.
  double outer_radius = 0;
  double inner_radius = 0;
  /// m, > 0.
  double height = 0;
};
constexpr int ring_segments = 64;
Surface ring_surface(const RingShape& shape);

/// Turns `points` (a proper rotation) so that their axis `up` becomes +z.
void turn_up(std::vector<Point>& points, UpAxis up);

/// Scales `points` about the origin so that their extent along z is `height`, m.
/// Needs: height > 0 and an extent > 0.
void scale_to_height(std::vector<Point>& points, double height);

/// Moves `points` so that the lowest lies on z = 0 and their bounding box is centred on the z axis.
void stand_on_ground(std::vector<Point>& points);

/// Length of the diagonal of the points' bounding box, m; 0 for no point.
double bounding_diagonal(const std::vector<Point>& points);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Closed surfaces of triangles as obstacles: their measures, and signed distances to them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Triangles of a file, unchecked.
struct TriangleSurface {
  std::vector<Vec3> points;                             ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
};

/// A closed surface without self-intersections, with the values that are computed from it once.
struct SolidSurface {
  std::string file;  ///< the file of the surface, or empty
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  double volume = 0;            ///< m^3
  Vec3 centre{0, 0, 0};         ///< m, of the volume
  Mat3 inertia = Mat3::Zero();  ///< m^5, about `centre`, at density 1
  double radius = 0;            ///< m, of the farthest point from `centre`
  /// Unit outward normals of each triangle, and at each point the mean over its triangles, weighted
  /// by their angles [Baerentzen and Aanaes 2005]. The sign of the distance along it separates
  /// inside from outside.
  std::vector<Vec3> face_normal, point_normal;
  /// Normal of the edge from corner k to the next: the mean of its two triangles, not of unit
  /// length.
  std::vector<std::array<Vec3, 3>> edge_normal;
  /// Other ends of the edges at each point (`ring`), and the start of each point's part of that
  /// list.
  std::vector<std::uint32_t> ring_first, ring;

  /// An edge at which the solid is convex by more than about a degree, and the third corners of its
  /// two triangles.
  struct Edge {
    std::array<std::uint32_t, 2> end, beside;
  };
  std::vector<Edge> sharp_edges;

  /// A tree of boxes of triangles. The two children of a node are consecutive.
  struct Node {
    Vec3 low, high;
    std::uint32_t first = 0;  ///< child, or triangle in `order`
    std::uint32_t count = 0;  ///< of triangles; 0: two children
  };
  std::vector<Node> tree;
  std::vector<std::uint32_t> order;  ///< triangles of leaves
};

/// Largest number of triangles of an obstacle. A vertex near it, and each of its own points, costs
/// about 1 µs per pass of a step.
inline constexpr std::size_t most_obstacle_triangles = 200000;

/// Computes the measures, normals and boxes of a surface. If all triangles face inwards, they are
/// reversed. Errors: empty_surface, too_many_triangles, index_out_of_range, nan_coordinate,
/// flat_triangle, open_surface (an edge with one triangle), non_manifold_surface (an edge with more
/// than two, or a point that alone connects its triangles), wrong_orientation (neighbours that
/// disagree), no_volume, self_intersection. O(n log n).
Result<SolidSurface> make_solid_surface(TriangleSurface triangles, std::string file = {});

/// Signed distance of a point (m, the surface's own coordinates) and its gradient. The pseudonormal
/// at the nearest triangle, edge or point gives the exact sign.
struct SurfacePoint {
  double gap = 0;        ///< m, negative inside
  Vec3 normal{0, 0, 1};  ///< unit
};
SurfacePoint distance_to_surface(const SolidSurface& surface, const Vec3& point);

/// Triangles that come as near to a point as `distance` (m), ascending.
std::vector<std::uint32_t> triangles_near(const SolidSurface& surface, const Vec3& point,
                                          double distance);

/// The first pair of triangles that meet beyond their shared corners. Without such a pair both
/// entries are the number of triangles. O(n log n) for most surfaces.
std::array<std::size_t, 2> meeting_triangles(const SolidSurface& surface);

}  // namespace sunder

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

/// Triangles as a file has them.
struct TriangleSurface {
  std::vector<Vec3> points;                             ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
};

/// A closed surface that does not meet itself, with what is computed from it once.
struct SolidSurface {
  std::string file;  ///< it was read from; empty: none
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  double volume = 0;             ///< m^3
  Vec3 centre{0, 0, 0};          ///< m, of the volume
  Mat3 inertia = Mat3::Zero();   ///< m^5: about `centre`, of a solid of density 1
  double radius = 0;             ///< m, of the farthest point from `centre`
  /// Unit, outward: of each triangle, and the mean of a point's triangles by their angles there
  /// [Baerentzen and Aanaes 2005]: its sign tells inside from outside.
  std::vector<Vec3> face_normal, point_normal;
  /// Of the edge from corner k to the next, the mean of its two triangles'; not of length 1.
  std::vector<std::array<Vec3, 3>> edge_normal;
  /// |points| + 1 and the other ends of the edges at each point.
  std::vector<std::uint32_t> ring_first, ring;

  /// Boxes of triangles, halved again and again: a node's children stand one behind the other.
  struct Node {
    Vec3 low, high;
    std::uint32_t first = 0;  ///< child, or triangle in `order`
    std::uint32_t count = 0;  ///< of triangles; 0: two children
  };
  std::vector<Node> tree;
  std::vector<std::uint32_t> order;  ///< triangles of leaves
};

/// Largest number of triangles of an obstacle: a vertex near it costs about a microsecond in each
/// pass of a step, and each of its own points as much.
inline constexpr std::size_t most_obstacle_triangles = 200000;

/// Measures, normals and boxes of a surface; triangles that all face inwards are turned. Errors:
/// empty_surface, too_many_triangles, index_out_of_range, nan_coordinate, flat_triangle,
/// open_surface (an edge with one triangle), non_manifold_surface (an edge with more than two, or a
/// point whose triangles hang together by it alone), wrong_orientation (neighbours that
/// disagree), no_volume, self_intersection. O(n log n).
Result<SolidSurface> make_solid_surface(TriangleSurface triangles, std::string file = {});

/// Signed distance of a point (m, the surface's own coordinates) and its gradient: by the nearest
/// triangle, edge or point and the pseudonormal there, exact in sign.
struct SurfacePoint {
  double gap = 0;           ///< m, negative inside
  Vec3 normal{0, 0, 1};     ///< unit
};
SurfacePoint distance_to_surface(const SolidSurface& surface, const Vec3& point);

/// The first pair of triangles that meet without sharing a corner, or by more than what they share;
/// two times the number of triangles: none. O(n log n) for most surfaces.
std::array<std::size_t, 2> meeting_triangles(const SolidSurface& surface);

}  // namespace sunder

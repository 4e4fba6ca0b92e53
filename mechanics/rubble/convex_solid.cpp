// SPDX-License-Identifier: MIT
// Planes, then where three of them meet, then corners round each plane.
#include "mechanics/rubble/convex_solid.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

namespace sunder {
namespace {

using Triangle = std::array<Vec3, 3>;

struct Plane {
  Vec3 normal;
  double offset;
  double above(const Vec3& x) const { return normal.dot(x) - offset; }
};

/// Planes of all triangles, each once; nothing where there are more than a solid may have.
std::optional<std::vector<Plane>> find_planes(std::span<const Triangle> triangles,
                                              double tolerance) {
  std::vector<Plane> planes;
  for (const Triangle& t : triangles) {
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    const bool is_known = std::ranges::any_of(planes, [&](const Plane& plane) {
      return plane.normal.dot(normal) > 0.5 && std::ranges::all_of(t, [&](const Vec3& x) {
               return std::abs(plane.above(x)) <= tolerance;
             });
    });
    if (is_known) continue;
    if (planes.size() == ConvexSolid::most_faces) return std::nullopt;
    planes.push_back({normal, normal.dot(t[0])});
  }
  return planes;
}

bool is_convex(std::span<const Triangle> triangles, const std::vector<Plane>& planes,
               double tolerance) {
  for (const Triangle& t : triangles) {
    for (const Vec3& x : t) {
      for (const Plane& plane : planes) {
        if (plane.above(x) > tolerance) return false;
      }
    }
  }
  return true;
}

/// Points that lie in three planes, each once; false where there are more than a solid may have.
bool find_corners(ConvexSolid& solid, std::span<const Triangle> triangles,
                  const std::vector<Plane>& planes, double tolerance) {
  for (const Triangle& t : triangles) {
    for (const Vec3& x : t) {
      const auto in = std::ranges::count_if(
          planes, [&](const Plane& p) { return std::abs(p.above(x)) <= tolerance; });
      if (in < 3) continue;
      const auto end = solid.corner.begin() + solid.kind.vertices;
      const bool is_known = std::any_of(solid.corner.begin(), end, [&](const Vec3& corner) {
        return (corner - x).norm() <= 10 * tolerance;
      });
      if (is_known) continue;
      if (solid.kind.vertices == solid.corner.size()) return false;
      solid.corner[solid.kind.vertices++] = x;
    }
  }
  return true;
}

/// Whether the corners go round counter-clockwise about the normal.
bool goes_round(const ConvexSolid& solid, const PolytopeKind::Face& face, const Vec3& normal) {
  for (std::size_t i = 0; i < face.count; ++i) {
    const Vec3& a = solid.corner[face.vertex[i]];
    const Vec3& b = solid.corner[face.vertex[(i + 1) % face.count]];
    const Vec3& c = solid.corner[face.vertex[(i + 2) % face.count]];
    if (!((b - a).cross(c - b).dot(normal) > 0)) return false;
  }
  return true;
}

/// The corners in a plane, in the order that goes round.
bool add_face(ConvexSolid& solid, const Plane& plane, double tolerance) {
  PolytopeKind::Face face;
  for (std::uint8_t v = 0; v < solid.kind.vertices; ++v) {
    if (std::abs(plane.above(solid.corner[v])) > tolerance) continue;
    if (face.count == face.vertex.size()) return false;
    face.vertex[face.count++] = v;
  }
  if (face.count < 3) return false;
  // The first stays: of three corners two orders are left, of four six.
  auto& v = face.vertex;
  do {
    if (!goes_round(solid, face, plane.normal)) continue;
    solid.kind.face[solid.kind.faces++] = face;
    return true;
  } while (std::next_permutation(v.begin() + 1, v.begin() + face.count));
  return false;
}

/// Whether each edge lies between two faces, and Euler's V - E + F is 2.
bool is_closed(const PolytopeKind& kind) {
  for (std::size_t e = 0; e < kind.edges; ++e) {
    if (kind.edge[e].left == kind.edge[e].right) return false;
  }
  return kind.vertices + kind.faces == kind.edges + 2;
}

}  // namespace

std::optional<ConvexSolid> find_convex_solid(std::span<const std::array<Vec3, 3>> triangles,
                                             double tolerance) {
  const std::optional<std::vector<Plane>> planes = find_planes(triangles, tolerance);
  if (!planes || !is_convex(triangles, *planes, tolerance)) return std::nullopt;
  ConvexSolid solid;
  if (!find_corners(solid, triangles, *planes, tolerance)) return std::nullopt;
  for (const Plane& plane : *planes) {
    if (!add_face(solid, plane, tolerance)) return std::nullopt;
  }
  if (!find_edges(solid.kind) || !is_closed(solid.kind)) return std::nullopt;
  return solid;
}

}  // namespace sunder

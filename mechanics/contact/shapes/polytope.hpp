// SPDX-License-Identifier: MIT
// Small convex solids: tetrahedra, boxes, others of up to six faces, with the faces and edges that
// may be met.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// How vertices, edges and faces of a kind of solid hang together.
struct PolytopeKind {
  struct Edge {
    std::uint8_t from, to;     ///< vertices
    std::uint8_t left, right;  ///< faces
  };
  struct Face {
    std::uint8_t count = 0;                ///< of its vertices
    std::array<std::uint8_t, 4> vertex{};  ///< seen from outside, counter-clockwise
  };
  std::uint8_t vertices = 0, edges = 0, faces = 0;
  std::array<Edge, 12> edge{};
  std::array<Face, 6> face{};
};

/// Face k lies opposite vertex k.
extern const PolytopeKind tetrahedron_kind;
/// Vertex k has the sign of bit i of k along axis i; faces -x, +x, -y, +y, -z, +z.
extern const PolytopeKind box_kind;

/// Finds the edges of the faces; false, and too few, where there are more than a kind may have.
bool find_edges(PolytopeKind& kind);

/// A convex solid of its own kind, in the axes of its body.
struct ConvexSolid {
  static constexpr std::size_t most_faces = 6;
  PolytopeKind kind;
  std::array<Vec3, 8> corner;  ///< m
};

/// A convex solid in world coordinates. Faces and edges that are inside of the body it is a part of
/// do not push anything.
struct Polytope {
  const PolytopeKind* kind = &tetrahedron_kind;
  std::array<Vec3, 8> vertex;                          ///< m
  std::array<Vec3, 6> normal;                          ///< unit, outward
  std::array<Vec3, 12> edge;                           ///< m, from its first vertex to its second
  Vec3 centre = Vec3::Zero();                          ///< m, mean of the vertices
  std::uint32_t outer_faces = ~0u, outer_edges = ~0u;  ///< a bit each

  bool is_outer_face(int f) const { return outer_faces >> f & 1; }
  bool is_outer_edge(int e) const { return outer_edges >> e & 1; }
};

/// A tetrahedron, positively oriented (m), with the bits of the faces that are outside of its body.
/// An edge counts as outside where one of its two faces does.
Polytope make_tetrahedron(const std::array<Vec3, 4>& corners, std::uint32_t outer_faces = ~0u);

/// A solid in its own axes (columns, unit), with their origin at `centre`, m. Keeps the address of
/// its kind.
Polytope make_polytope(const ConvexSolid& solid, const Vec3& centre, const Mat3& axes);

/// A box by its centre and axes (columns, unit) and half its sides, m.
Polytope make_box(const Vec3& centre, const Mat3& axes, const Vec3& half_extent);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Tables of tetrahedra and boxes.
#include "mechanics/contact/shapes/polytope.hpp"

namespace sunder {
namespace {

PolytopeKind with_edges(PolytopeKind kind) {
  find_edges(kind);
  return kind;
}

void finish(Polytope& p) {
  p.centre.setZero();
  for (std::size_t v = 0; v < p.kind->vertices; ++v) p.centre += p.vertex[v];
  p.centre /= p.kind->vertices;
  for (std::size_t e = 0; e < p.kind->edges; ++e) {
    p.edge[e] = p.vertex[p.kind->edge[e].to] - p.vertex[p.kind->edge[e].from];
  }
  for (std::size_t f = 0; f < p.kind->faces; ++f) {
    const auto& at = p.kind->face[f].vertex;
    p.normal[f] =
        (p.vertex[at[1]] - p.vertex[at[0]]).cross(p.vertex[at[2]] - p.vertex[at[0]]).normalized();
  }
}

}  // namespace

bool find_edges(PolytopeKind& kind) {
  const auto for_each_side = [&](auto visit) {
    for (std::uint8_t f = 0; f < kind.faces; ++f) {
      const PolytopeKind::Face& face = kind.face[f];
      for (std::size_t i = 0; i < face.count; ++i) {
        visit(f, face.vertex[i], face.vertex[(i + 1) % face.count]);
      }
    }
  };
  bool fits = true;
  for_each_side([&](std::uint8_t f, std::uint8_t from, std::uint8_t to) {
    if (from > to) return;
    fits = fits && kind.edges < kind.edge.size();
    if (fits) kind.edge[kind.edges++] = {from, to, f, f};
  });
  for_each_side([&](std::uint8_t f, std::uint8_t from, std::uint8_t to) {
    for (std::size_t e = 0; e < kind.edges; ++e) {
      if (kind.edge[e].from == to && kind.edge[e].to == from) kind.edge[e].right = f;
    }
  });
  return fits;
}

const PolytopeKind tetrahedron_kind = with_edges(
    {4,
     0,
     4,
     {},
     {{{3, {1, 2, 3, 0}}, {3, {0, 3, 2, 0}}, {3, {0, 1, 3, 0}}, {3, {0, 2, 1, 0}}, {}, {}}}});

const PolytopeKind box_kind = with_edges({8,
                                          0,
                                          6,
                                          {},
                                          {{{4, {0, 4, 6, 2}},
                                            {4, {1, 3, 7, 5}},
                                            {4, {0, 1, 5, 4}},
                                            {4, {2, 6, 7, 3}},
                                            {4, {0, 2, 3, 1}},
                                            {4, {4, 5, 7, 6}}}}});

Polytope make_tetrahedron(const std::array<Vec3, 4>& corners, std::uint32_t outer_faces) {
  Polytope p;
  for (std::size_t v = 0; v < 4; ++v) p.vertex[v] = corners[v];
  p.outer_faces = outer_faces & 15u;
  p.outer_edges = 0;
  for (std::size_t e = 0; e < tetrahedron_kind.edges; ++e) {
    const PolytopeKind::Edge& edge = tetrahedron_kind.edge[e];
    if (p.is_outer_face(edge.left) || p.is_outer_face(edge.right)) p.outer_edges |= 1u << e;
  }
  finish(p);
  return p;
}

Polytope make_polytope(const ConvexSolid& solid, const Vec3& centre, const Mat3& axes) {
  Polytope p;
  p.kind = &solid.kind;
  for (std::size_t v = 0; v < solid.kind.vertices; ++v) {
    p.vertex[v] = centre + axes * solid.corner[v];
  }
  finish(p);
  return p;
}

Polytope make_box(const Vec3& centre, const Mat3& axes, const Vec3& half_extent) {
  Polytope p;
  p.kind = &box_kind;
  for (std::size_t v = 0; v < 8; ++v) {
    const Vec3 sign(v & 1 ? 1 : -1, v & 2 ? 1 : -1, v & 4 ? 1 : -1);
    p.vertex[v] = centre + axes * sign.cwiseProduct(half_extent);
  }
  finish(p);
  return p;
}

}  // namespace sunder

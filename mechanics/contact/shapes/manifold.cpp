// SPDX-License-Identifier: MIT
// Separating axes by the Gauss map, clipping of faces, closest points of edges.
#include "mechanics/contact/shapes/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunder {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// How far `other` lies outside of the plane of a face, m.
double face_separation(const Polytope& of, int face, const Polytope& other) {
  const auto f = static_cast<std::size_t>(face);
  const Vec3& n = of.normal[f];
  double least = infinite;
  for (std::size_t v = 0; v < other.kind->vertices; ++v) {
    least = std::min(least, n.dot(other.vertex[v]));
  }
  return least - n.dot(of.vertex[of.kind->face[f].vertex[0]]);
}

struct EdgeAxis {
  bool crosses = false;
  double separation = -infinite;
  Vec3 normal{0, 0, 0};  ///< out of A
};

/// The axis of two edges: the crossing of their arcs on the Gauss map of A - B. Each arc runs from
/// the normal of one face of its edge to that of the other. There is none unless each arc crosses
/// the plane of the other.
EdgeAxis crossing(const Polytope& a, std::size_t i, const Polytope& b, std::size_t j) {
  const PolytopeKind::Edge& e = a.kind->edge[i];
  const PolytopeKind::Edge& f = b.kind->edge[j];
  const Vec3 &u = a.edge[i], &v = b.edge[j];
  Vec3 normal = u.cross(v);
  const double squared = normal.squaredNorm();
  if (squared <= 1e-12 * u.squaredNorm() * v.squaredNorm()) return {};
  // Both cross it in one hemisphere.
  const double side = normal.dot(a.normal[e.left] + a.normal[e.right]);
  if (side * normal.dot(b.normal[f.left] + b.normal[f.right]) >= 0) return {};
  normal *= (side > 0 ? 1 : -1) / std::sqrt(squared);
  return {true, normal.dot(b.vertex[f.from] - a.vertex[e.from]), normal};
}

/// The axis of two edges, if their arcs cross.
EdgeAxis edge_axis(const Polytope& a, std::size_t i, const Polytope& b, std::size_t j) {
  const PolytopeKind::Edge& e = a.kind->edge[i];
  const PolytopeKind::Edge& f = b.kind->edge[j];
  const Vec3 &u = a.edge[i], &v = b.edge[j];
  if (b.normal[f.left].dot(u) * b.normal[f.right].dot(u) >= 0) return {};
  if (a.normal[e.left].dot(v) * a.normal[e.right].dot(v) >= 0) return {};
  return crossing(a, i, b, j);
}

/// Along an axis: how far two solids are apart (m), and the way out of A.
struct AxisGap {
  double separation = -infinite;
  Vec3 out_of_a{0, 0, 0};
};

AxisGap gap_along(const Polytope& a, const Polytope& b, const PairAxis& axis) {
  switch (axis.kind) {
    case PairAxis::Kind::face_of_a:
      return {face_separation(a, axis.a, b), a.normal[axis.a]};
    case PairAxis::Kind::face_of_b:
      return {face_separation(b, axis.b, a), -b.normal[axis.b]};
    case PairAxis::Kind::edges: {
      const EdgeAxis edge = edge_axis(a, axis.a, b, axis.b);
      return edge.crosses ? AxisGap{edge.separation, edge.normal} : AxisGap{};
    }
    case PairAxis::Kind::none:
      break;
  }
  return {};
}

/// Whether an axis keeps two solids apart.
bool parts(const Polytope& a, const Polytope& b, const Approach& approach, const PairAxis& axis) {
  const AxisGap gap = gap_along(a, b, axis);
  return gap.separation > approach.along(gap.out_of_a);
}

/// A convex polygon of up to four corners, cut by up to four planes.
struct Patch {
  std::array<Vec3, 12> corner;
  std::size_t count = 0;
  void add(const Vec3& c) {
    if (count < corner.size()) corner[count++] = c;
  }
};

/// The part of a patch behind the plane through `at` across `normal`.
Patch cut(const Patch& patch, const Vec3& at, const Vec3& normal) {
  Patch kept;
  for (std::size_t i = 0; i < patch.count; ++i) {
    const Vec3& from = patch.corner[i];
    const Vec3& to = patch.corner[(i + 1) % patch.count];
    const double d = normal.dot(from - at), e = normal.dot(to - at);
    if (d <= 0) kept.add(from);
    if ((d < 0 && e > 0) || (d > 0 && e < 0)) kept.add(from + d / (d - e) * (to - from));
  }
  return kept;
}

/// Four corners that span a patch: the deepest, the farthest from it, and the farthest from their
/// line on either side.
void keep_four(std::array<Manifold::Point, 12>& points, int& count, const Vec3& normal) {
  if (count <= 4) return;
  const auto all = static_cast<std::size_t>(count);
  const auto bring = [&](std::size_t place, auto value) {
    std::size_t best = place;
    for (std::size_t k = place; k < all; ++k) {
      if (value(points[k]) > value(points[best])) best = k;
    }
    std::swap(points[place], points[best]);
  };
  bring(0, [&](const Manifold::Point& p) { return -p.separation; });
  const Vec3 first = points[0].on_b;
  bring(1, [&](const Manifold::Point& p) { return (p.on_b - first).squaredNorm(); });
  const Vec3 across = normal.cross(points[1].on_b - first);
  bring(2, [&](const Manifold::Point& p) { return across.dot(p.on_b - first); });
  bring(3, [&](const Manifold::Point& p) { return -across.dot(p.on_b - first); });
  count = 4;
}

/// The patch of a face and the face of the other solid that looks at it most.
Manifold clip_faces(const Polytope& of, int face, const Polytope& other, const Approach& approach,
                    bool face_is_of_a) {
  const auto f = static_cast<std::size_t>(face);
  const Vec3& n = of.normal[f];
  std::size_t incident = 0;
  for (std::size_t k = 1; k < other.kind->faces; ++k) {
    if (n.dot(other.normal[k]) < n.dot(other.normal[incident])) incident = k;
  }
  Patch patch;
  const PolytopeKind::Face& met = other.kind->face[incident];
  for (std::size_t i = 0; i < met.count; ++i) patch.add(other.vertex[met.vertex[i]]);
  const PolytopeKind::Face& own = of.kind->face[f];
  for (std::size_t i = 0; i < own.count; ++i) {
    const Vec3& from = of.vertex[own.vertex[i]];
    const Vec3& to = of.vertex[own.vertex[(i + 1) % own.count]];
    patch = cut(patch, from, (to - from).cross(n));
  }
  Manifold m;
  m.normal = face_is_of_a ? Vec3(-n) : n;
  const double most = approach.along(-m.normal);
  std::array<Manifold::Point, 12> points;
  int count = 0;
  const Vec3& plane = of.vertex[own.vertex[0]];
  for (std::size_t i = 0; i < patch.count; ++i) {
    const Vec3& at = patch.corner[i];
    const double separation = n.dot(at - plane);
    if (separation > most) continue;
    const Vec3 foot = at - separation * n;
    Manifold::Point& p = points[static_cast<std::size_t>(count++)];
    p.on_a = face_is_of_a ? foot : at;
    p.on_b = face_is_of_a ? at : foot;
    p.separation = separation;
  }
  keep_four(points, count, n);
  m.count = count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) m.point[i] = points[i];
  return m;
}

Manifold touch_of_edges(const Polytope& a, const Polytope& b, const PairAxis& axis,
                        const Vec3& out_of_a, const Approach& approach) {
  const PolytopeKind::Edge& e = a.kind->edge[axis.a];
  const PolytopeKind::Edge& f = b.kind->edge[axis.b];
  const Vec3 &u = a.edge[axis.a], &v = b.edge[axis.b];
  const auto [s, t] = nearest_of_segments(a.vertex[e.from], u, b.vertex[f.from], v);
  Manifold m;
  m.normal = -out_of_a;
  Manifold::Point& p = m.point[0];
  p.on_a = a.vertex[e.from] + s * u;
  p.on_b = b.vertex[f.from] + t * v;
  p.separation = m.normal.dot(p.on_a - p.on_b);
  m.count = p.separation <= approach.along(out_of_a) ? 1 : 0;
  return m;
}

/// The best axis so far among those that may push, and how far all others separate.
struct Best {
  PairAxis axis;
  double separation = -infinite;
  Vec3 normal{0, 0, 0};
  double inside = -infinite;  ///< m, by faces and edges inside of bodies
};

/// Faces of one of the two; true where one of them separates them.
bool try_faces(Best& best, const Polytope& of, const Polytope& other, const Approach& approach,
               bool is_a, PairAxis& last) {
  for (std::uint8_t f = 0; f < of.kind->faces; ++f) {
    const double separation = face_separation(of, f, other);
    const PairAxis axis = is_a ? PairAxis{PairAxis::Kind::face_of_a, f, 0}
                               : PairAxis{PairAxis::Kind::face_of_b, 0, f};
    if (separation > approach.along(is_a ? of.normal[f] : Vec3(-of.normal[f]))) {
      last = axis;
      return true;
    }
    if (!of.is_outer_face(f)) {
      best.inside = std::max(best.inside, separation);
    } else if (separation > best.separation) {
      best = {axis, separation, of.normal[f], best.inside};
    }
  }
  return false;
}

/// On which side of each edge of `of` the normals of `other`'s faces lie: row = edge, column =
/// face.
using AxisSides = std::array<std::array<double, 6>, 12>;
void find_sides(AxisSides& sides, const Polytope& of, const Polytope& other) {
  for (std::size_t e = 0; e < of.kind->edges; ++e) {
    for (std::size_t f = 0; f < other.kind->faces; ++f) {
      sides[e][f] = of.edge[e].dot(other.normal[f]);
    }
  }
}

bool try_edges(Best& best, const Polytope& a, const Polytope& b, const Approach& approach,
               PairAxis& last) {
  AxisSides of_a, of_b;
  find_sides(of_a, a, b);
  find_sides(of_b, b, a);
  for (std::uint8_t e = 0; e < a.kind->edges; ++e) {
    const PolytopeKind::Edge& i = a.kind->edge[e];
    for (std::uint8_t f = 0; f < b.kind->edges; ++f) {
      const PolytopeKind::Edge& j = b.kind->edge[f];
      // Most pairs of arcs do not cross.
      if (of_a[e][j.left] * of_a[e][j.right] >= 0 || of_b[f][i.left] * of_b[f][i.right] >= 0) {
        continue;
      }
      const EdgeAxis found = crossing(a, e, b, f);
      if (!found.crosses) continue;
      const PairAxis axis{PairAxis::Kind::edges, e, f};
      if (found.separation > approach.along(found.normal)) {
        last = axis;
        return true;
      }
      if (!a.is_outer_edge(e) || !b.is_outer_edge(f)) {
        best.inside = std::max(best.inside, found.separation);
      } else if (found.separation > best.separation) {
        best = {axis, found.separation, found.normal, best.inside};
      }
    }
  }
  return false;
}

}  // namespace

std::array<double, 2> nearest_of_segments(const Vec3& p, const Vec3& u, const Vec3& q,
                                          const Vec3& v) {
  const Vec3 r = p - q;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double ur = u.dot(r), vr = v.dot(r);
  const double across = uu * vv - uv * uv;
  double s = across > 0 ? std::clamp((uv * vr - vv * ur) / across, 0.0, 1.0) : 0;
  const double t = std::clamp((uv * s + vr) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - ur) / uu, 0.0, 1.0);
  return {s, t};
}

Manifold collide(const Polytope& a, const Polytope& b, const Approach& approach, PairAxis& last) {
  if (parts(a, b, approach, last)) return {};
  Best face, edge;
  if (try_faces(face, a, b, approach, true, last)) return {};
  if (try_faces(face, b, a, approach, false, last)) return {};
  if (try_edges(edge, a, b, approach, last)) return {};
  // Faces carry patches: an edge has to be better by more than rounding and a hair.
  const double hair = 1e-3 * (a.vertex[0] - a.centre).norm();
  // A face or edge inside of a body may part them better: then its neighbours there meet the other
  // body.
  const double best = std::max(face.separation, edge.separation);
  if (std::max(face.inside, edge.inside) > best + hair) return {};
  if (edge.separation > face.separation + hair) {
    last = edge.axis;
    return touch_of_edges(a, b, edge.axis, edge.normal, approach);
  }
  last = face.axis;
  if (face.axis.kind == PairAxis::Kind::none) return {};
  if (face.axis.kind == PairAxis::Kind::face_of_a) {
    return clip_faces(a, face.axis.a, b, approach, true);
  }
  return clip_faces(b, face.axis.b, a, approach, false);
}

Manifold collide_ball(const Vec3& centre, double radius, const Polytope& b,
                      const Approach& approach) {
  Manifold m;
  // Inside: the nearest outer face. Outside: the nearest point of all faces.
  double deepest = -infinite;
  std::size_t nearest_face = 0;
  bool inside = true;
  for (std::size_t f = 0; f < b.kind->faces; ++f) {
    const double d = b.normal[f].dot(centre - b.vertex[b.kind->face[f].vertex[0]]);
    inside = inside && d <= 0;
    if (d > deepest) {
      deepest = d;
      nearest_face = f;
    }
  }
  if (deepest > radius + approach.margin + approach.way.norm()) return m;
  Manifold::Point& p = m.point[0];
  if (inside) {
    m.normal = b.normal[nearest_face];
    p.on_b = centre - deepest * m.normal;
  } else {
    double least = infinite;
    for (std::size_t f = 0; f < b.kind->faces; ++f) {
      const PolytopeKind::Face& face = b.kind->face[f];
      const Vec3& n = b.normal[f];
      Vec3 foot = centre - n.dot(centre - b.vertex[face.vertex[0]]) * n;
      for (std::size_t i = 0; i < face.count; ++i) {
        const Vec3& from = b.vertex[face.vertex[i]];
        const Vec3 side = b.vertex[face.vertex[(i + 1) % face.count]] - from;
        if (side.cross(n).dot(centre - from) <= 0) continue;
        const double share = std::clamp(side.dot(centre - from) / side.squaredNorm(), 0.0, 1.0);
        const Vec3 at = from + share * side;
        if ((at - centre).squaredNorm() < least) {
          least = (at - centre).squaredNorm();
          p.on_b = at;
        }
        foot = Vec3::Constant(infinite);
      }
      if (foot.allFinite() && (foot - centre).squaredNorm() < least) {
        least = (foot - centre).squaredNorm();
        p.on_b = foot;
      }
    }
    m.normal = (centre - p.on_b).normalized();
  }
  p.on_a = centre - radius * m.normal;
  p.separation = m.normal.dot(p.on_a - p.on_b);
  m.count = p.separation <= approach.along(-m.normal) ? 1 : 0;
  return m;
}

double separation_along(const Polytope& a, const Polytope& b, const PairAxis& axis) {
  return gap_along(a, b, axis).separation;
}

double separation_by_all_axes(const Polytope& a, const Polytope& b) {
  double largest = -infinite;
  const auto along_axis = [&](const Vec3& n) {
    double a_least = infinite, a_most = -infinite, b_least = infinite, b_most = -infinite;
    for (std::size_t v = 0; v < a.kind->vertices; ++v) {
      const double x = n.dot(a.vertex[v]);
      a_least = std::min(a_least, x);
      a_most = std::max(a_most, x);
    }
    for (std::size_t v = 0; v < b.kind->vertices; ++v) {
      const double x = n.dot(b.vertex[v]);
      b_least = std::min(b_least, x);
      b_most = std::max(b_most, x);
    }
    largest = std::max({largest, b_least - a_most, a_least - b_most});
  };
  for (std::size_t f = 0; f < a.kind->faces; ++f) along_axis(a.normal[f]);
  for (std::size_t f = 0; f < b.kind->faces; ++f) along_axis(b.normal[f]);
  for (std::size_t e = 0; e < a.kind->edges; ++e) {
    for (std::size_t f = 0; f < b.kind->edges; ++f) {
      const Vec3 n = a.edge[e].cross(b.edge[f]);
      const double sizes = a.edge[e].squaredNorm() * b.edge[f].squaredNorm();
      if (n.squaredNorm() > 1e-12 * sizes) along_axis(n.normalized());
    }
  }
  return largest;
}

}  // namespace sunder

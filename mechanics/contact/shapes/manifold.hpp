// SPDX-License-Identifier: MIT
// Where two convex solids touch: separating axes, and the patch between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "mechanics/contact/shapes/polytope.hpp"

namespace sunder {

/// A contact manifold: up to four points that span the patch between two solids.
struct Manifold {
  struct Point {
    Vec3 on_a, on_b;        ///< m
    double separation = 0;  ///< normal . (on_a - on_b), m; negative: overlap
  };
  Vec3 normal{0, 0, 1};  ///< unit, from B to A
  int count = 0;
  std::array<Point, 4> point;
};

/// The axis by which a pair was decided last: tried first the next time.
struct PairAxis {
  enum class Kind : std::uint8_t { none, face_of_a, face_of_b, edges };
  Kind kind = Kind::none;
  std::uint8_t a = 0, b = 0;  ///< a face, or an edge of each
};

/// How far two solids may come nearer before they are looked at again.
struct Approach {
  Vec3 way{0, 0, 0};  ///< m, of A against B
  double margin = 0;  ///< m, >= 0, in any other direction
  /// Along a unit vector out of A.
  double along(const Vec3& out_of_a) const { return margin + std::max(0.0, out_of_a.dot(way)); }
};

/// Shares, in [0, 1], of the ways u and v along two segments from p and q (m), at which these are
/// nearest.
std::array<double, 2> nearest_of_segments(const Vec3& p, const Vec3& u, const Vec3& q,
                                          const Vec3& v);

/// The patch between two solids that may touch along each of their separating axes. These are the
/// normals of their faces, and the products of edges with arcs that cross on the Gauss map
/// [Gregorius 2013, GDC]. There is no point where one axis separates the solids. The same holds
/// where a face or edge inside of a body separates them best: other parts of that body then meet.
/// For overlapping solids the normal is that of least overlap.
Manifold collide(const Polytope& a, const Polytope& b, const Approach& approach, PairAxis& last);

/// m: how far an axis keeps two solids apart; they are no nearer. Negative: it does not.
double separation_along(const Polytope& a, const Polytope& b, const PairAxis& axis);

/// The same for a ball, which is side A: one point at most.
Manifold collide_ball(const Vec3& centre, double radius, const Polytope& b,
                      const Approach& approach);

/// Largest separation of two convex solids along any axis of their faces and pairs of edges, m.
/// Negative where they overlap, by as much as they would have to move. No pruning: the slow twin of
/// `collide` for tests and for the search for overlaps.
double separation_by_all_axes(const Polytope& a, const Polytope& b);

}  // namespace sunder

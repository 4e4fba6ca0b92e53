// SPDX-License-Identifier: MIT
// Differences and products of points, for sources that need no more than that.
#pragma once

#include <algorithm>
#include <cmath>

#include "topology/base/tet_mesh.hpp"

namespace sunder::detail {

inline Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Six times the volume of a tetrahedron, det(b - a, c - a, d - a), with its sign: positive where d
/// lies on the side of a, b, c from which they run anticlockwise.
inline double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(difference(b, a), cross(difference(c, a), difference(d, a)));
}

inline Point middle(const Point& a, const Point& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

/// The distance, for all points that there are: no square overflows or vanishes.
inline double distance(const Point& a, const Point& b) {
  const Point d = difference(a, b);
  const double largest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  if (!(largest > 0) || std::isinf(largest)) return largest;
  return largest * length({d[0] / largest, d[1] / largest, d[2] / largest});
}

}  // namespace sunder::detail

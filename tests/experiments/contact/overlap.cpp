// SPDX-License-Identifier: MIT
// Separating axes of tetrahedra and obstacles.
#include "tests/experiments/contact/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder::test {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();
constexpr std::array<std::array<int, 3>, 4> faces = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

/// The interval of points along an axis.
struct Extent {
  double low = far_away, high = -far_away;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

template <class Points>
Extent extent(const Points& points, const Vec3& axis) {
  Extent e;
  for (const Vec3& p : points) e.add(p.dot(axis));
  return e;
}

/// Lowers `least` to the overlap along an axis. An axis without length is left out.
template <class A, class B>
void try_axis(double& least, const A& a, const B& b, const Vec3& axis, double scale) {
  const double length = axis.norm();
  if (length <= 1e-12 * scale) return;
  const Extent x = extent(a, axis), y = extent(b, axis);
  least = std::min(least, std::min(x.high - y.low, y.high - x.low) / length);
}

Vec3 face_axis(const TetCorners& t, std::size_t face) {
  const auto& f = faces[face];
  return (corner(t, f[1]) - corner(t, f[0])).cross(corner(t, f[2]) - corner(t, f[0]));
}

double squared_size(const TetCorners& t) {
  double most = 0;
  for (const auto& e : tet_edges)
    most = std::max(most, (corner(t, e[1]) - corner(t, e[0])).squaredNorm());
  return most;
}

/// The point of a triangle that is nearest to `p` [Ericson 2005, section 5.1.5].
Vec3 nearest_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return sum > 0 ? Vec3(a + vb / sum * ab + vc / sum * ac) : a;
}

/// m: how deep a point lies in a tetrahedron; negative: how far outside.
double depth_in_tetrahedron(const Vec3& p, const TetCorners& t) {
  double inside = far_away, outside = far_away;
  for (std::size_t f = 0; f < 4; ++f) {
    Vec3 n = face_axis(t, f).normalized();
    const Vec3& on = corner(t, faces[f][0]);
    if (n.dot(t[f] - on) < 0) n = -n;
    inside = std::min(inside, n.dot(p - on));
    const Vec3 nearest = nearest_of_triangle(p, on, corner(t, faces[f][1]), corner(t, faces[f][2]));
    outside = std::min(outside, (p - nearest).norm());
  }
  return inside >= 0 ? inside : -outside;
}

/// m: how deep a point lies in a closed surface, by its solid angle.
double depth_in_solid(const Vec3& p, const std::vector<Vec3>& points,
                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  double angle = 0, distance = far_away;
  for (const auto& t : triangles) {
    const Vec3 a = points[t[0]] - p, b = points[t[1]] - p, c = points[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    const Vec3 nearest = nearest_of_triangle(p, points[t[0]], points[t[1]], points[t[2]]);
    distance = std::min(distance, (p - nearest).norm());
  }
  return std::abs(angle) > 2 * std::numbers::pi ? distance : -distance;
}

double overlap_with(const TetCorners& t, const Plane& plane) {
  return plane.offset - extent(t, plane.normal).low;
}

double overlap_with(const TetCorners& t, const Sphere& ball) {
  return ball.radius + depth_in_tetrahedron(ball.center, t);
}

double overlap_with(const TetCorners& t, const Box& box) {
  std::array<Vec3, 8> corners;
  const Mat3 R = box.orientation.toRotationMatrix();
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 sign(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners[k] = box.center + R * sign.cwiseProduct(box.half_extent);
  }
  double least = far_away;
  for (int axis = 0; axis < 3; ++axis) try_axis(least, t, corners, R.col(axis), 1);
  const double scale = squared_size(t);
  for (std::size_t f = 0; f < 4; ++f) try_axis(least, t, corners, face_axis(t, f), scale);
  for (const auto& e : tet_edges) {
    const Vec3 way = corner(t, e[1]) - corner(t, e[0]);
    for (int axis = 0; axis < 3; ++axis) {
      try_axis(least, t, corners, way.cross(R.col(axis)), std::sqrt(scale));
    }
  }
  return least;
}

double overlap_with(const TetCorners& t, const Solid& solid) {
  std::vector<Vec3> points = solid.surface->points;
  for (Vec3& p : points) p = solid.orientation * p + solid.translation;
  double most = -far_away;
  for (const Vec3& p : t)
    most = std::max(most, depth_in_solid(p, points, solid.surface->triangles));
  for (const Vec3& p : points) most = std::max(most, depth_in_tetrahedron(p, t));
  return most;
}

}  // namespace

double overlap(const TetCorners& a, const TetCorners& b) {
  const double scale = std::sqrt(squared_size(a) * squared_size(b));
  double least = far_away;
  for (std::size_t f = 0; f < 4; ++f) {
    try_axis(least, a, b, face_axis(a, f), scale);
    try_axis(least, a, b, face_axis(b, f), scale);
  }
  for (const auto& e : tet_edges) {
    const Vec3 way = corner(a, e[1]) - corner(a, e[0]);
    for (const auto& g : tet_edges) {
      try_axis(least, a, b, way.cross(corner(b, g[1]) - corner(b, g[0])), scale);
    }
  }
  return least;
}

double overlap(const TetCorners& a, const Shape& shape) {
  return std::visit([&](const auto& s) { return overlap_with(a, s); }, shape);
}

}  // namespace sunder::test

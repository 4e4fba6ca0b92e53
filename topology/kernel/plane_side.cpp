// SPDX-License-Identifier: MIT
// The sign rule and canonical directions.
#include "topology/kernel/plane_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "topology/base/point_math.hpp"

namespace sunder {
namespace {

double largest_magnitude(const Point& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

}  // namespace

Point canonical_direction(const Point& n, const Point& octant) {
  const double equal = (1 - equal_directions) * largest_magnitude(n);
  std::size_t axis = 0;
  while (std::abs(n[axis]) < equal) ++axis;
  return n[axis] * octant[axis] < 0 ? Point{-n[0], -n[1], -n[2]} : n;
}

std::optional<Point> read_direction(const Point& normal) {
  for (const double x : normal) {
    if (!std::isfinite(x)) return std::nullopt;
  }
  const double scale = largest_magnitude(normal);
  if (scale == 0) return std::nullopt;
  return canonical_direction({normal[0] / scale, normal[1] / scale, normal[2] / scale});
}

std::optional<PlaneThrough> read_plane(const CuttingPlane& plane) {
  const std::optional<Point> n = read_direction(plane.normal);
  if (!n || !std::isfinite(plane.offset)) return std::nullopt;
  // The normal as given is `scale` times the direction.
  std::size_t axis = 0;
  while (std::abs((*n)[axis]) < 1) ++axis;
  const double scale = plane.normal[axis] / (*n)[axis];
  const double s = plane.offset / scale / detail::dot(*n, *n);
  return PlaneThrough{{s * (*n)[0], s * (*n)[1], s * (*n)[2]}, *n};
}

CentreOffset centre_offset(const std::array<Point, 4>& corners, const Point& at) {
  CentreOffset centre{{0, 0, 0}};
  double size = largest_magnitude(at);
  for (const Point& x : corners) {
    size = std::max(size, largest_magnitude(x));
    for (int i = 0; i < 3; ++i) centre.away[i] += (x[i] - at[i]) / 4;
  }
  double square = 0;
  for (const Point& x : corners) {
    const Point spoke = detail::difference(detail::difference(x, at), centre.away);
    square = std::max(square, detail::dot(spoke, spoke));
  }
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  centre.tolerance = equal_directions * std::sqrt(square) + rounding * size;
  return centre;
}

PlaneSide plane_side(const Point& normal, const CentreOffset& centre) {
  const double distance = detail::dot(normal, centre.away);
  const double tolerance = std::sqrt(detail::dot(normal, normal)) * centre.tolerance;
  if (distance < -tolerance) return PlaneSide::negative;
  return distance <= tolerance ? PlaneSide::on : PlaneSide::positive;
}

bool is_positive(const PlaneThrough& plane, const std::array<Point, 4>& corners) {
  return plane_side(plane.normal, centre_offset(corners, plane.at)) != PlaneSide::negative;
}

}  // namespace sunder

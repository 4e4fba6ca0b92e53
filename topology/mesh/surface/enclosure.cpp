// SPDX-License-Identifier: MIT
#include "topology/mesh/surface/enclosure.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "topology/base/point_math.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::dot;

/// Of rays: along no axis, and along no plane that objects have.
constexpr Point ray_way = {0.5377, 0.7121, 0.4517};

bool ray_meets(const BoundingBox& box, const Point& p) {
  double from = 0, to = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    from = std::max(from, (box.low[k] - p[k]) / ray_way[k]);
    to = std::min(to, (box.high[k] - p[k]) / ray_way[k]);
  }
  return from <= to;
}

bool ray_meets(const std::array<Point, 3>& corners, const Point& p) {
  const Point a = difference(corners[0], p), b = difference(corners[1], p),
              c = difference(corners[2], p);
  const double u = dot(ray_way, cross(a, b)), v = dot(ray_way, cross(b, c)),
               w = dot(ray_way, cross(c, a));
  if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return false;
  // u, v, w are the shares of c, a, b at the point where the line meets the plane.
  return (u * dot(c, ray_way) + v * dot(a, ray_way) + w * dot(b, ray_way)) / (u + v + w) > 0;
}

}  // namespace

Enclosure::Enclosure(std::vector<Point> points, std::vector<std::array<std::uint32_t, 3>> triangles)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      tree_(box_tree(points_, triangles_)) {}

bool Enclosure::holds(const Point& p) const {
  bool inside = false;
  for_each_box(
      tree_, [&](const BoundingBox& box) { return ray_meets(box, p); },
      [&](std::uint32_t row) {
        const auto& t = triangles_[row];
        inside = inside != ray_meets({points_[t[0]], points_[t[1]], points_[t[2]]}, p);
      });
  return inside;
}

}  // namespace sunder

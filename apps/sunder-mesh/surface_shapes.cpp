// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces made from numbers, and the placing of points.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/sunder-mesh/surface.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

struct Bounds {
  Point low{};
  Point high{};
};

Bounds bounds_of(const std::vector<Point>& points) {
  if (points.empty()) return {};
  Bounds b{points.front(), points.front()};
  for (const Point& p : points) {
    for (int k = 0; k < 3; ++k) {
      b.low[k] = std::min(b.low[k], p[k]);
      b.high[k] = std::max(b.high[k], p[k]);
    }
  }
  return b;
}

void add_quad(Surface& surface, std::array<std::uint32_t, 4> q) {
  surface.triangles.push_back({q[0], q[1], q[2]});
  surface.triangles.push_back({q[0], q[2], q[3]});
}

}  // namespace

Surface box_surface(const std::array<double, 3>& edge_lengths) {
  SUNDER_ASSERT(*std::min_element(edge_lengths.begin(), edge_lengths.end()) > 0,
                "a box has positive edges");
  Surface s;
  for (int corner = 0; corner < 8; ++corner) {
    s.points.push_back({edge_lengths[0] * ((corner & 1) - 0.5),
                        edge_lengths[1] * (((corner >> 1) & 1) - 0.5),
                        edge_lengths[2] * ((corner >> 2) & 1)});
  }
  for (const auto& quad : std::array<std::array<std::uint32_t, 4>, 6>{
           {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}}) {
    add_quad(s, quad);
  }
  return s;
}

Surface ring_surface(const RingShape& shape) {
  SUNDER_ASSERT(
      shape.outer_radius > shape.inner_radius && shape.inner_radius > 0 && shape.height > 0,
      "a ring has a hole, a wall and a height");
  Surface s;
  constexpr std::uint32_t n = ring_segments;
  // Four circles: outer low, outer high, inner low, inner high.
  for (const auto& [radius, z] :
       {std::pair{shape.outer_radius, 0.0}, std::pair{shape.outer_radius, shape.height},
        std::pair{shape.inner_radius, 0.0}, std::pair{shape.inner_radius, shape.height}}) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      s.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    add_quad(s, {k, next, n + next, n + k});
    add_quad(s, {2 * n + next, 2 * n + k, 3 * n + k, 3 * n + next});
    add_quad(s, {n + k, n + next, 3 * n + next, 3 * n + k});
    add_quad(s, {next, k, 2 * n + k, 2 * n + next});
  }
  return s;
}

void turn_up(std::vector<Point>& points, UpAxis up) {
  for (Point& p : points) {
    const auto [x, y, z] = p;
    switch (up) {
      case UpAxis::x:
        p = {-z, y, x};
        break;
      case UpAxis::minus_x:
        p = {z, y, -x};
        break;
      case UpAxis::y:
        p = {x, -z, y};
        break;
      case UpAxis::minus_y:
        p = {x, z, -y};
        break;
      case UpAxis::z:
        break;
      case UpAxis::minus_z:
        p = {x, -y, -z};
        break;
    }
  }
}

void scale_to_height(std::vector<Point>& points, double height) {
  const Bounds b = bounds_of(points);
  const double extent = b.high[2] - b.low[2];
  SUNDER_ASSERT(height > 0 && extent > 0, "only a body of some height can be scaled to one");
  const double factor = height / extent;
  for (Point& p : points) p = {p[0] * factor, p[1] * factor, p[2] * factor};
}

void stand_on_ground(std::vector<Point>& points) {
  const Bounds b = bounds_of(points);
  const double middle_x = (b.low[0] + b.high[0]) / 2;
  const double middle_y = (b.low[1] + b.high[1]) / 2;
  for (Point& p : points) p = {p[0] - middle_x, p[1] - middle_y, p[2] - b.low[2]};
}

double bounding_diagonal(const std::vector<Point>& points) {
  const Bounds b = bounds_of(points);
  return std::hypot(b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]);
}

}  // namespace sunder

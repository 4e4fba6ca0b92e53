// SPDX-License-Identifier: MIT
#include "topology/mesh/surface/surface_gap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "topology/base/point_math.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::dot, detail::length;
using Corners = std::array<std::uint32_t, 3>;

Point mixed(const Point& a, const Point& b, const Point& c, double v, double w) {
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + v * (b[k] - a[k]) + w * (c[k] - a[k]);
  return p;
}

double square_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point way = difference(b, a), from = difference(p, a);
  const double square = dot(way, way);
  const double t = square > 0 ? std::clamp(dot(from, way) / square, 0.0, 1.0) : 0;
  const Point off = {from[0] - t * way[0], from[1] - t * way[1], from[2] - t * way[2]};
  return dot(off, off);
}

/// The square of the distance from `p` to a triangle.
double square_to(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point normal = cross(difference(b, a), difference(c, a));
  const double square = dot(normal, normal);
  if (square > 0) {
    const Point pa = difference(a, p), pb = difference(b, p), pc = difference(c, p);
    const bool is_over = dot(cross(pa, pb), normal) >= 0 && dot(cross(pb, pc), normal) >= 0 &&
                         dot(cross(pc, pa), normal) >= 0;
    if (is_over) {
      const double off = dot(pa, normal);
      return off * off / square;
    }
  }
  return std::min(
      {square_to_segment(p, a, b), square_to_segment(p, b, c), square_to_segment(p, c, a)});
}

double square_to(const Point& p, const BoundingBox& box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double off = std::max({box.low[k] - p[k], 0.0, p[k] - box.high[k]});
    sum += off * off;
  }
  return sum;
}

struct Sampling {
  double spacing;
  double sum = 0;
  std::size_t count = 0;
  SurfaceGap gap;

  void add(const NearTriangles& other, const Point& p) {
    const double d = other.distance(p);
    sum += d;
    ++count;
    if (d > gap.largest) {
      gap.largest = d;
      gap.place = p;
    }
  }
};

void sample(Sampling& s, const NearTriangles& other, const Point& a, const Point& b,
            const Point& c) {
  const double longest =
      std::max({length(difference(b, a)), length(difference(c, b)), length(difference(a, c))});
  const auto n = whole_number<std::size_t>(std::clamp(std::ceil(longest / s.spacing), 1.0, 200.0));
  const double part = 1 / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; i + k < n; ++k) {
      // Centres of the small triangles that look the same way.
      s.add(other, mixed(a, b, c, (static_cast<double>(i) + 1.0 / 3) * part,
                         (static_cast<double>(k) + 1.0 / 3) * part));
    }
  }
}

}  // namespace

NearTriangles::NearTriangles(std::vector<Point> points, std::vector<Corners> triangles)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      tree_(box_tree(points_, triangles_)) {}

double NearTriangles::distance(const Point& p) const {
  const auto square = [&](std::uint32_t row) {
    const Corners& t = triangles_[row];
    return square_to(p, points_[t[0]], points_[t[1]], points_[t[2]]);
  };
  double least = square(last_);
  for_each_box(
      tree_, [&](const BoundingBox& box) { return square_to(p, box) < least; },
      [&](std::uint32_t row) {
        const double here = square(row);
        if (here >= least) return;
        least = here;
        last_ = row;
      });
  return std::sqrt(least);
}

SurfaceGap gap_to(const NearTriangles& other, const std::vector<Point>& points,
                  const std::vector<Corners>& triangles, std::size_t samples) {
  double area = 0;
  for (const Corners& t : triangles) {
    area += length(cross(difference(points[t[1]], points[t[0]]),
                         difference(points[t[2]], points[t[0]]))) /
            2;
  }
  Sampling s{.spacing = std::sqrt(area / static_cast<double>(std::max<std::size_t>(samples, 1))),
             .gap = {}};
  if (!(s.spacing > 0)) return s.gap;
  for (const Corners& t : triangles) {
    sample(s, other, points[t[0]], points[t[1]], points[t[2]]);
  }
  s.gap.mean = s.sum / static_cast<double>(std::max<std::size_t>(s.count, 1));
  for (const Corners& t : triangles) {
    for (const std::uint32_t corner : t) s.add(other, points[corner]);
  }
  return s.gap;
}

SurfaceGap gap_between(const std::vector<Point>& points, const std::vector<Corners>& triangles,
                       const std::vector<Point>& other_points,
                       const std::vector<Corners>& other_triangles) {
  if (triangles.empty() || other_triangles.empty()) return {};
  const SurfaceGap there = gap_to(NearTriangles(other_points, other_triangles), points, triangles);
  const SurfaceGap back = gap_to(NearTriangles(points, triangles), other_points, other_triangles);
  return there.largest > back.largest ? there : back;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Boundary faces that lie on each other, and tetrahedra near to them.
#include "apps/sunder/mesh/near_crack.hpp"

#include <algorithm>

#include "topology/base/point_math.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {
namespace {

using detail::difference, detail::dot;

/// The square of the distance from a point to a triangle (Ericson, Real-Time Collision Detection,
/// 5.1.5): the nearest of its regions, which the signs of barycentric numbers tell.
double square_distance(const Point& p, const std::array<Point, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Point ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
  const auto to = [&](double v, double w) {
    Point d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = ap[i] - v * ab[i] - w * ac[i];
    return dot(d, d);
  };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return to(0, 0);
  const Point bp = difference(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return to(1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return to(d1 / (d1 - d3), 0);
  const Point cp = difference(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return to(0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return to(0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return to(1 - w, w);
  }
  const double sum = va + vb + vc;
  return to(vb / sum, vc / sum);
}

}  // namespace

CrackFaces crack_faces(const VolumeMap& map, double within) {
  std::vector<std::array<Point, 3>> boundary;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!map.neighbour(face).is_none()) continue;
    std::array<Point, 3> x;
    const auto rows = corners_of_face(map.corners(tetrahedron_of(face)), face);
    for (std::size_t i = 0; i < 3; ++i) x[i] = map.point(rows[i]);
    std::ranges::sort(x);
    boundary.push_back(x);
  }
  std::ranges::sort(boundary);
  CrackFaces crack;
  std::vector<BoundingBox> boxes;
  for (std::size_t i = 0; i + 1 < boundary.size(); ++i) {
    if (boundary[i] != boundary[i + 1]) continue;
    BoundingBox box{boundary[i][0], boundary[i][0]};
    for (const Point& x : boundary[i]) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], x[k] - within);
        box.high[k] = std::max(box.high[k], x[k] + within);
      }
    }
    crack.triangles.push_back(boundary[i]);
    boxes.push_back(box);
  }
  crack.boxes = box_tree(std::move(boxes));
  return crack;
}

bool is_near(const CrackFaces& crack, const VolumeMap& map, TetId t, double within) {
  bool is_near = false;
  for (const VertexId v : map.corners(t)) {
    const Point& x = map.point(v);
    for_each_box_at(crack.boxes, x, [&](std::uint32_t row) {
      is_near = is_near || square_distance(x, crack.triangles[row]) <= within * within;
    });
  }
  return is_near;
}

}  // namespace sunder

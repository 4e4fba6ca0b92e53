// SPDX-License-Identifier: MIT
// Pairs of triangles near each other, by a tree of boxes; then exact signs.
#include "topology/mesh/surface/crossing.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include "topology/base/sort_unique.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/surface/exact_side.hpp"

namespace sunder {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Flat = std::array<double, 2>;

Flat flat(const Point& p, std::size_t axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// An axis along which the triangle does not look like a line; 3 where it has no area.
std::size_t axis_of(const std::array<Point, 3>& t) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (side_of_line(flat(t[0], axis), flat(t[1], axis), flat(t[2], axis)) != 0) return axis;
  }
  return 3;
}

bool is_between(const Flat& p, const Flat& a, const Flat& b) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (p[k] < std::min(a[k], b[k]) || p[k] > std::max(a[k], b[k])) return false;
  }
  return true;
}

bool segments_meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  const int s1 = side_of_line(a, b, c), s2 = side_of_line(a, b, d);
  const int s3 = side_of_line(c, d, a), s4 = side_of_line(c, d, b);
  if (s1 * s2 < 0 && s3 * s4 < 0) return true;
  return (s1 == 0 && is_between(c, a, b)) || (s2 == 0 && is_between(d, a, b)) ||
         (s3 == 0 && is_between(a, c, d)) || (s4 == 0 && is_between(b, c, d));
}

bool is_inside(const Flat& p, const std::array<Flat, 3>& t) {
  int low = 1, high = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = side_of_line(t[k], t[(k + 1) % 3], p);
    low = std::min(low, side);
    high = std::max(high, side);
  }
  return low >= 0 || high <= 0;
}

/// Whether a segment in the triangle's plane meets it.
bool meets_in_plane(const std::array<Point, 3>& t, const Point& p, const Point& q) {
  const std::size_t axis = axis_of(t);
  const std::array<Flat, 3> f{flat(t[0], axis), flat(t[1], axis), flat(t[2], axis)};
  const Flat a = flat(p, axis), b = flat(q, axis);
  if (is_inside(a, f)) return true;  // from outside it comes to b through a side
  for (std::size_t k = 0; k < 3; ++k) {
    if (segments_meet(f[k], f[(k + 1) % 3], a, b)) return true;
  }
  return false;
}

bool segment_meets(const std::array<Point, 3>& t, const Point& p, const Point& q) {
  const int s1 = side_of_plane(t[0], t[1], t[2], p), s2 = side_of_plane(t[0], t[1], t[2], q);
  if (s1 * s2 > 0) return false;
  if (s1 == 0 && s2 == 0) return meets_in_plane(t, p, q);
  int low = 1, high = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = side_of_plane(p, q, t[k], t[(k + 1) % 3]);
    low = std::min(low, side);
    high = std::max(high, side);
  }
  return low >= 0 || high <= 0;
}

std::array<Point, 3> places(const std::vector<Point>& points, const Triangle& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

/// The triangle turned so that the corners that it shares come first.
Triangle shared_first(const Triangle& t, const Triangle& other, std::size_t& shared) {
  Triangle turned = t;
  const auto middle = std::stable_partition(turned.begin(), turned.end(), [&](std::uint32_t c) {
    return std::ranges::find(other, c) != other.end();
  });
  shared = static_cast<std::size_t>(middle - turned.begin());
  return turned;
}

/// Two triangles on one edge: in one plane, on one side of the edge.
bool fold_together(const std::vector<Point>& x, const Triangle& a, const Triangle& b) {
  const Point &p = x[a[0]], &q = x[a[1]], &r = x[a[2]], &s = x[b[2]];
  if (side_of_plane(p, q, r, s) != 0) return false;
  const std::size_t axis = axis_of({p, q, r});
  const Flat e = flat(p, axis), f = flat(q, axis);
  return side_of_line(e, f, flat(r, axis)) == side_of_line(e, f, flat(s, axis));
}

}  // namespace

bool has_area(const std::vector<Point>& points, const Triangle& t) {
  return axis_of(places(points, t)) < 3;
}

bool triangles_cross(const std::vector<Point>& points, const Triangle& a, const Triangle& b) {
  std::size_t shared = 0;
  const Triangle s = shared_first(a, b, shared), t = shared_first(b, a, shared);
  if (shared == 3) return true;
  if (shared == 2) return fold_together(points, s, t);
  const std::array<Point, 3> p = places(points, s), q = places(points, t);
  if (shared == 1) return segment_meets(p, q[1], q[2]) || segment_meets(q, p[1], p[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (segment_meets(p, q[k], q[(k + 1) % 3]) || segment_meets(q, p[k], p[(k + 1) % 3])) {
      return true;
    }
  }
  return false;
}

Crossings find_crossings(const std::vector<Point>& points,
                         const std::vector<SurfaceTriangle>& all) {
  constexpr std::size_t looks_each = 400;
  // A triangle without area lies on edges of its neighbours: it cannot be tested against them.
  std::vector<SurfaceTriangle> triangles;
  std::ranges::copy_if(all, std::back_inserter(triangles),
                       [&](const SurfaceTriangle& t) { return has_area(points, t.corners); });
  std::vector<BoundingBox> boxes;
  for (const SurfaceTriangle& t : triangles) boxes.push_back(box_around(points, t.corners));
  const BoxTree tree = box_tree(std::move(boxes));
  Crossings found;
  std::size_t left = looks_each * triangles.size() + 10000;
  for (std::uint32_t i = 0; i < triangles.size() && found.is_finished; ++i) {
    const SurfaceTriangle& t = triangles[i];
    const std::size_t looks = for_each_box(
        tree, [&](const BoundingBox& box) { return overlap(box, tree.boxes[i]); },
        [&](std::uint32_t j) {
          const SurfaceTriangle& other = triangles[j];
          if (j <= i || t.face == other.face) return;
          if (!triangles_cross(points, t.corners, other.corners)) return;
          found.pairs.push_back({std::min(t.face, other.face), std::max(t.face, other.face)});
        });
    found.is_finished = looks <= left;
    left -= std::min(left, looks);
  }
  sort_unique(found.pairs);
  return found;
}

}  // namespace sunder

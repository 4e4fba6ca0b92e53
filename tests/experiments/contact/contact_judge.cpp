// SPDX-License-Identifier: MIT
#include "tests/experiments/contact/contact_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder::test {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();
constexpr std::array<std::array<int, 2>, 6> edges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<int, 3>, 4> faces = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

const Vec3& corner(const TetCorners& t, int k) { return t[static_cast<std::size_t>(k)]; }

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
  for (const auto& e : edges)
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
  for (const auto& e : edges) {
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

Vec3 middle_of(const Shape& shape) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return plane->offset * plane->normal;
  if (const auto* ball = std::get_if<Sphere>(&shape)) return ball->center;
  if (const auto* box = std::get_if<Box>(&shape)) return box->center;
  return std::get<Solid>(shape).translation;
}

/// m, of its farthest point from the middle.
double reach_of(const Shape& shape) {
  if (std::holds_alternative<Plane>(shape)) return 0;
  if (const auto* ball = std::get_if<Sphere>(&shape)) return ball->radius;
  if (const auto* box = std::get_if<Box>(&shape)) return box->half_extent.norm();
  double most = 0;
  for (const Vec3& p : std::get<Solid>(shape).surface->points) most = std::max(most, p.norm());
  return most;
}

Eigen::Quaterniond turn_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return box->orientation;
  if (const auto* solid = std::get_if<Solid>(&shape)) return solid->orientation;
  return Eigen::Quaterniond::Identity();
}

TetCorners corners_of(const ContactFrame& frame, std::size_t t) {
  TetCorners c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = frame.points[frame.tetrahedra[t][k]];
  return c;
}

TetCorners between(const TetCorners& a, const TetCorners& b, double time) {
  TetCorners c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = (1 - time) * a[k] + time * b[k];
  return c;
}

Shape between(const Shape& a, const Shape& b, double time) {
  Shape at = a;
  const Vec3 middle = (1 - time) * middle_of(a) + time * middle_of(b);
  const Eigen::Quaterniond turn = turn_of(a).slerp(time, turn_of(b));
  if (auto* plane = std::get_if<Plane>(&at)) {
    plane->offset = (1 - time) * plane->offset + time * std::get<Plane>(b).offset;
  } else if (auto* ball = std::get_if<Sphere>(&at)) {
    ball->center = middle;
  } else if (auto* box = std::get_if<Box>(&at)) {
    box->center = middle;
    box->orientation = turn;
  } else {
    std::get<Solid>(at).translation = middle;
    std::get<Solid>(at).orientation = turn;
  }
  return at;
}

/// m: a bound on the motion of two tetrahedra against each other.
double way_between(const TetCorners& a0, const TetCorners& a1, const TetCorners& b0,
                   const TetCorners& b1) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      most = std::max(most, (a1[i] - a0[i] - b1[j] + b0[j]).norm());
    }
  }
  return most;
}

double way_between(const TetCorners& a0, const TetCorners& a1, const Shape& s0, const Shape& s1) {
  const Vec3 shift = middle_of(s1) - middle_of(s0);
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i) most = std::max(most, (a1[i] - a0[i] - shift).norm());
  return most + turn_of(s0).angularDistance(turn_of(s1)) * reach_of(s0);
}

/// The largest depth over times 0 to 1, to within `tolerance`, where it is above `tolerance`. In a
/// part of the time the depth changes by at most that part of `way`.
template <class Depth>
DeepestPair deepest_on_way(const Depth& depth, double way, double tolerance) {
  DeepestPair best;
  struct Span {
    double from, to;
  };
  std::vector<Span> open = {{0, 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    const double time = 0.5 * (from + to), here = depth(time);
    if (here > best.depth) {
      best.depth = here;
      best.time = time;
    }
    const double possible = here + 0.5 * (to - from) * way;
    if (possible <= std::max(best.depth, tolerance) + tolerance) continue;
    open.push_back({from, time});
    open.push_back({time, to});
  }
  return best;
}

/// An axis-aligned box.
struct Bounds {
  Vec3 low = Vec3::Constant(far_away), high = Vec3::Constant(-far_away);
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool meets(const Bounds& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Calls `visit(a, b)` for all pairs of boxes that meet, found by a grid whose cells are as large
/// as the boxes are on average; each pair once, a < b.
template <class Visit>
void for_each_pair(const std::vector<Bounds>& boxes, Visit visit) {
  if (boxes.empty()) return;
  Bounds all;
  double size = 0;
  for (const Bounds& b : boxes) {
    all.add(b.low);
    all.add(b.high);
    size += (b.high - b.low).maxCoeff();
  }
  size = std::max(size / static_cast<double>(boxes.size()), 1e-300);
  // The number of cells stays near the number of boxes, at any distance between these.
  const double most_cells = std::max(8.0, std::cbrt(8.0 * static_cast<double>(boxes.size())));
  const double cell = std::max(size, (all.high - all.low).maxCoeff() / most_cells);
  const auto place = [&](double x, int axis) {
    return static_cast<std::int64_t>((x - all.low[axis]) / cell);
  };
  std::vector<std::pair<std::array<std::int64_t, 3>, std::uint32_t>> entries;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Bounds& b = boxes[k];
    for (std::int64_t x = place(b.low[0], 0); x <= place(b.high[0], 0); ++x) {
      for (std::int64_t y = place(b.low[1], 1); y <= place(b.high[1], 1); ++y) {
        for (std::int64_t z = place(b.low[2], 2); z <= place(b.high[2], 2); ++z) {
          entries.push_back({{x, y, z}, static_cast<std::uint32_t>(k)});
        }
      }
    }
  }
  std::ranges::sort(entries);
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t end = first;
    while (end < entries.size() && entries[end].first == entries[first].first) ++end;
    for (std::size_t i = first; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        const Bounds &a = boxes[entries[i].second], &b = boxes[entries[j].second];
        if (!a.meets(b)) continue;
        // Only in the first cell that both share.
        std::array<std::int64_t, 3> own;
        for (int axis = 0; axis < 3; ++axis) {
          own[static_cast<std::size_t>(axis)] = place(std::max(a.low[axis], b.low[axis]), axis);
        }
        if (own == entries[first].first) visit(entries[i].second, entries[j].second);
      }
    }
    first = end;
  }
}

/// Boxes of tetrahedra; of their ways where there is a second frame.
std::vector<Bounds> bounds_of(const ContactFrame& first, const ContactFrame* second) {
  std::vector<Bounds> boxes(first.tetrahedra.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const Vec3& p : corners_of(first, t)) boxes[t].add(p);
    if (!second) continue;
    for (const Vec3& p : corners_of(*second, t)) boxes[t].add(p);
  }
  return boxes;
}

/// Box of a shape's way; of a plane, all space.
Bounds bounds_of(const Shape& first, const Shape& second) {
  Bounds b;
  if (std::holds_alternative<Plane>(first)) {
    b.add(Vec3::Constant(-far_away));
    b.add(Vec3::Constant(far_away));
    return b;
  }
  for (const Shape* s : {&first, &second}) {
    b.add(middle_of(*s) - Vec3::Constant(reach_of(*s)));
    b.add(middle_of(*s) + Vec3::Constant(reach_of(*s)));
  }
  return b;
}

}  // namespace

double overlap(const TetCorners& a, const TetCorners& b) {
  const double scale = std::sqrt(squared_size(a) * squared_size(b));
  double least = far_away;
  for (std::size_t f = 0; f < 4; ++f) {
    try_axis(least, a, b, face_axis(a, f), scale);
    try_axis(least, a, b, face_axis(b, f), scale);
  }
  for (const auto& e : edges) {
    const Vec3 way = corner(a, e[1]) - corner(a, e[0]);
    for (const auto& g : edges) {
      try_axis(least, a, b, way.cross(corner(b, g[1]) - corner(b, g[0])), scale);
    }
  }
  return least;
}

double overlap(const TetCorners& a, const Shape& shape) {
  return std::visit([&](const auto& s) { return overlap_with(a, s); }, shape);
}

double mean_edge(const ContactFrame& frame) {
  double sum = 0;
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) {
    const TetCorners c = corners_of(frame, t);
    for (const auto& e : edges) sum += (corner(c, e[1]) - corner(c, e[0])).norm();
  }
  return frame.tetrahedra.empty() ? 0 : sum / (6 * static_cast<double>(frame.tetrahedra.size()));
}

FrameOverlaps judge_overlaps(const ContactFrame& frame, double edge) {
  FrameOverlaps seen;
  const std::vector<Bounds> boxes = bounds_of(frame, nullptr);
  for_each_pair(boxes, [&](std::uint32_t a, std::uint32_t b) {
    if (frame.piece[a] == frame.piece[b]) return;
    const double depth = overlap(corners_of(frame, a), corners_of(frame, b));
    if (depth <= 1e-6 * edge) return;
    ++seen.pairs;
    seen.mean += depth;
    if (depth > seen.pieces.depth) seen.pieces = {.depth = depth, .a = a, .b = b};
  });
  if (seen.pairs > 0) seen.mean /= static_cast<double>(seen.pairs);
  for (std::size_t o = 0; o < frame.obstacles.size(); ++o) {
    const Shape& shape = frame.obstacles[o].shape;
    const Bounds round = bounds_of(shape, shape);
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      if (!boxes[t].meets(round)) continue;
      const double depth = overlap(corners_of(frame, t), shape);
      if (depth <= std::max(1e-6 * edge, seen.obstacles.depth)) continue;
      seen.obstacles = {.depth = depth,
                        .a = static_cast<std::uint32_t>(t),
                        .obstacle = static_cast<std::uint32_t>(o)};
    }
  }
  return seen;
}

std::vector<Crossing> judge_crossings(const ContactFrame& first, const ContactFrame& second,
                                      double tolerance) {
  // By pieces, or piece and obstacle.
  std::map<std::array<std::uint32_t, 3>, Crossing> found;
  const auto note = [&](const std::array<std::uint32_t, 3>& who, DeepestPair pair, bool passed) {
    Crossing& known = found[who];
    if (pair.depth > known.deepest.depth) known = {pair, passed};
  };
  const std::vector<Bounds> boxes = bounds_of(first, &second);
  for_each_pair(boxes, [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t p = second.piece[a], q = second.piece[b];
    if (p == q) return;
    const TetCorners a0 = corners_of(first, a), a1 = corners_of(second, a);
    const TetCorners b0 = corners_of(first, b), b1 = corners_of(second, b);
    if (overlap(a0, b0) > tolerance) return;
    const auto depth = [&](double time) {
      return overlap(between(a0, a1, time), between(b0, b1, time));
    };
    DeepestPair pair = deepest_on_way(depth, way_between(a0, a1, b0, b1), tolerance);
    if (pair.depth <= tolerance) return;
    pair.a = a;
    pair.b = b;
    note({std::min(p, q), std::max(p, q), DeepestPair::none}, pair, overlap(a1, b1) <= tolerance);
  });
  for (std::size_t o = 0; o < first.obstacles.size(); ++o) {
    const Shape &s0 = first.obstacles[o].shape, &s1 = second.obstacles[o].shape;
    const Bounds round = bounds_of(s0, s1);
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      if (!boxes[t].meets(round)) continue;
      const TetCorners a0 = corners_of(first, t), a1 = corners_of(second, t);
      if (overlap(a0, s0) > tolerance) continue;
      const auto depth = [&](double time) {
        return overlap(between(a0, a1, time), between(s0, s1, time));
      };
      DeepestPair pair = deepest_on_way(depth, way_between(a0, a1, s0, s1), tolerance);
      if (pair.depth <= tolerance) continue;
      pair.a = static_cast<std::uint32_t>(t);
      pair.obstacle = static_cast<std::uint32_t>(o);
      note({second.piece[t], DeepestPair::none, pair.obstacle}, pair, overlap(a1, s1) <= tolerance);
    }
  }
  std::vector<Crossing> crossings;
  for (const auto& [who, crossing] : found) crossings.push_back(crossing);
  return crossings;
}

}  // namespace sunder::test

// SPDX-License-Identifier: MIT
// Overlaps in frames and crossings between frames.
#include "tests/experiments/contact/contact_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder::test {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();

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

/// Calls `visit(a, b)` for all pairs of boxes that meet, found by a grid with cells as large as the
/// boxes are on average; each pair once, a < b.
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

double mean_edge(const ContactFrame& frame) {
  double sum = 0;
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) {
    const TetCorners c = corners_of(frame, t);
    for (const auto& e : tet_edges) sum += (corner(c, e[1]) - corner(c, e[0])).norm();
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

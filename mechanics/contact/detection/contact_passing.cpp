// SPDX-License-Identifier: MIT
// Pieces that pass each other within a step, by halving of time.
#include <algorithm>
#include <cmath>

#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/frame/rotation.hpp"

namespace sunder {
namespace {

/// How a component goes through the step.
struct Turning {
  Pose from, to;
  Vec3 turn{0, 0, 0};  ///< rad times axis, world
  double angle = 0;    ///< rad
};

Turning turning_of(const StepPaths& paths, ComponentId id) {
  const Component& c = paths.state.components[id.index()];
  const PredictedFrame& frame = paths.frame[id.index()];
  Turning turning{{c.centre, c.orientation}, {frame.centre, frame.orientation}};
  turning.turn = turn_between(turning.from.orientation, turning.to.orientation);
  turning.angle = turning.turn.norm();
  return turning;
}

/// Places of a tetrahedron of a component after a part of the step.
Places places_after(const StepPaths& paths, const Turning& turning, TetId t, double part) {
  Places x;
  const Vec3 centre = (1 - part) * turning.from.centre + part * turning.to.centre;
  const Eigen::Quaterniond turn = rotation_of(part * turning.turn) * turning.from.orientation;
  for (std::size_t i = 0; i < 4; ++i) {
    const VertexId v = paths.corners[t.index()][i];
    if (turning.angle == 0) {
      x[i] = paths.at(v, part);
      continue;
    }
    const Vec3 start =
        turning.from.orientation.conjugate() * (paths.at_start(v) - turning.from.centre);
    const Vec3 end = turning.to.orientation.conjugate() * (paths.at_end(v) - turning.to.centre);
    x[i] = centre + turn * ((1 - part) * start + part * end);
  }
  return x;
}

/// m: the farthest that a corner goes in the second of two pairs of places against the first.
double farthest(const Places& a, const Places& b, const Places& c, const Places& d) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      most = std::max(most, (c[i] - a[i] - (d[j] - b[j])).norm());
    }
  }
  return most;
}

/// A pair of tetrahedra through the step.
struct PassingPair {
  const StepPaths& paths;
  TetId a, b;
  Turning turning_a, turning_b;
  double tolerance;     ///< m
  double arm_a, arm_b;  ///< m, from the mass centres to the farthest corner
  int looks_left = 4096;

  Places of_a(double part) const { return places_after(paths, turning_a, a, part); }
  Places of_b(double part) const { return places_after(paths, turning_b, b, part); }

  /// Whether they overlap by more than the tolerance between two moments, at both of which they do
  /// not. Where there are too few looks to know it, they may: shorter steps will show.
  bool overlaps(double from, double to, const Places& p, const Places& q, const Places& r,
                const Places& s) {
    const double span = to - from;
    const double arc =
        sagitta(span * turning_a.angle, arm_a) + sagitta(span * turning_b.angle, arm_b);
    if (common_gap(p, q, r, s, arc - tolerance) >= arc - tolerance) return false;
    if (farthest(p, q, r, s) + arc < tolerance) return false;
    if (--looks_left <= 0) return true;
    const double middle = 0.5 * (from + to);
    const Places m = of_a(middle), n = of_b(middle);
    if (common_gap(m, n, m, n, -tolerance) < -tolerance) return true;
    return overlaps(from, middle, p, q, m, n) || overlaps(middle, to, m, n, r, s);
  }
};

/// The way of two tetrahedra that pass each other, in edges of the smaller one; else 0.
double way_of(const DetectScratch& scratch, const StepPaths& paths, TetId a, TetId b) {
  const ComponentId of_a = paths.state.elements.component[a.index()];
  const ComponentId of_b = paths.state.elements.component[b.index()];
  const Places p = places_of(paths.corners[a.index()], paths);
  const Places q = places_of(paths.corners[b.index()], paths);
  const Places r = places_at_end(paths, a), s = places_at_end(paths, b);
  const double edge = std::min(mean_edge(p), mean_edge(q)), tolerance = passing_share * edge;
  const auto arm = [&](ComponentId id, const Places& x) {
    double most = 0;
    for (const Vec3& corner : x) {
      most = std::max(most, (corner - paths.state.components[id.index()].centre).norm());
    }
    return most;
  };
  PassingPair pair{
      paths,        a,           b, turning_of(paths, of_a), turning_of(paths, of_b), tolerance,
      arm(of_a, p), arm(of_b, q)};
  const double arc =
      sagitta(pair.turning_a.angle, pair.arm_a) + sagitta(pair.turning_b.angle, pair.arm_b);
  const double way = farthest(p, q, r, s) + arc;
  if (way < tolerance) return 0;
  // Pieces that begin in an overlap are pushed out slowly.
  if (common_gap(p, q, p, q, -tolerance) < -tolerance) return 0;
  if (are_partners(scratch, paths, a, b)) return 0;
  const bool passes =
      common_gap(r, s, r, s, -tolerance) < -tolerance || pair.overlaps(0, 1, p, q, r, s);
  return passes ? way / edge : 0;
}

/// m: between the surfaces of a ball and a tetrahedron; inside of it less than minus the radius.
double gap_of_ball(const Vec3& centre, double radius, const Places& x) {
  const std::array<double, 4> shares = nearest_point(x, centre);
  Vec3 nearest = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) nearest += shares[i] * x[i];
  return (centre - nearest).norm() - radius;
}

/// The same of a ball and a tetrahedron.
double way_of(const StepPaths& paths, const BallWay& ball, TetId t) {
  const ComponentId id = paths.state.elements.component[t.index()];
  const Turning turning = turning_of(paths, id);
  const Places p = places_of(paths.corners[t.index()], paths), q = places_at_end(paths, t);
  const double size = std::min(mean_edge(p), ball.radius), tolerance = passing_share * size;
  if (gap_of_ball(ball.start, ball.radius, p) < -tolerance) return 0;
  double fastest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double arm = (p[i] - paths.state.components[id.index()].centre).norm();
    fastest =
        std::max(fastest, (ball.end - ball.start - (q[i] - p[i])).norm() + 2 * turning.angle * arm);
  }
  constexpr int most_looks = 4096;
  double part = 0;
  for (int k = 0; k < most_looks; ++k) {
    const double gap =
        gap_of_ball(ball.at(part), ball.radius, places_after(paths, turning, t, part));
    if (gap < -tolerance) return fastest / size;
    if (part >= 1) return 0;
    part = std::min(1.0, part + std::max(gap + tolerance, 0.1 * tolerance) / fastest);
  }
  return fastest / size;  // not known: shorter steps will show
}

}  // namespace

double find_passing(DetectScratch& scratch, const StepPaths& paths) {
  pair_on_ways(scratch, paths);
  const SolidPairs& pairs = scratch.solid_pairs;
  double longest = 0;
  for (const auto& [a, b] : pairs.found) {
    longest = std::max(longest, way_of(scratch, paths, pairs.tetrahedra[a], pairs.tetrahedra[b]));
  }
  for (const BallWay& ball : moving_balls(paths)) {
    for_each_near(pairs, ball,
                  [&](TetId t) { longest = std::max(longest, way_of(paths, ball, t)); });
  }
  return longest;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Boxes of tetrahedra on their ways, and axes that part them.
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

/// Largest gap between two sets of corners along an axis out of the first, m.
double gap_along(const Vec3& axis, const Places& a, const Places& b) {
  double of_a = -std::numeric_limits<double>::infinity(), of_b = -of_a;
  for (std::size_t i = 0; i < 4; ++i) {
    of_a = std::max(of_a, axis.dot(a[i]));
    of_b = std::min(of_b, axis.dot(b[i]));
  }
  return of_b - of_a;
}

/// The axis that parts two tetrahedra farthest at both of two moments, and by how much at the
/// worse.
struct CommonAxis {
  double gap = -std::numeric_limits<double>::infinity();

  void attempt(Vec3 axis, const Places& a, const Places& b, const Places& c, const Places& d) {
    const double length = axis.norm();
    if (!(length > 0)) return;
    axis /= length;
    for (const double sign : {1.0, -1.0}) {
      gap = std::max(gap, std::min(gap_along(sign * axis, a, b), gap_along(sign * axis, c, d)));
    }
  }
};

Vec3 face_normal(const Places& x, std::size_t place) {
  const auto& k = outward_face[place];
  return (x[k[1]] - x[k[0]]).cross(x[k[2]] - x[k[0]]);
}

Vec3 edge_of(const Places& x, std::size_t e) {
  const auto& [i, j] = edge_ends[e];
  return x[static_cast<std::size_t>(j)] - x[static_cast<std::size_t>(i)];
}

/// Tetrahedra on surfaces with the box and the way that `box_of(tetrahedron, component)` gives;
/// those of members only, or of all.
template <class BoxOf>
void box_tetrahedra(DetectScratch& scratch, const StepPaths& paths, bool of_all, BoxOf box_of) {
  SolidPairs& pairs = scratch.solid_pairs;
  pairs.boxes.clear();
  pairs.body.clear();
  pairs.ways.clear();
  pairs.tetrahedra.clear();
  for (const HalfFaceId face : scratch.surface.faces) {
    const TetId t = tetrahedron_of(face);
    const ComponentId id = paths.state.elements.component[t.index()];
    if (!of_all && !paths.is_searched(id)) continue;
    if (!pairs.tetrahedra.empty() && pairs.tetrahedra.back() == t) continue;
    const auto [box, way] = box_of(t, id);
    pairs.tetrahedra.push_back(t);
    pairs.boxes.push_back(box);
    pairs.body.push_back(id.value);
    pairs.ways.push_back(way);
  }
}

void pair_boxes(SolidPairs& pairs, const StepPaths& paths) {
  mark_inside(pairs.moves, paths);
  find_box_pairs(pairs.found, pairs.grid, {pairs.boxes, pairs.body, pairs.moves, pairs.ways});
}

}  // namespace

void mark_inside(std::vector<char>& moves, const StepPaths& paths) {
  moves.resize(paths.state.components.size());
  for (std::size_t c = 0; c < moves.size(); ++c) {
    moves[c] = paths.is_inside(ComponentId{c});
  }
}

double sagitta(double angle, double arm) { return std::min(0.125 * angle * angle, 2.0) * arm; }

Vec3 turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond turn = to * from.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;
  const double sine = turn.vec().norm();
  if (sine == 0) return Vec3::Zero();
  return 2 * direction_angle(sine, turn.w()) / sine * turn.vec();
}

Bounds bounds_of(const Places& x) {
  Bounds box{x[0], x[0]};
  for (const Vec3& corner : x) {
    box.low = box.low.cwiseMin(corner);
    box.high = box.high.cwiseMax(corner);
  }
  return box;
}

Places places_at_end(const StepPaths& paths, TetId t) {
  Places x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = paths.predicted[paths.corners[t.index()][i].index()];
  return x;
}

double mean_edge(const Places& x) {
  double sum = 0;
  for (const auto& [i, j] : edge_ends) {
    sum += (x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(j)]).norm() / 6;
  }
  return sum;
}

std::uint32_t outer_faces(const StepPaths& paths, TetId t) {
  std::uint32_t bits = 0;
  for (std::uint32_t place = 0; place < 4; ++place) {
    if (paths.neighbours[t.index()][place].is_none()) bits |= 1u << place;
  }
  return bits;
}

void pair_on_ways(DetectScratch& scratch, const StepPaths& paths) {
  box_tetrahedra(scratch, paths, false, [&](TetId t, ComponentId id) {
    const Places start = places_of(paths.corners[t.index()], paths), end = places_at_end(paths, t);
    const Vec3 from = scratch.centre_start[t.index()];
    const Vec3 way = centre_of(paths.corners[t.index()], paths.predicted) - from;
    const Component& component = paths.state.components[id.index()];
    const double angle =
        turn_between(component.orientation, paths.frame[id.index()].orientation).norm();
    const double arc = sagitta(angle, (from - component.centre).norm()) +
                       sagitta(angle, scratch.radius[t.index()]);
    Bounds box = bounds_of(start);
    for (const Vec3& x : end) {
      box.low = box.low.cwiseMin(x - way);
      box.high = box.high.cwiseMax(x - way);
    }
    box.low -= Vec3::Constant(arc);
    box.high += Vec3::Constant(arc);
    return std::pair(box, way);
  });
  pair_boxes(scratch.solid_pairs, paths);
}

void box_at_end(DetectScratch& scratch, const StepPaths& paths) {
  box_tetrahedra(scratch, paths, false, [&](TetId t, ComponentId) {
    return std::pair(bounds_of(places_at_end(paths, t)), Vec3(Vec3::Zero()));
  });
}

namespace {

/// Shapes of components and the mean edge, where the surface has changed.
void update_shapes(DetectScratch& scratch, const StepPaths& paths) {
  if (scratch.shape_version == scratch.surface.version &&
      scratch.shape.size() == paths.state.components.size()) {
    return;
  }
  scratch.shape_version = scratch.surface.version;
  measure_shapes(scratch.shape, scratch.surface, paths.state.elements,
                 paths.state.components.size());
  double length = 0;
  const std::vector<Vec3>& rest = paths.state.vertices.rest_position;
  for (const SurfaceEdge& edge : scratch.surface.edges) {
    length += (rest[edge.end[1].index()] - rest[edge.end[0].index()]).norm();
  }
  const std::size_t count = std::max<std::size_t>(1, scratch.surface.edges.size());
  scratch.mean_edge = length / static_cast<double>(count);
}

}  // namespace

void update_near(DetectScratch& scratch, const StepPaths& paths) {
  if (!paths.scope.empty()) return;
  update_shapes(scratch, paths);
  // Pairs are bounded within the mean edge of their search: twice the present one is more.
  scratch.travel.reach = 2 * scratch.mean_edge;
  update_travel(scratch.travel, paths);
}

NearQuery near_query(const DetectScratch& scratch) {
  constexpr double margin = 0.25;  // of the mean edge
  return {scratch.travel, scratch.shape, margin * scratch.mean_edge};
}

bool keeps_pairs(const DetectScratch& scratch, const StepPaths& paths) {
  return paths.scope.empty() && scratch.travel.farthest <= near_query(scratch).margin;
}

void refresh_solids(DetectScratch& scratch, const StepPaths& paths) {
  const NearQuery query = near_query(scratch);
  if (!find_stale(scratch.near_solids, query)) return;
  box_tetrahedra(scratch, paths, true, [&](TetId t, ComponentId id) {
    const Vec3 wide = Vec3::Constant(width_of(query, id.value));
    const Bounds box = bounds_of(places_of(paths.corners[t.index()], paths));
    return std::pair(Bounds{box.low - wide, box.high + wide}, Vec3(Vec3::Zero()));
  });
  SolidPairs& pairs = scratch.solid_pairs;
  std::vector<std::uint32_t> numbers;
  for (const TetId t : pairs.tetrahedra) numbers.push_back(t.value);
  find_stale_pairs(pairs.found, scratch.near_solids, pairs);
  add_pairs(scratch.near_solids, pairs.found, pairs.body, numbers);
}

void pair_at_end(DetectScratch& scratch, const StepPaths& paths) {
  box_at_end(scratch, paths);
  SolidPairs& pairs = scratch.solid_pairs;
  pair_boxes(pairs, paths);
  scratch.swept.clear();
  for (const auto& [a, b] : pairs.found) {
    scratch.swept.emplace_back(pairs.tetrahedra[a].value, pairs.tetrahedra[b].value);
  }
}

bool are_partners(const DetectScratch& scratch, const StepPaths& paths, TetId a, TetId b) {
  return std::ranges::any_of(paths.corners[a.index()], [&](VertexId v) {
    return faces(scratch, {b, v}, paths);
  });
}

double common_gap(const Places& a, const Places& b, const Places& c, const Places& d,
                  double enough) {
  CommonAxis axis;
  for (std::size_t f = 0; f < 4; ++f) {
    for (const Places* x : {&a, &b, &c, &d}) axis.attempt(face_normal(*x, f), a, b, c, d);
    if (axis.gap > enough) return axis.gap;
  }
  for (std::size_t e = 0; e < 6; ++e) {
    for (std::size_t f = 0; f < 6; ++f) {
      axis.attempt(edge_of(a, e).cross(edge_of(b, f)), a, b, c, d);
      axis.attempt(edge_of(c, e).cross(edge_of(d, f)), a, b, c, d);
      if (axis.gap > enough) return axis.gap;
    }
  }
  return axis.gap;
}

std::vector<BallWay> moving_balls(const StepPaths& paths) {
  std::vector<BallWay> balls;
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    const Obstacle& obstacle = paths.obstacles[row];
    if (!is_sphere(obstacle) || (obstacle.mass && !paths.members.has_ball(row))) continue;
    const ContactPoint centre{.ball = row};
    balls.push_back({row, start_of_side_a(centre, paths), end_of_side_a(centre, paths),
                     radius_of(obstacle.shape)});
  }
  return balls;
}

}  // namespace sunder

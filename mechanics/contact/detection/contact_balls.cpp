// SPDX-License-Identifier: MIT
// Spheres traced to the first point of each face; Voronoi regions decide which feature counts.
#include "mechanics/contact/detection/contact_balls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mechanics/contact/detection/face_touch.hpp"
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"

namespace sunder {
namespace {

/// Where a ball is nearest to a face on its way, or touches it first.
struct BallTouch {
  HalfFaceId face;
  double part = 0;
  std::array<double, 3> foot{};  ///< shares of the face's corners
  Vec3 normal{0, 0, 1};
  double gap_start = 0, gap_end = 0;  ///< m, along the normal
  std::uint32_t edge = none;          ///< row of the edge that is touched; none: the face itself
  static constexpr std::uint32_t none = 0xffffffffu;
};

Vec3 point_at(const std::array<double, 3>& foot, const std::array<Vec3, 3>& x) {
  return foot[0] * x[0] + foot[1] * x[1] + foot[2] * x[2];
}

/// Whether the way of a ball against a tetrahedron comes near it: an inexpensive bound.
bool may_meet(const DetectScratch& scratch, const StepPaths& paths, const BallWay& ball, TetId t) {
  const Corners& corners = paths.corners[t.index()];
  const Vec3 from = ball.start - scratch.centre_start[t.index()];
  const Vec3 way = ball.end - centre_of(corners, paths.predicted) - from;
  const double length = way.norm();
  const double share = length > 0 ? std::clamp(-from.dot(way) / (length * length), 0.0, 1.0) : 0.0;
  double spread = 0;
  const Vec3 centre_way = ball.end - ball.start - way;
  for (const VertexId v : corners) {
    spread = std::max(spread, (paths.at_end(v) - paths.at_start(v) - centre_way).norm());
  }
  const double reach = 1.5 * scratch.radius[t.index()] + ball.radius + spread + length;
  return (from + share * way).squaredNorm() <= reach * reach;
}

/// Sphere tracing: the distance shrinks no faster than the fastest corner moves against the centre.
void trace(BallTouch& touch, const StepPaths& paths, const BallWay& ball,
           const std::array<VertexId, 3>& corners) {
  double speed = 0;
  const Vec3 way = ball.end - ball.start;
  for (const VertexId v : corners) {
    speed = std::max(speed, (way - (paths.at_end(v) - paths.at_start(v))).norm());
  }
  const double arrived = 1e-6 * speed;
  constexpr int most_evaluations = 48;
  double least = std::numeric_limits<double>::infinity(), part = 0;
  for (int k = 0; k < most_evaluations; ++k) {
    const std::array<Vec3, 3> x = places_at(paths, corners, part);
    const std::array<double, 3> foot = nearest_on_triangle(x, ball.at(part));
    const double gap = (ball.at(part) - point_at(foot, x)).norm() - ball.radius;
    if (gap < least) {
      least = gap;
      touch.part = part;
      touch.foot = foot;
    }
    if (gap <= arrived || part >= 1 || speed == 0) break;
    part = std::min(1.0, part + gap / speed);
  }
}

/// Whether the centre is in the Voronoi region of an edge: beyond both of its faces.
bool is_beyond(const StepPaths& paths, const SurfaceEdge& edge, const Vec3& out, double part) {
  const Vec3 from = paths.at(edge.end[0], part);
  const Vec3 along = (paths.at(edge.end[1], part) - from).normalized();
  for (const VertexId v : edge.beside) {
    if (v.is_none()) continue;
    Vec3 inward = paths.at(v, part) - from;
    inward -= along.dot(inward) * along;
    if (out.dot(inward) > on_face * out.norm() * inward.norm()) return false;
  }
  return true;
}

/// Which feature of its face a touch is on, and its normal there. False: of another face, or a
/// vertex.
bool classify(BallTouch& touch, const DetectScratch& scratch, const StepPaths& paths,
              const BallWay& ball, std::size_t row) {
  const std::array<Vec3, 3> x = places_at(paths, corners_of(paths, touch.face), touch.part);
  const Vec3 out = ball.at(touch.part) - point_at(touch.foot, x);
  const auto zeros = std::ranges::count_if(touch.foot, [](double w) { return w < on_face; });
  if (zeros >= 2) return false;
  if (zeros == 0) {
    touch.normal = normal_of(x);
    return out.dot(touch.normal) > 0;
  }
  // The edge across from the corner without a share begins at the next one.
  const auto apex = std::ranges::min_element(touch.foot) - touch.foot.begin();
  touch.edge = scratch.surface.face_edges[row][static_cast<std::size_t>(apex + 1) % 3];
  touch.normal = out.normalized();
  return out.squaredNorm() > 0 &&
         is_beyond(paths, scratch.surface.edges[touch.edge], out, touch.part);
}

/// Gaps along the normal; whether the ball ends nearer than it moves against the face.
bool measure(BallTouch& touch, const StepPaths& paths, const BallWay& ball) {
  const std::array<VertexId, 3> corners = corners_of(paths, touch.face);
  const Vec3 start = ball.start - point_at(touch.foot, places_at(paths, corners, 0));
  const Vec3 end = ball.end - point_at(touch.foot, places_at(paths, corners, 1));
  touch.gap_start = touch.normal.dot(start) - ball.radius;
  touch.gap_end = touch.normal.dot(end) - ball.radius;
  return touch.gap_end < (end - start).norm();
}

/// Of a centre that begins inside a component: the face that is nearest to it.
std::optional<BallTouch> way_out(const DetectScratch& scratch, const StepPaths& paths,
                                 const BallWay& ball, ComponentId id) {
  std::optional<BallTouch> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const HalfFaceId face : scratch.surface.faces) {
    if (paths.state.elements.component[tetrahedron_of(face).index()] != id) continue;
    const std::array<Vec3, 3> x = places_at(paths, corners_of(paths, face), 0);
    const std::array<double, 3> foot = nearest_on_triangle(x, ball.start);
    const double distance = (point_at(foot, x) - ball.start).norm();
    if (!(distance < least)) continue;
    least = distance;
    nearest = BallTouch{.face = face, .foot = foot, .normal = normal_of(x)};
  }
  if (nearest) measure(*nearest, paths, ball);
  return nearest;
}

void add(DetectScratch& scratch, const StepPaths& paths, const BallWay& ball,
         const BallTouch& touch, double friction) {
  ContactPoint contact;
  contact.ball = ball.row;
  contact.tetrahedron = tetrahedron_of(touch.face);
  contact.place = static_cast<std::uint8_t>(place_of(touch.face));
  std::array<double, 4> weights{};
  const auto& places = outward_face[contact.place];
  for (std::size_t k = 0; k < 3; ++k) weights[places[k]] = touch.foot[k];
  if (touch.edge != BallTouch::none) {
    // The same for both of its faces.
    const SurfaceEdge& edge = scratch.surface.edges[touch.edge];
    const std::array<VertexId, 3> corners = corners_of(paths, touch.face);
    contact.tetrahedron = tetrahedron_of(edge.face[0]);
    contact.place = static_cast<std::uint8_t>(ContactPoint::edge_place + edge.place);
    weights = {0, 0, 0, 0};
    const Corners& own = paths.corners[contact.tetrahedron.index()];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::ranges::find(own, corners[k]);
      if (at != own.end()) weights[static_cast<std::size_t>(at - own.begin())] = touch.foot[k];
    }
  }
  contact.weights = weights_on(contact, weights, paths);
  contact.normal = touch.normal;
  contact.gap_start = touch.gap_start;
  contact.friction = 0.5 * (friction + paths.obstacles[ball.row].friction);
  add_found(scratch, paths, contact, touch.gap_end);
}

bool holds(const StepPaths& paths, TetId t, const Vec3& point) {
  const std::array<double, 4> shares =
      barycentric(places_of(paths.corners[t.index()], paths), point);
  return std::ranges::all_of(shares, [](double w) { return w >= 0; });
}

/// Those of a ball with all pieces.
void find_touches(std::vector<BallTouch>& touches, std::vector<ComponentId>& inside,
                  const DetectScratch& scratch, const StepPaths& paths, const BallWay& ball) {
  touches.clear();
  inside.clear();
  TetId last;
  bool is_near = false;
  for (std::size_t row = 0; row < scratch.surface.faces.size(); ++row) {
    const HalfFaceId face = scratch.surface.faces[row];
    const TetId t = tetrahedron_of(face);
    if (!paths.is_inside(paths.state.elements.component[t.index()])) continue;
    if (t != last) is_near = may_meet(scratch, paths, ball, t);
    last = t;
    if (!is_near) continue;
    BallTouch touch{.face = face};
    trace(touch, paths, ball, corners_of(paths, face));
    if (classify(touch, scratch, paths, ball, row) && measure(touch, paths, ball)) {
      touches.push_back(touch);
    }
  }
  for (std::size_t t = 0; t < paths.corners.size(); ++t) {
    const ComponentId id = paths.state.elements.component[t];
    const double r = 1.5 * scratch.radius[t];
    if ((ball.start - scratch.centre_start[t]).squaredNorm() > r * r || !paths.is_inside(id)) {
      continue;
    }
    if (holds(paths, TetId{t}, ball.start)) inside.push_back(id);
  }
}

ComponentId component_of(const StepPaths& paths, const BallTouch& touch) {
  return paths.state.elements.component[tetrahedron_of(touch.face).index()];
}

/// Of touches with one component, those that end behind and come first: a ball that is stopped
/// there does not reach the others.
void keep_first(std::vector<BallTouch>& touches, const StepPaths& paths) {
  constexpr double together = 0.05;
  const auto passes = [](const BallTouch& t) { return t.gap_end < 0 && t.gap_start > 0; };
  const std::vector<BallTouch> all = touches;
  std::erase_if(touches, [&](const BallTouch& touch) {
    return passes(touch) && std::ranges::any_of(all, [&](const BallTouch& other) {
             return passes(other) && other.part + together < touch.part &&
                    component_of(paths, other) == component_of(paths, touch);
           });
  });
}

}  // namespace

void find_balls_on_pieces(DetectScratch& scratch, const StepPaths& paths, double friction) {
  std::vector<BallTouch> touches;
  std::vector<ComponentId> inside;
  for (const BallWay& ball : moving_balls(paths)) {
    find_touches(touches, inside, scratch, paths, ball);
    std::erase_if(touches, [&](const BallTouch& touch) {
      return std::ranges::find(inside, component_of(paths, touch)) != inside.end();
    });
    for (std::size_t k = 0; k < inside.size(); ++k) {
      if (std::ranges::find(inside.begin(), inside.begin() + static_cast<std::ptrdiff_t>(k),
                            inside[k]) != inside.begin() + static_cast<std::ptrdiff_t>(k)) {
        continue;
      }
      if (const auto out = way_out(scratch, paths, ball, inside[k])) touches.push_back(*out);
    }
    keep_first(touches, paths);
    for (const BallTouch& touch : touches) {
      // An edge is found from both of its faces.
      const bool is_known = touch.edge != BallTouch::none &&
                            std::ranges::any_of(touches.data(), &touch, [&](const BallTouch& t) {
                              return t.edge == touch.edge;
                            });
      if (!is_known) add(scratch, paths, ball, touch, friction);
    }
  }
}

}  // namespace sunder

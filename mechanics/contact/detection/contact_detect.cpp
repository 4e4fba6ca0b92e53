// SPDX-License-Identifier: MIT
// Contacts of vertices, balls and tetrahedron spheres along their paths through a step.
#include "mechanics/contact/detection/contact_detect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <variant>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/detection/contact_pieces.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// The obstacle's shape about its own reference: free ones about their mass centre, turned as they
/// are at the start; the rest as it stands.
Shape shape_about_reference(const Obstacle& obstacle) {
  Shape shape = obstacle.shape;
  if (obstacle.mass) put(shape, {Vec3::Zero(), pose_of(shape).orientation});
  return shape;
}

/// Whether a path ends nearer to the plane that it meets than it is long.
bool is_near(const FirstTouch& touch, const Path& path) {
  return touch.gap_end < (path.end - path.start).norm();
}

/// Adds a contact whose sides are `end` apart at the end of the step.
void add(DetectScratch& scratch, ContactPoint contact, const FirstTouch& touch, const Vec3& end) {
  contact.normal = touch.normal;
  contact.gap_start = touch.gap_start;
  contact.offset = touch.gap_end - touch.normal.dot(end);
  scratch.found.push_back(contact);
  scratch.found_gap.push_back(touch.gap_end);
}

/// Adds the contact if its path ends near.
void add_if_near(DetectScratch& scratch, const ContactPoint& contact, const Shape& shape,
                 const Path& path) {
  const FirstTouch touch = first_touch(shape, path);
  if (is_near(touch, path)) add(scratch, contact, touch, path.end);
}

/// Where the vertices of the members are in the step, and how far the fastest goes, m.
struct VertexReach {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double farthest = 0;
};

VertexReach reach_of_vertices(const StepPaths& paths) {
  VertexReach reach;
  double squared = 0;
  for (std::size_t v = 0; v < paths.predicted.size(); ++v) {
    if (!paths.members.has(paths.state.vertices.component[v])) continue;
    const Vec3 &start = paths.state.vertices.position[v], &end = paths.predicted[v];
    reach.low = reach.low.cwiseMin(start).cwiseMin(end);
    reach.high = reach.high.cwiseMax(start).cwiseMax(end);
    squared = std::max(squared, (end - start).squaredNorm());
  }
  reach.farthest = std::sqrt(squared);
  return reach;
}

/// Whether no vertex comes near a ball (`is_near`): each would have to go half of the way between.
bool is_far(const StepPaths& paths, std::uint32_t row, const VertexReach& reach) {
  const Obstacle& obstacle = paths.obstacles[row];
  const auto* ball = std::get_if<Sphere>(&obstacle.shape);
  if (!ball) return false;
  const double own = obstacle.mass ? (paths.ball_end[row].centre - ball->center).norm()
                                   : paths.time_step * obstacle.velocity.norm();
  const Vec3 apart = (reach.low - ball->center).cwiseMax(ball->center - reach.high).cwiseMax(0);
  return apart.norm() - ball->radius > 2 * (reach.farthest + own);
}

void find_vertex_obstacle(DetectScratch& scratch, const StepPaths& paths, std::uint32_t row,
                          double friction) {
  const Obstacle& obstacle = paths.obstacles[row];
  const Shape shape = shape_about_reference(obstacle);
  ContactPoint contact;
  contact.obstacle = row;
  contact.friction = 0.5 * (friction + obstacle.friction);
  if (obstacle.mass && !paths.members.has_ball(row)) return;
  for (std::size_t v = 0; v < paths.predicted.size(); ++v) {
    if (!paths.members.has(paths.state.vertices.component[v])) continue;
    contact.vertex = VertexId{v};
    const ContactPath path = path_of(contact, paths);
    add_if_near(scratch, contact, shape, {path.start, path.end, 0});
  }
}

/// Where side A of a contact is at the end, m: the centre of a ball.
Vec3 end_of_side_a(const ContactPoint& contact, const StepPaths& paths) {
  if (contact.ball == ContactPoint::none) return paths.predicted[contact.vertex.index()];
  const Obstacle& obstacle = paths.obstacles[contact.ball];
  const Pose& end = paths.ball_end[contact.ball];
  if (contact.corner == ContactPoint::none) return end.centre;
  const Vec3 corner = corner_at(obstacle.shape, contact.corner);
  if (!obstacle.mass) return corner + paths.time_step * obstacle.velocity;
  const Pose start = pose_of(obstacle.shape);
  return end.centre +
         end.orientation * (start.orientation.conjugate() * (corner - start.centre));
}

/// Adds a contact of side A, told by `contact`, with another obstacle.
void find_between_obstacles(DetectScratch& scratch, const StepPaths& paths, ContactPoint contact,
                            const Shape& about_reference, double radius) {
  const ContactPath path = path_of(contact, paths);
  add_if_near(scratch, contact, about_reference, {path.start, path.end, radius});
}

/// Free obstacles against all others: balls by themselves, the rest by corners, those of both.
void find_balls(DetectScratch& scratch, const StepPaths& paths) {
  const auto rows = static_cast<std::uint32_t>(paths.obstacles.size());
  const auto moves = [&](std::uint32_t row) {
    return !paths.obstacles[row].mass || paths.members.has_ball(row);
  };
  for (std::uint32_t a = 0; a < rows; ++a) {
    const Obstacle& one = paths.obstacles[a];
    if (!moves(a)) continue;
    const bool is_ball = one.mass && is_sphere(one);
    if (!is_ball && corner_count(one.shape) == 0) continue;
    for (std::uint32_t b = 0; b < rows; ++b) {
      const Obstacle& other = paths.obstacles[b];
      if (a == b || !moves(b) || (!one.mass && !other.mass)) continue;
      // Of two balls the first is side A.
      if (is_ball && other.mass && is_sphere(other) && b < a) continue;
      ContactPoint contact;
      contact.ball = a;
      contact.obstacle = b;
      contact.friction = 0.5 * (one.friction + other.friction);
      const Shape shape = shape_about_reference(other);
      if (is_ball) {
        find_between_obstacles(scratch, paths, contact, shape, radius_of(one.shape));
        continue;
      }
      for (contact.corner = 0; contact.corner < corner_count(one.shape); ++contact.corner) {
        find_between_obstacles(scratch, paths, contact, shape, 0);
      }
    }
  }
}

/// Corners of obstacles on their ways, those that come into the box of all pieces on theirs.
void find_corners(std::vector<CornerPath>& corners, const StepPaths& paths,
                  const VertexReach& reach) {
  corners.clear();
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    const Obstacle& obstacle = paths.obstacles[row];
    if (obstacle.mass && !paths.members.has_ball(row)) continue;
    ContactPoint contact;
    contact.ball = row;
    for (contact.corner = 0; contact.corner < corner_count(obstacle.shape); ++contact.corner) {
      const CornerPath path{row, contact.corner, start_of_side_a(contact, paths),
                            end_of_side_a(contact, paths)};
      const Vec3 least = path.start.cwiseMin(path.end), most = path.start.cwiseMax(path.end);
      const bool meets = (least.array() <= reach.high.array()).all() && (most.array() >= reach.low.array()).all();
      if (meets) corners.push_back(path);
    }
  }
}

bool several_components(const StepPaths& paths) {
  const std::vector<ComponentId>& all = paths.state.elements.component;
  return std::any_of(all.begin(), all.end(), [&](ComponentId c) { return c != all.front(); });
}

/// Velocity of side A against side B at the start, m/s.
Vec3 relative_velocity(const ContactPoint& contact, const StepPaths& paths) {
  const std::vector<Vec3>& velocity = paths.state.vertices.velocity;
  const Vec3 place = start_of_side_a(contact, paths);
  const auto velocity_of = [&](std::uint32_t row) -> Vec3 {
    const Obstacle& o = paths.obstacles[row];
    return is_sphere(o) ? o.velocity : surface_velocity(o, place);
  };
  const Vec3 sum = contact.ball == ContactPoint::none ? velocity[contact.vertex.index()]
                                                      : velocity_of(contact.ball);
  if (contact.obstacle != ContactPoint::none) return sum - velocity_of(contact.obstacle);
  return sum - touched_nodes(contact, paths.state, paths.corners).sum(velocity);
}

}  // namespace

Vec3 centre_of(const Corners& corners, std::span<const Vec3> position) {
  return 0.25 * (position[corners[0].index()] + position[corners[1].index()] +
                 position[corners[2].index()] + position[corners[3].index()]);
}

std::array<Vec3, 4> places_of(const Corners& corners, const StepPaths& paths) {
  const std::vector<Vec3>& x = paths.state.vertices.position;
  return {x[corners[0].index()], x[corners[1].index()], x[corners[2].index()],
          x[corners[3].index()]};
}

void measure_balls(DetectScratch& scratch, const StepPaths& paths, double share) {
  const std::size_t count = paths.corners.size();
  const std::vector<Vec3>& rest = paths.state.vertices.rest_position;
  scratch.centre_start.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    scratch.centre_start[t] = centre_of(paths.corners[t], paths.state.vertices.position);
  }
  if (scratch.radius.size() == count && scratch.ball_share == share) return;
  scratch.ball_share = share;
  scratch.radius.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 centre = centre_of(paths.corners[t], rest);
    double squared = 0;
    for (VertexId v : paths.corners[t]) {
      squared = std::max(squared, (rest[v.index()] - centre).squaredNorm());
    }
    scratch.radius[t] = share * std::sqrt(squared);
  }
}

/// Every pair whose paths come within a radius of each other lies, half-way, within the radius and
/// half their relative motion. The motion counted is cut at two radii: see the limits in
/// contact.hpp.
void pair_up(DetectScratch& scratch, const StepPaths& paths) {
  const std::vector<Vec3>& start = paths.state.vertices.position;
  const std::size_t points = start.size(), all = points + paths.corner.size();
  Vec3 mean = Vec3::Zero();
  for (std::size_t v = 0; v < points; ++v) mean += paths.predicted[v] - start[v];
  mean /= static_cast<double>(std::max<std::size_t>(points, 1));
  double largest = 0;
  scratch.point_middle.resize(all);
  for (std::size_t v = 0; v < points; ++v) {
    largest = std::max(largest, (paths.predicted[v] - start[v] - mean).norm());
    scratch.point_middle[v] = 0.5 * (start[v] + paths.predicted[v]);
  }
  std::span<const ComponentId> component = paths.state.vertices.component;
  if (!paths.corner.empty()) {
    scratch.point_component.assign(component.begin(), component.end());
    scratch.point_component.resize(all, ComponentId::none());
    component = scratch.point_component;
  }
  for (std::size_t k = 0; k < paths.corner.size(); ++k) {
    const CornerPath& path = paths.corner[k];
    largest = std::max(largest, (path.end - path.start - mean).norm());
    scratch.point_middle[points + k] = 0.5 * (path.start + path.end);
  }
  const std::size_t count = paths.corners.size();
  scratch.reach.resize(count);
  scratch.centre_middle.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 end = centre_of(paths.corners[t], paths.predicted);
    const double motion = (end - scratch.centre_start[t] - mean).norm() + largest;
    scratch.centre_middle[t] = 0.5 * (scratch.centre_start[t] + end);
    // Nothing meets who is no member.
    scratch.reach[t] = paths.members.has(paths.state.elements.component[t])
                           ? scratch.radius[t] + 0.5 * std::min(motion, 2 * scratch.radius[t])
                           : 0;
  }
  find_sphere_pairs(scratch.pairs, scratch.grid, scratch.cache,
                    {scratch.point_middle, component, scratch.centre_middle,
                     scratch.reach, paths.state.elements.component});
}

std::array<double, 4> weights_on(const ContactPoint& contact, const std::array<double, 4>& touched,
                                 const StepPaths& paths) {
  const ComponentId id = paths.state.elements.component[contact.tetrahedron.index()];
  if (!paths.state.components[id.index()].rigid) return touched;
  return affine_weights(places_of(paths.corners[contact.tetrahedron.index()], paths),
                        start_of_side_a(contact, paths));
}

TouchedNodes touched_nodes(const ContactPoint& contact, const MechanicsState& state,
                           std::span<const Corners> corners) {
  const TetId t = contact.tetrahedron;
  const Corners& own = corners[t.index()];
  const std::array<double, 4>& L = contact.weights;
  TouchedNodes touched;
  const bool is_rigid = state.components[state.elements.component[t.index()].index()].rigid;
  if (is_rigid || !is_second_order(state.elements, t)) {
    std::ranges::copy(own, touched.row.begin());
    std::ranges::copy(L, touched.share.begin());
    touched.count = 4;
    return touched;
  }
  const auto add = [&](VertexId row, double share) {
    if (share == 0) return;
    SUNDER_ASSERT(touched.count < touched.row.size(), "touched_nodes: a place inside");
    touched.row[touched.count] = row;
    touched.share[touched.count++] = share;
  };
  for (std::size_t i = 0; i < 4; ++i) add(own[i], L[i] * (2 * L[i] - 1));
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = edge_ends[e];
    add(state.elements.edge_nodes[t.index()][e],
        4 * L[static_cast<std::size_t>(i)] * L[static_cast<std::size_t>(j)]);
  }
  return touched;
}

Vec3 start_of_side_a(const ContactPoint& contact, const StepPaths& paths) {
  if (contact.ball == ContactPoint::none) {
    return paths.state.vertices.position[contact.vertex.index()];
  }
  const Shape& shape = paths.obstacles[contact.ball].shape;
  return contact.corner == ContactPoint::none ? pose_of(shape).centre
                                              : corner_at(shape, contact.corner);
}

ContactPath path_of(const ContactPoint& contact, const StepPaths& paths) {
  ContactPath path;
  path.start = start_of_side_a(contact, paths);
  path.end = end_of_side_a(contact, paths);
  path.size = path.start.norm() + path.end.norm();
  if (contact.obstacle != ContactPoint::none) {
    const Obstacle& obstacle = paths.obstacles[contact.obstacle];
    if (obstacle.mass) {
      const Pose start = pose_of(obstacle.shape), &end = paths.ball_end[contact.obstacle];
      path.start -= start.centre;
      path.end -= end.centre;
      if (!is_sphere(obstacle)) {
        path.end = start.orientation * (end.orientation.conjugate() * path.end);
      }
    } else {
      path.end -= paths.time_step * obstacle.velocity;
    }
  } else {
    const TouchedNodes touched = touched_nodes(contact, paths.state, paths.corners);
    const ComponentId id = paths.state.elements.component[contact.tetrahedron.index()];
    const Component& component = paths.state.components[id.index()];
    const Vec3 lever = lever_of(touched, path.start, paths.state.vertices.position);
    path.end -= touched.sum(paths.predicted);
    path.end -= component.rigid ? lever
                                   : paths.frame[id.index()].orientation *
                                         (component.orientation.conjugate() * lever);
    path.start.setZero();
  }
  return path;
}

Meeting meeting_of(const ContactPoint& contact, const StepPaths& paths, double touching) {
  const ContactPath path = path_of(contact, paths);
  const double h = paths.time_step;
  const double start = contact.normal.dot(path.start) + contact.offset;
  const double end = gap_end(contact, path);
  const double speed = contact.normal.dot(relative_velocity(contact, paths));
  if (start <= touching) return {0, -speed};
  const double acceleration = 2 * (end - start - speed * h) / (h * h);
  const double squared = speed * speed - 2 * acceleration * start;
  if (!(squared >= 0)) return {};
  const double root = std::sqrt(squared);
  const double time = 2 * start / (root - speed);
  if (!(time >= 0 && time <= h)) return {};
  return {time, root};
}

void find_contacts(DetectScratch& scratch, const ContactMemory& memory, const StepPaths& paths,
                   const ContactSettings& settings) {
  SUNDER_ASSERT(paths.predicted.size() == paths.state.vertices.size(), "predict before contact");
  scratch.found.clear();
  scratch.found_gap.clear();
  const VertexReach reach = reach_of_vertices(paths);
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    if (!is_far(paths, row, reach)) find_vertex_obstacle(scratch, paths, row, settings.friction);
  }
  find_balls(scratch, paths);
  if (settings.between_pieces) find_between_partners(scratch, memory, paths, settings);
  StepPaths with_corners = paths;
  if (!paths.neighbours.empty()) {
    find_corners(scratch.corner, paths, reach);
    with_corners.corner = scratch.corner;
  }
  const bool among_pieces = settings.between_pieces && several_components(paths);
  if (!among_pieces && with_corners.corner.empty()) return;
  measure_balls(scratch, paths, 1);
  find_between_pieces(scratch, with_corners, settings, among_pieces);
}

}  // namespace sunder

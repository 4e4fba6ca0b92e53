// SPDX-License-Identifier: MIT
// Contacts of vertices, balls and tetrahedron spheres along their paths through a step.
#include "mechanics/contact/contact_detect.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mechanics/contact/contact_partners.hpp"
#include "mechanics/contact/contact_pieces.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

Vec3 ball_centre(const Obstacle& ball) { return std::get<Sphere>(ball.shape).center; }
double ball_radius(const Obstacle& ball) { return std::get<Sphere>(ball.shape).radius; }

/// The obstacle's shape about its own reference: balls about their centre, the rest as it stands.
Shape shape_about_reference(const Obstacle& obstacle) {
  if (!obstacle.mass) return obstacle.shape;
  return Sphere{Vec3::Zero(), ball_radius(obstacle)};
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

void find_balls(DetectScratch& scratch, const StepPaths& paths) {
  for (std::uint32_t a = 0; a < paths.obstacles.size(); ++a) {
    const Obstacle& ball = paths.obstacles[a];
    if (!ball.mass || !paths.members.has_ball(a)) continue;
    for (std::uint32_t b = 0; b < paths.obstacles.size(); ++b) {
      const Obstacle& other = paths.obstacles[b];
      if (a == b || (other.mass && (b < a || !paths.members.has_ball(b)))) continue;
      ContactPoint contact;
      contact.ball = a;
      contact.obstacle = b;
      contact.friction = 0.5 * (ball.friction + other.friction);
      const ContactPath path = path_of(contact, paths);
      add_if_near(scratch, contact, shape_about_reference(other),
                  {path.start, path.end, ball_radius(ball)});
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
  Vec3 sum = contact.ball == ContactPoint::none ? velocity[contact.vertex.index()]
                                                : paths.obstacles[contact.ball].velocity;
  if (contact.obstacle != ContactPoint::none) {
    return sum - paths.obstacles[contact.obstacle].velocity;
  }
  return sum - weighted_sum(paths.corners[contact.tetrahedron.index()], contact.weights, velocity);
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
  const std::size_t points = start.size();
  Vec3 mean = Vec3::Zero();
  for (std::size_t v = 0; v < points; ++v) mean += paths.predicted[v] - start[v];
  mean /= static_cast<double>(std::max<std::size_t>(points, 1));
  double largest = 0;
  scratch.point_middle.resize(points);
  for (std::size_t v = 0; v < points; ++v) {
    largest = std::max(largest, (paths.predicted[v] - start[v] - mean).norm());
    scratch.point_middle[v] = 0.5 * (start[v] + paths.predicted[v]);
  }
  const std::size_t count = paths.corners.size();
  scratch.reach.resize(count);
  scratch.centre_middle.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 end = centre_of(paths.corners[t], paths.predicted);
    const double motion = (end - scratch.centre_start[t] - mean).norm() + largest;
    scratch.centre_middle[t] = 0.5 * (scratch.centre_start[t] + end);
    scratch.reach[t] = scratch.radius[t] + 0.5 * std::min(motion, 2 * scratch.radius[t]);
  }
  find_sphere_pairs(scratch.pairs, scratch.grid, scratch.cache,
                    {scratch.point_middle, paths.state.vertices.component, scratch.centre_middle,
                     scratch.reach, paths.state.elements.component});
}

std::array<double, 4> weights_on(const ContactPoint& contact, const std::array<double, 4>& touched,
                                 const StepPaths& paths) {
  const ComponentId id = paths.state.elements.component[contact.tetrahedron.index()];
  if (!paths.state.components[id.index()].isolated) return touched;
  return affine_weights(places_of(paths.corners[contact.tetrahedron.index()], paths),
                        paths.state.vertices.position[contact.vertex.index()]);
}

Vec3 weighted_sum(const Corners& corners, const std::array<double, 4>& weights,
                  std::span<const Vec3> values) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * values[corners[i].index()];
  return sum;
}

Vec3 lever_of(const ContactPoint& contact, const Corners& corners, std::span<const Vec3> start) {
  return start[contact.vertex.index()] - weighted_sum(corners, contact.weights, start);
}

ContactPath path_of(const ContactPoint& contact, const StepPaths& paths) {
  ContactPath path;
  if (contact.ball != ContactPoint::none) {
    path = {ball_centre(paths.obstacles[contact.ball]), paths.ball_end[contact.ball]};
  } else {
    path = {paths.state.vertices.position[contact.vertex.index()],
            paths.predicted[contact.vertex.index()]};
  }
  path.size = path.start.norm() + path.end.norm();
  if (contact.obstacle != ContactPoint::none) {
    const Obstacle& obstacle = paths.obstacles[contact.obstacle];
    if (obstacle.mass) {
      path.start -= ball_centre(obstacle);
      path.end -= paths.ball_end[contact.obstacle];
    } else {
      path.end -= paths.time_step * obstacle.velocity;
    }
  } else {
    const Corners& corners = paths.corners[contact.tetrahedron.index()];
    const ComponentId id = paths.state.elements.component[contact.tetrahedron.index()];
    const Component& component = paths.state.components[id.index()];
    const Vec3 lever = lever_of(contact, corners, paths.state.vertices.position);
    path.end -= weighted_sum(corners, contact.weights, paths.predicted);
    path.end -= component.isolated ? lever
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
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    find_vertex_obstacle(scratch, paths, row, settings.friction);
  }
  find_balls(scratch, paths);
  if (!settings.between_pieces) return;
  find_between_partners(scratch, memory, paths, settings);
  if (several_components(paths)) {
    measure_balls(scratch, paths, 1);
    find_between_pieces(scratch, paths, settings);
  }
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Where the sides of a contact are, through the step.
#include "mechanics/contact/detection/contact_detect.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// Velocity of side A against side B at the start, m/s.
Vec3 relative_velocity(const ContactPoint& contact, const StepPaths& paths) {
  const std::vector<Vec3>& velocity = paths.state.vertices.velocity;
  const Vec3 place = start_of_side_a(contact, paths);
  const auto velocity_of = [&](std::uint32_t row) -> Vec3 {
    const Obstacle& o = paths.obstacles[row];
    return is_sphere(o) ? o.velocity : surface_velocity(o, place);
  };
  const Vec3 sum = contact.is_body_a() ? nodes_of_a(contact, paths.corners).sum(velocity)
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

TouchedNodes nodes_of_a(const ContactPoint& contact, std::span<const Corners> corners) {
  TouchedNodes nodes;
  if (!contact.vertex.is_none()) {
    nodes.row[0] = contact.vertex;
    nodes.share[0] = 1;
    nodes.count = 1;
    return nodes;
  }
  SUNDER_ASSERT(!contact.tetrahedron_a.is_none(), "nodes_of_a: side A of a body");
  const Corners& own = corners[contact.tetrahedron_a.index()];
  for (std::size_t i = 0; i < 4; ++i) {
    if (contact.weights_a[i] == 0) continue;
    nodes.row[nodes.count] = own[i];
    nodes.share[nodes.count++] = contact.weights_a[i];
  }
  return nodes;
}

Vec3 point_of_obstacle(const ContactPoint& contact, const Shape& shape) {
  if (contact.edge_a != ContactPoint::none) {
    const auto [from, to] = edge_at(shape, contact.edge_a).end;
    return contact.weights_a[0] * corner_at(shape, from) +
           contact.weights_a[1] * corner_at(shape, to);
  }
  if (contact.corner != ContactPoint::none) return corner_at(shape, contact.corner);
  return pose_of(shape).centre;
}

Vec3 start_of_side_a(const ContactPoint& contact, const StepPaths& paths) {
  if (contact.is_body_a()) {
    return nodes_of_a(contact, paths.corners).sum(paths.state.vertices.position);
  }
  return point_of_obstacle(contact, paths.obstacles[contact.ball].shape);
}

Vec3 end_of_side_a(const ContactPoint& contact, const StepPaths& paths) {
  if (contact.is_body_a()) {
    return nodes_of_a(contact, paths.corners).sum(paths.predicted);
  }
  const Obstacle& obstacle = paths.obstacles[contact.ball];
  if (!obstacle.mass) {
    return start_of_side_a(contact, paths) + paths.time_step * obstacle.velocity;
  }
  const Pose& end = paths.ball_end[contact.ball];
  if (contact.is_sphere_a()) return end.centre;
  const Vec3 point = point_of_obstacle(contact, obstacle.shape);
  const Pose start = pose_of(obstacle.shape);
  return end.centre + end.orientation * (start.orientation.conjugate() * (point - start.centre));
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

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Velocities of held vertices, and the motions that supports leave free.
#include "mechanics/state/supports.hpp"

#include <algorithm>

namespace sunder {

Vec3 with_support(const MechanicsState& state, VertexId vertex, const Vec3& velocity,
                  const Eigen::Quaterniond& orientation) {
  const MotionId motion = state.vertices.support[vertex.index()];
  if (motion.is_none()) return velocity;
  const Vec3& given = state.motions[motion.index()].velocity;
  if (is_held_whole(state, vertex)) return given;
  return given + orientation * free_part(state, vertex, orientation.conjugate() * velocity);
}

Vec3 mean_velocity(const PrescribedMotion& motion, double start, double end) {
  if (motion.raised.empty()) return motion.velocity;
  Vec3 mean = Vec3::Zero();
  for (const auto& [velocity, ramp] : motion.raised) {
    const double from = std::min(start, ramp), to = std::min(end, ramp);
    double share = 1;
    if (end <= ramp && ramp > 0) {
      share = (from + to) / (2 * ramp);
    } else if (start < ramp) {
      share = ((ramp - from) * (from + ramp) / (2 * ramp) + end - ramp) / (end - start);
    }
    mean += share * velocity;
  }
  return mean;
}

bool is_raised(const MechanicsState& state, const Component& component) {
  const auto goes_on = [&](const RaisedVelocity& r) { return state.time < r.ramp_time; };
  return component.supported && std::ranges::any_of(component.vertices, [&](VertexId v) {
           const MotionId motion = state.vertices.support[v.index()];
           return !motion.is_none() &&
                  std::ranges::any_of(state.motions[motion.index()].raised, goes_on);
         });
}

void raise_supports(MechanicsState& state, double end) {
  for (PrescribedMotion& motion : state.motions) {
    motion.velocity = mean_velocity(motion, state.time, end);
  }
}

double follow_supports(MechanicsState& state, ComponentId id) {
  Component& component = state.components[id.index()];
  VertexColumns& vertices = state.vertices;
  MotionId lowest = MotionId::none();
  double work = 0;
  for (VertexId v : component.vertices) {
    const MotionId motion = vertices.support[v.index()];
    if (motion.is_none()) continue;
    if (lowest.is_none() || motion < lowest) lowest = motion;
    Vec3& velocity = vertices.velocity[v.index()];
    const Vec3 next = with_support(state, v, velocity, component.orientation);
    const Vec3 given = vertices.mass[v.index()] * (next - velocity);
    work += 0.5 * given.dot(next + velocity);
    component.momentum += given;
    component.angular_momentum += (vertices.position[v.index()] - component.centre).cross(given);
    velocity = next;
  }
  if (lowest.is_none()) return 0;
  component.frame_velocity = state.motions[lowest.index()].velocity;
  const Mat3 back = component.orientation.conjugate().toRotationMatrix();
  for (VertexId v : component.vertices) {
    vertices.displacement_rate[v.index()] =
        back * (vertices.velocity[v.index()] - component.frame_velocity);
  }
  return work;
}

bool is_fixed_by_axes(const MechanicsState& state, const Component& component) {
  if (!component.partly_held) return false;
  // u = a + b x r / radius vanishes along every held axis only for a = b = 0.
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (VertexId v : component.vertices) {
    const AxisSet held = held_axes(state, v);
    const Vec3 arm =
        (state.vertices.rest_position[v.index()] - component.rest_centre) / component.rest_radius;
    for (int axis = 0; axis < 3; ++axis) {
      if (!held[static_cast<std::size_t>(axis)]) continue;
      Eigen::Matrix<double, 6, 1> row;
      row << Vec3::Unit(axis), arm.cross(Vec3::Unit(axis));
      gram += row * row.transpose();
    }
  }
  const auto values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(gram, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return values[0] > 1e-9 * values[5];
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Velocities of held vertices, and what supports leave free.
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

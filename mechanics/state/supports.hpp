// SPDX-License-Identifier: MIT
// Supports of vertices, axis by axis of the body frame.
#pragma once

#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// The axes of its body's frame along which a vertex is held.
inline AxisSet held_axes(const MechanicsState& state, VertexId vertex) {
  const MotionId motion = state.vertices.support[vertex.index()];
  return motion.is_none() ? AxisSet{} : state.motions[motion.index()].axes;
}

/// Whether a vertex is held along all axes: it has no row in the solved system.
inline bool is_held_whole(const MechanicsState& state, VertexId vertex) {
  return held_axes(state, vertex) == AxisSet{true, true, true};
}

/// A vector of the body frame with nothing along the axes on which the vertex is held.
inline Vec3 free_part(const MechanicsState& state, VertexId vertex, Vec3 vector) {
  const AxisSet held = held_axes(state, vertex);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (held[axis]) vector[static_cast<Eigen::Index>(axis)] = 0;
  }
  return vector;
}

/// m/s, world: the velocity of a vertex, with that of its motion along the axes on which it is
/// held. `orientation`: of its component.
Vec3 with_support(const MechanicsState& state, VertexId vertex, const Vec3& velocity,
                  const Eigen::Quaterniond& orientation);

/// m/s, world: the mean velocity of a motion from `start` to `end`, s; where both are one, the
/// velocity then.
Vec3 mean_velocity(const PrescribedMotion& motion, double start, double end);

/// Whether the velocity of some vertex of a component is still raised, at `state.time`.
bool is_raised(const MechanicsState& state, const Component& component);

/// For a part of a step from `state.time` to `end`: every velocity that is raised takes its mean
/// over it. Held vertices follow with `follow_supports`.
void raise_supports(MechanicsState& state, double end);

/// Gives the held vertices of a component the velocities of their motions, and its frame that of
/// the first of them. This is a blow, in which nothing else moves. Gives the work of the supports,
/// J. O(vertices).
double follow_supports(MechanicsState& state, ComponentId id);

/// Whether supports leave a component no rigid motion, to 3e-5 of its size, where some of its
/// vertices are held along some axes only; false where there are none such.
bool is_fixed_by_axes(const MechanicsState& state, const Component& component);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// From positions and velocities of vertices to a frame, momenta and a displacement field.
#pragma once

#include <span>

#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/state/columns.hpp"
#include "mechanics/state/component.hpp"

namespace sunder {

/// Where vertices are and how they move, |V| rows each, world.
struct MotionInput {
  const VertexColumns& vertices;  ///< only rest positions and masses are looked at
  std::span<const Vec3> position;
  std::span<const Vec3> velocity;
};

/// Rows of the component's vertices are set, body frame, |V| rows each.
struct DeformationOutput {
  std::span<Vec3> displacement;
  std::span<Vec3> rate;
};

/// Frame and momenta of a component.
struct FittedMotion {
  Pose frame;
  Vec3 momentum = Vec3::Zero();
  Vec3 angular_momentum = Vec3::Zero();  ///< about frame.centre
};

/// Frame by algorithm 2, displacement d = R^T (x - c) - r0, P and L summed from x and v, and the
/// rate d' with v = P/M + R (w x q + d'), sum m d' = 0, sum m r0 x d' = 0,
/// w = I(q)^-1 (R^T L - sum m q x d'). Rounding of the fit goes into d, d', never into x, v.
FittedMotion fit_motion(const DeformationOutput& output, const MotionInput& input,
                        const Component& component);

/// The same in a frame that is given (that of a supported component, moving at `frame_velocity`):
/// d' = R^T (v - frame_velocity), no projection.
FittedMotion express_motion(const DeformationOutput& output, const MotionInput& input,
                            const Component& component, const Pose& frame);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The six rigid degrees of freedom of a free component, and of those that take no others.
#pragma once

#include "mechanics/integrators/component_step.hpp"
#include "mechanics/state/step_status.hpp"

namespace sunder {

/// Weight, other forces and their torque about the centre, world, N and N m, at the start of the
/// step.
struct RigidLoad {
  Vec3 weight = Vec3::Zero();
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  /// sum q f^T of the forces that keep their direction, q in the body frame, N m: their torque at
  /// any orientation.
  Mat3 dead = Mat3::Zero();
};
RigidLoad rigid_load(const ComponentStep& step);

/// Inertia of a component about its mass centre as it is deformed now, kg m^2, body frame.
Mat3 deformed_inertia(const VertexColumns& vertices, const Component& body);

/// c += h P/M + h^2 F/(2 M), P += h F, L += h tau: a parabola under gravity, to rounding. The
/// orientation is left alone, and the torque is taken as that of the start.
PredictedFrame advance_centre(const ComponentStep& step, const RigidLoad& load);

/// The quantities that determine the turn of a step.
struct SpinStep {
  Mat3 inertia = Mat3::Identity();  ///< body frame, middle of the step, kg m^2
  Vec3 inner = Vec3::Zero();        ///< sum m q x d', body frame, middle of the step, kg m^2/s
  Vec3 momentum_old = Vec3::Zero(), momentum_new = Vec3::Zero();  ///< L, world, start and end
  double time_step = 0;
};

/// R at the end of the step: the implicit midpoint rule w = I^-1 ((l_old + l_new) / 2 - inner),
/// l = R^T L, with R_new = R exp(h w). |L| is exact because L is kept and R follows; the energy
/// l . I^-1 l of a rigid body is kept exactly too, and a steady spin turns by the exact angle.
/// Turns of more than a quarter radian are cut into sub-steps, up to `longest_turn`: 1 us each.
Eigen::Quaterniond turn_through_step(const Eigen::Quaterniond& start, const SpinStep& spin);

/// The same into `next`, with the moment of forces that keep their direction while the body turns
/// under them: half a kick, a turn, half a kick in each of so many sub-steps that the fastest
/// oscillation about an equilibrium is resolved by 12 of them (4096 at most, 1 us each). Taken at
/// the start of the step alone that moment feeds energy in at any step: an amplitude grows by
/// 1 + h^2 k / (4 I) a step. Writes orientation, angular momentum, `turned` and `spun`.
void turn_under_load(PredictedFrame& next, const Component& body, const SpinStep& spin,
                     const RigidLoad& load);

/// A step of an isolated tetrahedron or of a component on the rung `rigid`: a rigid body, deformed
/// as it is, with the inertia of its lumped vertices.
void step_rigid_body(const ComponentStep& step);

/// A part of a step of a component on the rung `carried`: a rigid body that has taken its loads
/// already, under the forces of contact alone; a held one goes on with its frame. Rates of
/// deformation stay as they are, and velocities are written without them.
void step_carried(const ComponentStep& step);

/// A step of a component that sleeps: its rows as they are, without velocity.
void keep_still(const ComponentStep& step);

}  // namespace sunder

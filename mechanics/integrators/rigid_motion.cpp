// SPDX-License-Identifier: MIT
// Rigid bodies in flight.
#include "mechanics/integrators/rigid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/frame/rotation.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/inertia.hpp"

namespace sunder {
namespace {

/// The angular velocity of one sub-step: fixed point of the implicit midpoint rule.
Vec3 midpoint_spin(const Eigen::Quaterniond& R, const SpinStep& spin, const Mat3& inverse_inertia) {
  const Vec3 l_old = R.conjugate() * spin.momentum_old;
  Vec3 w = inverse_inertia * (l_old - spin.inner);
  constexpr int most_iterations = 40;  // turns of 1/4 rad: each iteration gains a digit or two
  for (int i = 0; i < most_iterations; ++i) {
    const Eigen::Quaterniond R_new = R * rotation_of(spin.time_step * w);
    const Vec3 l_new = R_new.conjugate() * spin.momentum_new;
    const Vec3 next = inverse_inertia * (0.5 * (l_old + l_new) - spin.inner);
    const double change = (next - w).norm();
    w = next;
    if (!(change > 4 * std::numeric_limits<double>::epsilon() * w.norm())) break;
  }
  return w;
}

/// sum (R q) x f from sum q f^T.
Vec3 moment_at(const Eigen::Quaterniond& R, const Mat3& dead) {
  const Mat3 M = R.toRotationMatrix() * dead;
  return {M(1, 2) - M(2, 1), M(2, 0) - M(0, 2), M(0, 1) - M(1, 0)};
}

/// Of a sub-step that resolves the oscillation of a body hung on such forces: 12 a period, as
/// |dead| is at least half of the stiffness against turning.
int dead_substeps(const Mat3& dead, double least_inertia, double time_step) {
  constexpr int most = 4096;
  const double turn = time_step * std::sqrt(2 * dead.norm() / least_inertia);
  return turn < 0.5 * most ? std::max(1, static_cast<int>(std::ceil(2 * turn))) : most;
}

/// A step of the six rigid degrees of freedom under a load.
void move_rigidly(const ComponentStep& step, const RigidLoad& load) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  const auto arm_of = [&](VertexId v) {
    return Vec3{vertices.rest_position[v.index()] - body.rest_centre +
                vertices.displacement[v.index()]};
  };
  const Mat3 inertia = deformed_inertia(vertices, body);
  PredictedFrame next = advance_centre(step, load);
  turn_under_load(next, body,
                  {inertia, Vec3::Zero(), body.angular_momentum, next.angular_momentum,
                   step.input.settings.time_step},
                  load);
  const Mat3 R = next.orientation.toRotationMatrix();
  const Vec3 spin = R * solve3(inertia, R.transpose() * next.angular_momentum);
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  for (VertexId v : body.vertices) {
    const Vec3 arm = R * arm_of(v);
    predicted.position[v.index()] = next.centre + arm;
    predicted.velocity[v.index()] = next.momentum / body.mass + spin.cross(arm);
    predicted.displacement[v.index()] = vertices.displacement[v.index()];
    predicted.displacement_rate[v.index()].setZero();
    predicted.displacement_acceleration[v.index()].setZero();
  }
  next.spin = spin;
  predicted.frame[body.id.index()] = next;
}

}  // namespace

Mat3 deformed_inertia(const VertexColumns& vertices, const Component& body) {
  if (body.rigid) return body.rest_inertia;
  Mat3 inertia = Mat3::Zero();
  for (VertexId v : body.vertices) {
    const Vec3 q =
        vertices.rest_position[v.index()] - body.rest_centre + vertices.displacement[v.index()];
    add_inertia(inertia, vertices.mass[v.index()], q);
  }
  return inertia;
}

RigidLoad rigid_load(const ComponentStep& step) {
  const Loads& loads = step.input.loads;
  RigidLoad total{step.component.mass * loads.gravity, Vec3::Zero(), Vec3::Zero()};
  if (loads.force.empty()) return total;
  Mat3 arm_force = Mat3::Zero();
  for (VertexId v : step.component.vertices) {
    Vec3 f = loads.force[v.index()];
    const Vec3 arm = step.state.vertices.position[v.index()] - step.component.centre;
    total.force += f;
    total.torque += arm.cross(f);
    if (!loads.turning.empty()) f -= loads.turning[v.index()];
    arm_force += arm * f.transpose();
  }
  total.dead = step.component.orientation.toRotationMatrix().transpose() * arm_force;
  return total;
}

PredictedFrame advance_centre(const ComponentStep& step, const RigidLoad& load) {
  const Component& body = step.component;
  const double h = step.input.settings.time_step;
  PredictedFrame next;
  next.centre =
      body.centre + h / body.mass * (body.momentum + 0.5 * h * (load.weight + load.force));
  next.orientation = body.orientation;
  next.momentum = body.momentum + h * (load.weight + load.force);
  next.angular_momentum = body.angular_momentum + h * load.torque;
  return next;
}

Eigen::Quaterniond turn_through_step(const Eigen::Quaterniond& start, const SpinStep& spin) {
  const Mat3 inverse_inertia = spin.inertia.inverse();
  const Vec3 w = inverse_inertia * (start.conjugate() * spin.momentum_old - spin.inner);
  const double turn = spin.time_step * w.norm();
  constexpr int most_substeps = static_cast<int>(4 * longest_turn);
  const int substeps =
      turn < longest_turn ? std::max(1, static_cast<int>(std::ceil(4 * turn))) : most_substeps;
  Eigen::Quaterniond R = start;
  SpinStep part = spin;
  part.time_step = spin.time_step / substeps;
  for (int i = 0; i < substeps; ++i) {
    const Vec3 change = (spin.momentum_new - spin.momentum_old) / substeps;
    part.momentum_old = spin.momentum_old + i * change;
    part.momentum_new = spin.momentum_old + (i + 1) * change;
    R = (R * rotation_of(part.time_step * midpoint_spin(R, part, inverse_inertia))).normalized();
  }
  return R;
}

void turn_under_load(PredictedFrame& next, const Component& body, const SpinStep& spin,
                     const RigidLoad& load) {
  next.spun =
      spin.time_step *
      solve3(spin.inertia, body.orientation.conjugate() * spin.momentum_old - spin.inner).norm();
  if (load.dead.isZero(0)) {
    next.orientation = turn_through_step(body.orientation, spin);
    return;
  }
  const double h = spin.time_step;
  const double least = spin.inertia.selfadjointView<Eigen::Lower>().eigenvalues()[0];
  const int substeps = dead_substeps(load.dead, least, h);
  Eigen::Quaterniond R = body.orientation;
  SpinStep part = spin;
  part.time_step = h / substeps;
  Vec3 L = spin.momentum_old;
  Vec3 moment = moment_at(R, load.dead);
  const Vec3 constant = load.torque - moment;
  double largest = 0;
  for (int i = 0; i < substeps; ++i) {
    largest = std::max(largest, moment.norm());
    part.momentum_old = part.momentum_new = L + 0.5 * part.time_step * (constant + moment);
    R = turn_through_step(R, part);
    moment = moment_at(R, load.dead);
    L = part.momentum_new + 0.5 * part.time_step * (constant + moment);
  }
  next.orientation = R;
  next.angular_momentum = L;
  next.turned = h * h * largest / least;
}

void step_rigid_body(const ComponentStep& step) { move_rigidly(step, rigid_load(step)); }

void step_carried(const ComponentStep& step) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  if (body.supported) {
    const Vec3 way = step.input.settings.time_step * body.frame_velocity;
    for (VertexId v : body.vertices) {
      predicted.position[v.index()] = vertices.position[v.index()] + way;
      predicted.velocity[v.index()] = body.frame_velocity;
      predicted.displacement[v.index()] = vertices.displacement[v.index()];
    }
    predicted.frame[body.id.index()] = {body.centre + way, body.orientation, body.momentum,
                                        body.angular_momentum};
  } else {
    RigidLoad load = rigid_load(step);
    load.weight.setZero();
    move_rigidly(step, load);
  }
  for (VertexId v : body.vertices) {
    predicted.displacement_rate[v.index()] = vertices.displacement_rate[v.index()];
    predicted.displacement_acceleration[v.index()] = vertices.displacement_acceleration[v.index()];
  }
}

void keep_still(const ComponentStep& step) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  for (VertexId v : body.vertices) {
    predicted.position[v.index()] = vertices.position[v.index()];
    predicted.displacement[v.index()] = vertices.displacement[v.index()];
    predicted.velocity[v.index()].setZero();
    predicted.displacement_rate[v.index()].setZero();
    predicted.displacement_acceleration[v.index()].setZero();
  }
  predicted.frame[body.id.index()] = {body.centre, body.orientation, Vec3::Zero(), Vec3::Zero(), 0};
}

}  // namespace sunder

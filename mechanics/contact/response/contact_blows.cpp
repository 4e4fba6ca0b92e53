// SPDX-License-Identifier: MIT
// The way of contact impulses into frames, deformations and balls.
#include "mechanics/contact/response/contact_bodies.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// The gravity and other loads of a touched component act like the contact does: on the frame at
/// once, on the deformation during the step. Otherwise rest would be a saw-tooth of +- g h / 2.
void blow_of_loads(StepBlows& blows, Component& component, const ContactPass& pass) {
  const double h = pass.input.settings.time_step;
  component.momentum += h * component.mass * pass.input.loads.gravity;
  if (pass.input.loads.force.empty()) return;
  for (VertexId v : component.vertices) {
    const Vec3 impulse = h * pass.input.loads.force[v.index()];
    component.momentum += impulse;
    component.angular_momentum +=
        (pass.state.vertices.position[v.index()] - component.centre).cross(impulse);
    blows.vertex_impulse[v.index()] += impulse;
  }
}

void touch(StepBlows& blows, const ContactBodies& bodies, std::size_t b, const ContactPass& pass) {
  if (bodies.component[b].is_none()) {
    char& touched = blows.ball_touched[bodies.ball[b]];
    if (touched) return;
    touched = 1;
    Obstacle& ball = pass.obstacles[bodies.ball[b]];
    ball.velocity += pass.input.settings.time_step * pass.input.loads.gravity;
    return;
  }
  char& touched = blows.component_touched[bodies.component[b].index()];
  if (touched) return;
  touched = 1;
  Component& component = pass.state.components[bodies.component[b].index()];
  const bool has_taken_loads = component.rung == Rung::carried;
  if (takes_split_blow(pass, component) && !component.supported && !has_taken_loads) {
    blow_of_loads(blows, component, pass);
  }
}

void strike_component(StepBlows& blows, Component& component, const ContactEnd& end,
                      const Vec3& impulse, const ContactPass& pass) {
  if (!takes_split_blow(pass, component)) {
    const VertexImpulse hit{end.vertex, impulse};
    apply_impulses(pass.state, {&hit, 1});
    apply_twist(pass.state, component.id, end.lever.cross(impulse));
    return;
  }
  if (!component.rigid) blows.vertex_impulse[end.vertex.index()] += impulse;
  if (component.supported) return;
  component.momentum += impulse;
  component.angular_momentum += end.arm.cross(impulse);
}

/// Forces that deform like the impulses of a free component but move its frame no more: the
/// impulses over the step, less m (a0 + alpha x R r0) with no sum and no moment about the present
/// positions. The integrator's projection on deformations takes such fields out anyway.
void deforming_forces(std::vector<Vec3>& force, const StepBlows& blows, const Component& component,
                      const ContactPass& pass) {
  const VertexColumns& vertices = pass.state.vertices;
  const double h = pass.input.settings.time_step;
  const Mat3 R = component.orientation.toRotationMatrix();
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (VertexId v : component.vertices) {
    const Vec3 f = blows.vertex_impulse[v.index()] / h;
    const Vec3 arm = vertices.position[v.index()] - component.centre;
    const Vec3 rest_arm = R * (vertices.rest_position[v.index()] - component.rest_centre);
    sum += f;
    moment += arm.cross(f);
    second += vertices.mass[v.index()] * rest_arm * arm.transpose();
  }
  // sum m q x (alpha x r0) = (tr(Q) I - Q) alpha with Q = sum m r0 q^T.
  Mat3 H = -second;
  H.diagonal().array() += second.trace();
  const Vec3 alpha = solve3_by_lu(H, moment);
  for (VertexId v : component.vertices) {
    const Vec3 rest_arm = R * (vertices.rest_position[v.index()] - component.rest_centre);
    force[v.index()] = blows.vertex_impulse[v.index()] / h -
                       vertices.mass[v.index()] * (sum / component.mass + alpha.cross(rest_arm));
  }
}

}  // namespace

void strike_ball(Obstacle& ball, const Vec3& impulse, const Vec3& arm) {
  ball.velocity += impulse / *ball.mass;
  ball.spin += spin_of(ball, arm.cross(impulse));
}

Eigen::Quaterniond turned_obstacle(const Obstacle& free, const Vec3& end, double h) {
  const Eigen::Quaterniond R = pose_of(free.shape).orientation;
  if (std::holds_alternative<Sphere>(free.shape)) return R;
  return turn_through_step(R, {own_inertia(free), Vec3::Zero(), angular_momentum_of(free), end, h});
}

void apply_changes(StepBlows& blows, const ContactBodies& bodies, std::span<const Vec3> change,
                   const ContactPass& pass) {
  SUNDER_ASSERT(change.size() == bodies.rows.size(), "one change a row");
  for (std::size_t k = 0; k < change.size(); ++k) {
    if (change[k].isZero(0)) continue;
    const Constraint& row = bodies.rows[k];
    for (std::uint32_t e = 0; e < row.end_count; ++e) touch(blows, bodies, row.ends[e].body, pass);
  }
  for (std::size_t k = 0; k < change.size(); ++k) {
    if (change[k].isZero(0)) continue;
    const Constraint& row = bodies.rows[k];
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      const ContactEnd& end = row.ends[e];
      const Vec3 impulse = end.weight * change[k];
      if (bodies.component[end.body].is_none()) {
        strike_ball(pass.obstacles[bodies.ball[end.body]], impulse, end.arm);
      } else {
        Component& component = pass.state.components[bodies.component[end.body].index()];
        strike_component(blows, component, end, impulse, pass);
      }
    }
  }
}

void predict_touched(StepBlows& blows, const ContactPass& pass) {
  const StepInput& input = pass.input;
  blows.without_gravity = {Vec3::Zero(), input.loads.force};
  blows.with_gravity = {input.loads.gravity, {}, {}, true};
  blows.without_gravity.force.resize(pass.state.vertices.size(), Vec3::Zero());
  std::vector<Vec3>& force = blows.without_gravity.force;
  std::vector<ComponentId> free, held;
  for (const Component& component : pass.state.components) {
    if (!blows.component_touched[component.id.index()]) continue;
    const bool split = takes_split_blow(pass, component);
    if (split && !component.supported) {
      free.push_back(component.id);
      if (component.rigid || is_stiff(component.rung)) {
        for (VertexId v : component.vertices) force[v.index()].setZero();
        continue;
      }
      deforming_forces(force, blows, component, pass);
    } else {
      held.push_back(component.id);
      if (!split) continue;
      for (VertexId v : component.vertices) {
        force[v.index()] += blows.vertex_impulse[v.index()] / input.settings.time_step;
      }
    }
  }
  blows.with_gravity.force = force;
  // They have no moment about the present positions, and shall get none as the body turns.
  blows.without_gravity.turning = force;
  const auto predict_with = [&](const Loads& loads, std::span<const ComponentId> components) {
    predict(pass.mechanics, pass.state,
            {input.corners, loads, input.settings, input.part, input.members}, components);
  };
  predict_with(blows.without_gravity, free);
  predict_with(blows.with_gravity, held);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Contact in the sub-steps of an impact: velocities are solved for, impulses are forces.
#include <algorithm>
#include <cmath>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/state/dense_solve.hpp"

namespace sunder {
namespace {

/// Velocity of a free ball's centre at the end of the sub-step.
Vec3 ball_velocity(const ContactStep& step, std::size_t row) {
  const Obstacle& ball = step.pass.obstacles[row];
  return ball.velocity + step.h() * step.pass.input.loads.gravity +
         step.scratch.blows.ball_impulse[row] / *ball.mass;
}

/// Spin of a free obstacle at the end of the sub-step, rad/s, as it is turned at its start.
Vec3 ball_spin(const ContactStep& step, std::size_t row) {
  const Obstacle& ball = step.pass.obstacles[row];
  return ball.spin + spin_of(ball, step.scratch.blows.ball_twist[row]);
}

/// Velocity of an obstacle at a place (m, of the start), spins of balls left out.
Vec3 obstacle_velocity(const ContactStep& step, std::uint32_t row, const Vec3& place) {
  const Obstacle& obstacle = step.pass.obstacles[row];
  if (!obstacle.mass) return obstacle.velocity;
  if (is_sphere(obstacle)) return ball_velocity(step, row);
  return ball_velocity(step, row) +
         ball_spin(step, row).cross(place - pose_of(obstacle.shape).centre);
}

/// Velocity of side A against side B at the end of the sub-step, spins of balls left out.
Vec3 velocity_end(const ContactStep& step, const ContactPoint& contact) {
  const std::vector<Vec3>& velocity = step.pass.mechanics.predicted.velocity;
  const Vec3 place = place_of_side_a(step.pass, contact);
  Vec3 sum = contact.is_body_a()
                 ? nodes_of_a(contact, step.pass.input.corners).sum(velocity)
                 : obstacle_velocity(step, contact.ball, place);
  if (contact.obstacle == ContactPoint::none) {
    const TouchedNodes touched =
        touched_nodes(contact, step.pass.state, step.pass.input.corners);
    const ComponentId id = step.pass.state.elements.component[contact.tetrahedron.index()];
    const Vec3 lever = lever_of(touched, place, step.pass.state.vertices.position) +
                       drift_of(step.pass, contact);
    const Vec3& spin = step.pass.mechanics.predicted.frame[id.index()].spin;
    return sum - touched.sum(velocity) - spin.cross(lever);
  }
  return sum - obstacle_velocity(step, contact.obstacle, place + drift_of(step.pass, contact));
}

/// Velocity that spinning balls add to a row at its contact point, m/s.
Vec3 spin_slip(const ContactStep& step, const Constraint& row) {
  Vec3 slip = Vec3::Zero();
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const std::uint32_t ball = step.scratch.bodies.ball[row.ends[e].body];
    if (ball == ContactBodies::none || !is_sphere(step.pass.obstacles[ball])) continue;
    slip += row.ends[e].weight * ball_spin(step, ball).cross(row.ends[e].arm);
  }
  return slip;
}

/// Adds an impulse at one end to what it acts on.
void strike_end(ContactStep& step, const ContactEnd& end, const Vec3& impulse) {
  StepBlows& blows = step.scratch.blows;
  const ContactBodies& bodies = step.scratch.bodies;
  if (bodies.component[end.body].is_none()) {
    blows.ball_touched[bodies.ball[end.body]] = 1;
    blows.ball_impulse[bodies.ball[end.body]] += impulse;
    blows.ball_twist[bodies.ball[end.body]] += end.arm.cross(impulse);
    return;
  }
  const Component& component = step.pass.state.components[bodies.component[end.body].index()];
  blows.component_touched[component.id.index()] = 1;
  blows.component_twist[component.id.index()] += end.lever.cross(impulse);
  if (!end.vertex.is_none()) {
    blows.vertex_impulse[end.vertex.index()] += impulse;
    return;
  }
  if (!is_isolated(component)) {
    blows.component_push[component.id.index()] += impulse;
    return;
  }
  for (VertexId v : component.vertices) blows.vertex_impulse[v.index()] += 0.25 * impulse;
}

}  // namespace

double wave_gap_error(const ContactStep& step, const ContactPoint& contact) {
  return contact.gap_start - target_gap(contact) +
         step.h() * contact.normal.dot(velocity_end(step, contact));
}

double measure_wave_rows(ContactStep& step) {
  const double h = step.h();
  double worst = 0;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    const ContactPoint& contact = step.contacts[k];
    Constraint& row = step.scratch.bodies.rows[k];
    ContactConstraint& law = row.contact();
    law.gap = wave_gap_error(step, contact) / h;
    law.push = push_out(step, contact) / h;
    law.friction = contact.friction;
    row.compliance = step.settings.compliance / (h * h);
    row.impulse = contact.impulse;
    row.slip = velocity_end(step, contact) + spin_slip(step, row);
    worst = std::max(worst, h * row_error(row));
  }
  return worst;
}

void apply_wave_changes(ContactStep& step) {
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    if (step.scratch.change[k].isZero(0)) continue;
    const Constraint& row = step.scratch.bodies.rows[k];
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      strike_end(step, row.ends[e], row.ends[e].weight * step.scratch.change[k]);
    }
  }
  predict_struck(step);
}

void predict_struck(ContactStep& step) {
  StepBlows& blows = step.scratch.blows;
  const ContactPass& pass = step.pass;
  const StepInput& input = pass.input;
  blows.with_gravity = input.loads;
  blows.with_gravity.force.resize(pass.state.vertices.size(), Vec3::Zero());
  std::vector<ComponentId> touched;
  for (const Component& component : pass.state.components) {
    if (!blows.component_touched[component.id.index()]) continue;
    touched.push_back(component.id);
    // The field of forces of a rigid change of spin.
    const Vec3& twist = blows.component_twist[component.id.index()];
    const Vec3 spin = component.supported || twist.isZero(0)
                          ? Vec3::Zero()
                          : solve3(world_inertia(pass.state, component), twist);
    const Vec3 push = blows.component_push[component.id.index()] / component.mass;
    for (VertexId v : component.vertices) {
      const std::size_t i = v.index();
      const Vec3 rigid = pass.state.vertices.mass[i] *
                         (push + spin.cross(pass.state.vertices.position[i] - component.centre));
      blows.with_gravity.force[i] += (blows.vertex_impulse[i] + rigid) / step.h();
    }
  }
  predict(pass.mechanics, pass.state,
          {input.corners, blows.with_gravity, input.settings, input.part, input.members}, touched);
}

void predict_wave_balls(ContactStep& step) {
  const double h = step.h();
  for (std::size_t k = 0; k < step.pass.obstacles.size(); ++k) {
    const Obstacle& ball = step.pass.obstacles[k];
    if (!ball.mass) continue;
    // One that is touched goes by its velocity at the end, so that it ends where its contacts are
    // solved for: in a sub-step small ones go farther than their radius.
    const double share = step.scratch.blows.ball_touched[k] ? 1 : 0.5;
    const Vec3 end = angular_momentum_of(ball) + step.scratch.blows.ball_twist[k];
    step.scratch.ball_end[k] = {
        pose_of(ball.shape).centre +
            h * ((1 - share) * ball.velocity + share * ball_velocity(step, k)),
        turned_obstacle(ball, end, h)};
  }
}

void move_wave_balls(ContactStep& step) {
  for (std::size_t k = 0; k < step.pass.obstacles.size(); ++k) {
    Obstacle& ball = step.pass.obstacles[k];
    if (!ball.mass || !step.pass.input.members.has_ball(k)) continue;
    ball.velocity = ball_velocity(step, k);
    if (is_sphere(ball)) {
      ball.spin = ball_spin(step, k);
      put(ball.shape, step.scratch.ball_end[k]);
      continue;
    }
    const Vec3 momentum = angular_momentum_of(ball) + step.scratch.blows.ball_twist[k];
    put(ball.shape, step.scratch.ball_end[k]);
    ball.spin = spin_of(ball, momentum);
  }
}

}  // namespace sunder

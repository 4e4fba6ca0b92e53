// SPDX-License-Identifier: MIT
// The inelastic impact of lumped vertices.
#include "mechanics/contact/response/contact_bounce.hpp"

#include <algorithm>

#include "mechanics/frame/mean_axis.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// Share of h a that a free vertex will still gain from the acceleration the scheme remembers.
double velocity_to_come(double rho_infinity) {
  const auto [alpha_m, alpha_f, beta, gamma] = generalised_alpha(rho_infinity);
  const double r = -alpha_m / (1 - alpha_m);
  return (1 - gamma + gamma * r) / (1 - r);
}

struct Bounce {
  const ContactPass& pass;
  ContactBodies& bodies;

  const Component& component_of(const ContactEnd& end) const {
    return pass.state.components[bodies.component[end.body].index()];
  }
  /// lambda h of the component at an end, s.
  double reach(const ContactEnd& end) const {
    const double rho = settings_of(pass.input, pass.state, component_of(end)).rho_infinity;
    return pass.input.deformation_step(component_of(end)) * velocity_to_come(rho);
  }
  bool is_ball(const ContactEnd& end) const { return bodies.ball[end.body] != ContactBodies::none; }
};

/// Velocity of one end, m/s, including that of the remembered acceleration.
Vec3 coming_velocity(const Bounce& bounce, const ContactEnd& end) {
  if (bounce.is_ball(end)) {
    const Obstacle& ball = bounce.pass.obstacles[bounce.bodies.ball[end.body]];
    return ball.velocity + ball.spin.cross(end.arm);
  }
  const VertexColumns& vertices = bounce.pass.state.vertices;
  if (end.vertex.is_none() && !is_isolated(bounce.component_of(end))) {
    const Component& c = bounce.component_of(end);
    const Vec3 spin = bounce.bodies.bodies[end.body].inverse_inertia * c.angular_momentum;
    return c.momentum / c.mass + spin.cross(end.lever);
  }
  if (end.vertex.is_none()) {
    Vec3 mean = Vec3::Zero();
    for (VertexId v : bounce.component_of(end).vertices) {
      mean += 0.25 * vertices.velocity[v.index()];
    }
    return mean;
  }
  const std::size_t v = end.vertex.index();
  const Component& component = bounce.component_of(end);
  Vec3 velocity =
      vertices.velocity[v] +
      bounce.reach(end) * (component.orientation * vertices.displacement_acceleration[v]);
  // Nothing for a held component, whose inverse inertia is zero.
  const Vec3 spin = bounce.bodies.bodies[end.body].inverse_inertia * component.angular_momentum;
  velocity += spin.cross(end.lever);
  return velocity;
}

/// Turns the normal acceleration that a vertex remembers into the velocity that will come from it.
void spend_acceleration(const Bounce& bounce, const Constraint& row) {
  VertexColumns& vertices = bounce.pass.state.vertices;
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const ContactEnd& end = row.ends[e];
    if (bounce.is_ball(end) || bounce.component_of(end).rigid) continue;
    const std::size_t v = end.vertex.index();
    const Vec3 n = bounce.component_of(end).orientation.conjugate() * row.normal;
    const Vec3 along =
        free_part(bounce.pass.state, end.vertex, n * n.dot(vertices.displacement_acceleration[v]));
    vertices.displacement_acceleration[v] -= along;
    vertices.displacement_rate[v] += bounce.reach(end) * along;
  }
}

/// Brings d', d'' back to the mean-axis conditions and the velocities up to date; P and L stay.
void settle_rates(MechanicsState& state, const Component& component) {
  VertexColumns& vertices = state.vertices;
  const Mat3 R = component.orientation.toRotationMatrix();
  if (component.supported) {
    for (VertexId v : component.vertices) {
      if (is_held_whole(state, v)) continue;
      vertices.velocity[v.index()] =
          component.frame_velocity + R * vertices.displacement_rate[v.index()];
    }
    return;
  }
  const RestShape shape = rest_shape(vertices, component.vertices, component.rest_centre);
  Eigen::Matrix3Xd q = shape.arm, rate = shape.arm, acceleration = shape.arm;
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    const std::size_t v = component.vertices[static_cast<std::size_t>(i)].index();
    q.col(i) += vertices.displacement[v];
    rate.col(i) = vertices.displacement_rate[v];
    acceleration.col(i) = vertices.displacement_acceleration[v];
  }
  project_rate(rate, shape, q);
  project_acceleration(acceleration, shape);
  const Vec3 spin = solve3(inertia_of(shape.mass, q), R.transpose() * component.angular_momentum -
                                                          moment_of(shape.mass, q, rate));
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    const std::size_t v = component.vertices[static_cast<std::size_t>(i)].index();
    vertices.displacement_rate[v] = rate.col(i);
    vertices.displacement_acceleration[v] = acceleration.col(i);
    vertices.velocity[v] =
        component.momentum / component.mass + R * (spin.cross(Vec3(q.col(i))) + rate.col(i));
  }
}

/// Rows for the impulses to take back: from minus the given impulse to zero, without friction.
/// Gives the largest parting velocity.
double set_rows(const Bounce& bounce, std::span<const ContactPoint> contacts) {
  double fastest = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    Constraint& row = bounce.bodies.rows[k];
    Vec3 parting = Vec3::Zero();
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      parting += row.ends[e].weight * coming_velocity(bounce, row.ends[e]);
    }
    const auto driven = [&](std::uint32_t obstacle) -> Vec3 {
      const bool is_driven =
          obstacle != ContactPoint::none && !bounce.pass.obstacles[obstacle].mass;
      return is_driven ? bounce.pass.obstacles[obstacle].velocity : Vec3::Zero();
    };
    parting += driven(contacts[k].ball) - driven(contacts[k].obstacle);
    ContactConstraint& law = row.contact();
    law.gap = row.normal.dot(parting);
    law.least = -std::max(0.0, row.normal.dot(contacts[k].impulse));
    law.most = 0;
    row.impulse.setZero();
    if (law.least < 0) fastest = std::max(fastest, law.gap);
  }
  return fastest;
}

}  // namespace

void take_back_bounce(std::span<ContactPoint> contacts, ContactBodies& bodies,
                      const ContactPass& pass, const ContactSettings& settings) {
  if (contacts.empty() || pass.input.settings.integrator != Integrator::floating_frame) return;
  gather_lumped_bodies(bodies, contacts, pass);
  const Bounce bounce{pass, bodies};
  const double fastest = set_rows(bounce, contacts);
  if (!(fastest > 0)) return;
  // With a unit step, displacements are velocities.
  solve_contacts(bodies.rows, bodies.bodies,
                 {1, settings.tolerance * fastest, settings.max_iterations, pass.input.hurry});
  for (const Constraint& row : bodies.rows) {
    if (!row.impulse.isZero(0)) spend_acceleration(bounce, row);
  }
  for (const ComponentId id : bodies.component) {
    if (!id.is_none() && !pass.state.components[id.index()].rigid) {
      settle_rates(pass.state, pass.state.components[id.index()]);
    }
  }
  std::vector<VertexImpulse> hits;
  std::vector<Vec3> twist(bodies.bodies.size(), Vec3::Zero());
  std::vector<Vec3> push(bodies.bodies.size(), Vec3::Zero());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Constraint& row = bodies.rows[k];
    contacts[k].impulse += row.impulse;
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      const Vec3 impulse = row.ends[e].weight * row.impulse;
      if (bounce.is_ball(row.ends[e])) {
        strike_ball(pass.obstacles[bodies.ball[row.ends[e].body]], impulse, row.ends[e].arm);
      } else {
        const ContactEnd& end = row.ends[e];
        const Component& component = bounce.component_of(end);
        twist[end.body] += end.lever.cross(impulse);
        if (end.vertex.is_none() && !is_isolated(component)) {
          push[end.body] += impulse;
        } else if (end.vertex.is_none()) {
          for (VertexId v : component.vertices) hits.push_back({v, 0.25 * impulse});
        } else {
          hits.push_back({end.vertex, impulse});
        }
      }
    }
  }
  apply_impulses(pass.state, hits);
  for (std::size_t b = 0; b < twist.size(); ++b) {
    if (bodies.component[b].is_none()) continue;
    apply_push(pass.state, bodies.component[b], push[b]);
    apply_twist(pass.state, bodies.component[b], twist[b]);
  }
}

}  // namespace sunder

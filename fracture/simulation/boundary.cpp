// SPDX-License-Identifier: MIT
// Roles by distance; carried bodies from the end of their step back and forth.
#include "fracture/simulation/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/frame/mean_axis.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// A component or free ball by its surrounding ball.
struct Body {
  const Component* component = nullptr;  ///< null: a ball
  std::size_t row = 0;
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double edge = 0;  ///< m, of the longest edge of its tetrahedra at rest
};

/// Longest edge of a component's tetrahedra at rest, m.
double longest_edge(const SimulationState& s, const Component& component) {
  double squared = 0;
  const std::vector<Vec3>& rest = s.mechanics.vertices.rest_position;
  for (TetId t : component.tetrahedra) {
    const Corners& c = s.cells.map.corners()[t.index()];
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        squared = std::max(squared, (rest[c[i].index()] - rest[c[j].index()]).squaredNorm());
      }
    }
  }
  return std::sqrt(squared);
}

Body body_of(const SimulationState& s, const Component& c) {
  // A deformed body is larger than at rest, by less than this.
  return {&c, c.id.index(), c.centre, 1.1 * c.rest_radius, longest_edge(s, c)};
}

std::vector<Body> bodies_of(const SimulationState& s) {
  const RubbleState& rubble = s.ladder.rubble;
  std::vector<Body> bodies;
  for (const Component& c : s.mechanics.components) {
    const bool is_apart = !rubble.apart.empty() && rubble.apart[c.id.index()];
    if (!c.tetrahedra.empty() && !is_apart) bodies.push_back(body_of(s, c));
  }
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    if (!s.obstacles[k].mass) continue;
    if (!rubble.ball_apart.empty() && rubble.ball_apart[k]) continue;
    const Shape& shape = s.obstacles[k].shape;
    bodies.push_back({nullptr, k, pose_of(shape).centre, radius_of(shape), 0});
  }
  return bodies;
}

Role& role_of(Boundary& boundary, const Body& body) {
  return body.component ? boundary.component[body.row] : boundary.ball[body.row];
}

/// Whether two bodies are nearer than `reach` by their balls. If one is much larger, its vertices
/// are tested against the other's ball. A body that touches a tetrahedron is no farther from its
/// vertices than its longest edge.
bool is_near(const SimulationState& s, const Body& a, const Body& b, double reach) {
  if ((a.center - b.center).norm() > a.radius + b.radius + reach) return false;
  const Body& large = a.radius >= b.radius ? a : b;
  const Body& small = a.radius >= b.radius ? b : a;
  if (!large.component || large.radius < 2 * small.radius) return true;
  const double most = small.radius + reach + large.edge;
  return std::ranges::any_of(large.component->vertices, [&](VertexId v) {
    return (s.mechanics.vertices.position[v.index()] - small.center).squaredNorm() <= most * most;
  });
}

/// Calls `visit(body)` once for each of `others` near one of `from`. If it returns true, the body
/// counts among `from` too.
template <class Visit>
void visit_near(const SimulationState& s, std::vector<Body> from, std::vector<Body> others,
                double reach, Visit visit) {
  while (!from.empty() && !others.empty()) {
    const Body source = from.back();
    from.pop_back();
    const auto out = std::partition(others.begin(), others.end(), [&](const Body& other) {
      return !is_near(s, source, other, reach);
    });
    for (auto it = out; it != others.end(); ++it) {
      if (visit(*it)) from.push_back(*it);
    }
    others.erase(out, others.end());
  }
}

/// Free balls that could meet open components through other bodies become members too.
void take_balls(Boundary& boundary, const SimulationState& s, std::span<const Body> bodies,
                double reach) {
  if (std::ranges::none_of(s.obstacles, [](const Obstacle& o) { return o.mass.has_value(); })) {
    return;
  }
  std::vector<Body> open, others;
  for (const Body& b : bodies) {
    (role_of(boundary, b) == Role::member ? open : others).push_back(b);
  }
  visit_near(s, open, others, reach, [&](const Body& b) {
    if (!b.component) boundary.ball[b.row] = Role::member;
    return true;
  });
}

/// Gives a role to the bodies within reach of members.
void surround(Boundary& boundary, const SimulationState& s, std::span<const Body> bodies,
              double reach, Role role) {
  std::vector<Body> members, others;
  for (const Body& b : bodies) {
    (role_of(boundary, b) == Role::member ? members : others).push_back(b);
  }
  visit_near(s, members, others, reach, [&](const Body& b) {
    role_of(boundary, b) = role;
    return false;
  });
}

/// Positions and velocities of a component from its frame; with rates of deformation or without.
void write_rows(MechanicsState& state, const Component& c, bool with_rates) {
  VertexColumns& vertices = state.vertices;
  const Mat3 R = c.orientation.toRotationMatrix();
  Vec3 spin = Vec3::Zero();
  Vec3 velocity = c.frame_velocity;
  if (!c.supported) {
    Vec3 l = R.transpose() * c.angular_momentum;
    for (VertexId v : c.vertices) {
      if (!with_rates) break;
      const Vec3 q =
          vertices.rest_position[v.index()] - c.rest_centre + vertices.displacement[v.index()];
      l -= vertices.mass[v.index()] * q.cross(vertices.displacement_rate[v.index()]);
    }
    spin = solve3(deformed_inertia(vertices, c), l);
    velocity = c.momentum / c.mass;
  }
  for (VertexId v : c.vertices) {
    const std::size_t i = v.index();
    const Vec3 q = vertices.rest_position[i] - c.rest_centre + vertices.displacement[i];
    Vec3 turning = spin.cross(q);
    if (with_rates) turning += vertices.displacement_rate[i];
    vertices.position[i] = c.centre + R * q;
    vertices.velocity[i] = velocity + R * turning;
  }
}

/// Moves a body that has taken its step back by `time`, at its end velocity.
void carry_back(Boundary& boundary, MechanicsState& state, std::size_t row, const Vec3& gravity,
                double time) {
  Component& c = state.components[row];
  c.rung = Rung::carried;
  const Vec3 way = -time * (c.supported ? c.frame_velocity : Vec3(c.momentum / c.mass));
  c.centre += way;
  boundary.gravity_work += c.mass * gravity.dot(way);
  if (!c.supported) {
    c.orientation =
        turn_through_step(c.orientation, {deformed_inertia(state.vertices, c), Vec3::Zero(),
                                          -c.angular_momentum, -c.angular_momentum, time});
  }
  write_rows(state, c, false);
}

bool is_carried(const Boundary& boundary, const Component& c) {
  return !c.tetrahedra.empty() && boundary.component[c.id.index()] == Role::carried;
}

/// How far from where its whole step took it a carried body ends, m.
double astray(const Boundary& boundary, const MechanicsState& state, const Component& c,
              double left) {
  if (c.supported) return 0;
  const Component& was = boundary.frame[c.id.index()];
  const Vec3 turn = c.orientation.conjugate() * (c.angular_momentum - was.angular_momentum);
  const double spin = solve3(deformed_inertia(state.vertices, c), turn).norm();
  return left * ((c.momentum - was.momentum).norm() / c.mass + spin * c.rest_radius);
}

}  // namespace

double reach_of_step(const SimulationState& s, const Vec3& gravity, double h) {
  double squared = 0;
  for (const Vec3& v : s.mechanics.vertices.velocity) squared = std::max(squared, v.squaredNorm());
  for (const Obstacle& o : s.obstacles) squared = std::max(squared, o.velocity.squaredNorm());
  for (const PrescribedMotion& motion : s.mechanics.motions) {
    const double time = s.mechanics.time + h;
    squared = std::max(squared, mean_velocity(motion, time, time).squaredNorm());
  }
  return 4 * h * (std::sqrt(squared) + h * gravity.norm());
}

void assign_roles(Boundary& boundary, const SimulationState& s, std::span<const ComponentId> open,
                  double reach) {
  boundary.component.assign(s.mechanics.components.size(), Role::other);
  boundary.ball.assign(s.obstacles.size(), Role::other);
  for (ComponentId id : open) boundary.component[id.index()] = Role::member;
  // A carried rigid body is free or moves at one velocity. A body that slides along an axis, or is
  // led at a velocity that is raised, does neither.
  for (const Component& c : s.mechanics.components) {
    if (!open.empty() && (c.partly_held || is_raised(s.mechanics, c)))
      boundary.component[c.id.index()] = Role::member;
  }
  const std::vector<Body> bodies = bodies_of(s);
  take_balls(boundary, s, bodies, reach);
  surround(boundary, s, bodies, reach, Role::member);
  surround(boundary, s, bodies, reach, Role::carried);
}

void begin_boundary(Boundary& boundary, SimulationState& s, const Vec3& gravity, double time) {
  MechanicsState& m = s.mechanics;
  boundary.pushed.assign(m.components.size(), 0);
  boundary.spread.assign(m.components.size(), 0);
  boundary.rung.clear();
  for (const Component& c : m.components) boundary.rung.push_back(c.rung);
  boundary.frame.clear();
  for (const Component& c : m.components) {
    Component& copy = boundary.frame.emplace_back();
    copy.centre = c.centre;
    copy.orientation = c.orientation;
    copy.momentum = c.momentum;
    copy.angular_momentum = c.angular_momentum;
  }
  boundary.position = m.vertices.position;
  boundary.velocity = m.vertices.velocity;
  for (const Component& c : m.components) {
    if (is_carried(boundary, c)) carry_back(boundary, m, c.id.index(), gravity, time);
  }
}

void note_pushed(Boundary& boundary, const MechanicsState& m,
                 std::span<const ContactPoint> contacts) {
  const auto see = [&](ComponentId id) {
    if (boundary.component[id.index()] == Role::carried) boundary.pushed[id.index()] = 1;
  };
  for (const ContactPoint& c : contacts) for_each_component(c, m, see);
}

void spread_boundary(Boundary& boundary, SimulationState& s, const Vec3& gravity, double left,
                     double reach, double tolerance) {
  std::vector<Body> from, others;
  for (const Component& c : s.mechanics.components) {
    if (!is_carried(boundary, c) || !boundary.pushed[c.id.index()]) continue;
    char& spread = boundary.spread[c.id.index()];
    if (spread || astray(boundary, s.mechanics, c, left) <= tolerance) continue;
    spread = 1;
    from.push_back(body_of(s, c));
  }
  if (from.empty()) return;
  for (const Body& b : bodies_of(s)) {
    if (b.component && role_of(boundary, b) == Role::other) others.push_back(b);
  }
  visit_near(s, from, others, reach, [&](const Body& b) {
    boundary.component[b.row] = Role::carried;
    carry_back(boundary, s.mechanics, b.row, gravity, left);
    return false;
  });
}

void release(Boundary& boundary, SimulationState& s, ComponentId id, const Vec3& gravity,
             double left) {
  Role& role = boundary.component[id.index()];
  if (role != Role::carried) return;
  role = Role::member;
  Component& c = s.mechanics.components[id.index()];
  c.rung = Rung::full;
  if (!c.supported && boundary.rung[id.index()] != Rung::asleep) {
    // Back on the parabola: its momentum here, and its place.
    const Vec3 impulse = left * c.mass * gravity;
    const Vec3 way = 0.5 * left * left * gravity;
    boundary.gravity_impulse -= impulse_at(c.centre, c.momentum);
    c.momentum -= impulse;
    c.centre += way;
    boundary.gravity_impulse += impulse_at(c.centre, c.momentum);
    boundary.gravity_work += c.mass * gravity.dot(way);
  }
  write_rows(s.mechanics, c, true);
}

void end_boundary(Boundary& boundary, SimulationState& s) {
  if (boundary.rung.empty()) return;
  for (Component& c : s.mechanics.components) {
    if (!is_carried(boundary, c)) continue;
    const std::size_t row = c.id.index();
    if (boundary.pushed[row] && !c.supported) {
      c.rung = Rung::full;
      write_rows(s.mechanics, c, true);
      continue;
    }
    const Component& was = boundary.frame[row];
    c.rung = boundary.rung[row];
    c.centre = was.centre;
    c.orientation = was.orientation;
    c.momentum = was.momentum;
    c.angular_momentum = was.angular_momentum;
    for (VertexId v : c.vertices) {
      s.mechanics.vertices.position[v.index()] = boundary.position[v.index()];
      s.mechanics.vertices.velocity[v.index()] = boundary.velocity[v.index()];
    }
  }
  boundary.rung.clear();
}

}  // namespace sunder

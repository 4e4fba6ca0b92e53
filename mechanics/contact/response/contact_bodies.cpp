// SPDX-License-Identifier: MIT
// Answers of bodies to contact impulses, and the rows of contacts on them.
#include "mechanics/contact/response/contact_bodies.hpp"

#include <algorithm>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/frame/rotation.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/integrators/modal.hpp"
#include "mechanics/solver/component_system.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// m: the mass centre of a free obstacle.
Vec3 centre_of(const Obstacle& free) { return pose_of(free.shape).centre; }

/// The factor on A^-1 of a part of a step in the response to a unit impulse. The impulse is spread
/// over the part as a force: displacement beta h^2 over the part's length.
double response_scale(const ContactPass& pass, const Component& component) {
  const StepInput& input = pass.input;
  const double h = input.deformation_step(component);
  const double rho = settings_of(input, pass.state, component).rho_infinity;
  return generalised_alpha(rho).beta * h * (h / input.settings.time_step);
}

/// Vertices of slots that are free, by their numbers in the system, and their slots.
struct FreeSlots {
  std::vector<std::uint32_t> local;
  std::vector<Eigen::Index> slot;
};

FreeSlots free_slots(const ContactPass& pass, std::span<const VertexId> slots) {
  FreeSlots free;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (is_held_whole(pass.state, slots[k])) continue;
    free.local.push_back(pass.state.systems.local_row[slots[k].index()]);
    free.slot.push_back(static_cast<Eigen::Index>(k));
  }
  return free;
}

/// Whether the body responds by deforming, in floating_frame or modal.
bool responds_elastically(const ContactPass& pass, const Component& component) {
  return takes_split_blow(pass, component) && !component.rigid && !is_stiff(component.rung) &&
         (component.partly_held || pass.input.part.deformation != Deformation::frozen);
}

/// Elastic response of floating_frame at the end of a part of a step: `response_scale` A^-1 on
/// loads freed of their rigid part. Rigid fields r have A r = mu M r, so the response to a load's
/// rigid part is subtracted in closed form.
void respond_elastically(RespondingBody& body, const ContactPass& pass, const Component& component,
                         std::span<const VertexId> slots) {
  ComponentSystem& system = *pass.state.systems.present[component.id.index()];
  const auto [local, slot] = free_slots(pass, slots);
  body.turn = component.orientation.toRotationMatrix();
  if (pass.input.settings.integrator == Integrator::modal) {
    const Eigen::MatrixXd response =
        modal_response({pass.mechanics, pass.state, pass.input, component, &system}, local);
    const auto size = static_cast<Eigen::Index>(3 * slots.size());
    body.elastic.setZero(size, size);
    for (std::size_t b = 0; b < slot.size(); ++b) {
      for (std::size_t a = 0; a < slot.size(); ++a) {
        body.elastic.block<3, 3>(3 * slot[a], 3 * slot[b]) = response.block<3, 3>(
            static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b));
      }
    }
    return;
  }
  const std::vector<std::uint32_t> places = touch_compliance(system, local);
  const SystemFactor& factor = system.step;
  const double scale = response_scale(pass, component);
  if (!component.supported) {
    body.rigid_mass = scale / (factor.matrix.mass * component.mass);
    body.rigid_inertia = scale / factor.matrix.mass * system.shape.inertia.inverse();
  }
  body.cached = &factor.compliance;
  body.cached_scale = scale;
  body.cached_places.assign(slots.size(), ContactEnd::no_slot);
  for (std::size_t k = 0; k < slot.size(); ++k) {
    body.cached_places[static_cast<std::size_t>(slot[k])] = places[k];
  }
}

/// Columns of A^-1 that the responses will be made of, those of all bodies together.
void solve_for_columns(const ContactBodies& bodies, const ContactPass& pass) {
  if (pass.input.settings.integrator == Integrator::modal) return;
  std::vector<ColumnBlock> missing;
  for (std::size_t b = 0; b < bodies.component.size(); ++b) {
    if (bodies.component[b].is_none()) continue;
    const Component& component = pass.state.components[bodies.component[b].index()];
    if (!responds_elastically(pass, component)) continue;
    note_touched(*pass.state.systems.present[component.id.index()],
                 free_slots(pass, bodies.slots[b]).local, missing);
  }
  // A second thread must have enough work to be worth its start.
  std::size_t rows = 0;
  for (const ColumnBlock& block : missing) rows += block.system->free_count;
  constexpr std::size_t least_rows = 4000;
  fill_columns(missing, rows >= least_rows ? pass.input.threads : 1, pass.mechanics.columns);
}

RespondingBody responding_component(const ContactPass& pass, const Component& component,
                                    std::span<const VertexId> slots) {
  RespondingBody body;
  if (!takes_split_blow(pass, component)) {
    body.elastic = end_of_step_response(pass.state, pass.input, {component.id, slots});
    return body;
  }
  if (!component.supported) {
    body.inverse_mass = 1 / component.mass;
    body.inverse_inertia = world_inertia(pass.state, component).inverse();
  }
  if (responds_elastically(pass, component)) respond_elastically(body, pass, component, slots);
  return body;
}

RespondingBody lumped_component(const ContactPass& pass, const Component& component,
                                std::span<const VertexId> slots) {
  RespondingBody body;
  if (component.rigid || component.rung == Rung::carried) {
    if (component.supported) return body;
    body.inverse_mass = 1 / component.mass;
    body.inverse_inertia = world_inertia(pass.state, component).inverse();
    return body;
  }
  const auto size = static_cast<Eigen::Index>(3 * slots.size());
  body.elastic = Eigen::MatrixXd::Zero(size, size);
  if (!component.supported) {
    body.inverse_inertia = world_inertia(pass.state, component).inverse();
    body.rigid_inertia = body.inverse_inertia;
  }
  const Mat3 R = component.orientation.toRotationMatrix();
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const std::size_t v = slots[k].index();
    const Vec3 free = free_part(pass.state, slots[k], Vec3::Ones());
    const auto row = static_cast<Eigen::Index>(3 * k);
    body.elastic.block<3, 3>(row, row) =
        free == Vec3::Ones()
            ? Mat3(Mat3::Identity() / pass.state.vertices.mass[v])
            : Mat3(R * free.asDiagonal() * R.transpose() / pass.state.vertices.mass[v]);
  }
  return body;
}

RespondingBody responding_ball(const Obstacle& ball) {
  RespondingBody body;
  body.inverse_mass = 1 / *ball.mass;
  body.inverse_inertia = inverse_inertia(ball);
  return body;
}

/// Gives the component or ball a place among the bodies.
std::uint32_t enlist(ContactBodies& bodies, ComponentId component, std::uint32_t ball) {
  std::uint32_t& place =
      component.is_none() ? bodies.body_of_ball[ball] : bodies.body_of_component[component.index()];
  if (place == ContactBodies::none) {
    place = static_cast<std::uint32_t>(bodies.component.size());
    bodies.component.push_back(component);
    bodies.ball.push_back(ball);
    bodies.slots.emplace_back();
  }
  return place;
}

/// Calls `visit(vertex)` for every vertex that a contact acts on.
template <class Visit>
void for_each_vertex(const ContactPoint& contact, const ContactPass& pass, Visit visit) {
  const auto visit_all = [&](const TouchedNodes& nodes) {
    for (std::size_t i = 0; i < nodes.count; ++i) {
      if (nodes.share[i] != 0) visit(nodes.row[i]);
    }
  };
  if (contact.is_body_a()) visit_all(nodes_of_a(contact, pass.input.corners));
  if (contact.is_body_b()) visit_all(touched_nodes(contact, pass.state, pass.input.corners));
}

/// Which bodies there are, and the slots of each.
void enlist_all(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                const ContactPass& pass) {
  bodies.body_of_component.assign(pass.state.components.size(), ContactBodies::none);
  bodies.body_of_ball.assign(pass.obstacles.size(), ContactBodies::none);
  bodies.slot_of_vertex.resize(pass.state.vertices.size());
  bodies.component.clear();
  bodies.ball.clear();
  bodies.slots.clear();
  for (const ContactPoint& contact : contacts) {
    for_each_vertex(contact, pass, [&](VertexId v) {
      const std::uint32_t place =
          enlist(bodies, pass.state.vertices.component[v.index()], ContactBodies::none);
      bodies.slots[place].push_back(v);
    });
    for (const std::uint32_t row : {contact.ball, contact.obstacle}) {
      if (row != ContactPoint::none && pass.obstacles[row].mass) {
        enlist(bodies, ComponentId::none(), row);
      }
    }
  }
  for (std::vector<VertexId>& slots : bodies.slots) {
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    for (std::size_t k = 0; k < slots.size(); ++k) {
      bodies.slot_of_vertex[slots[k].index()] = static_cast<std::uint32_t>(k);
    }
  }
}

void add_end(Constraint& row, const ContactEnd& end) { row.ends[row.end_count++] = end; }

ContactEnd vertex_end(const ContactBodies& bodies, const ContactPass& pass, VertexId v,
                      double weight) {
  const ComponentId id = pass.state.vertices.component[v.index()];
  ContactEnd end;
  end.vertex = v;
  end.body = bodies.body_of_component[id.index()];
  end.weight = weight;
  end.arm = pass.state.vertices.position[v.index()] - pass.state.components[id.index()].centre;
  if (bodies.bodies[end.body].cached || bodies.bodies[end.body].elastic.size() > 0) {
    const Component& component = pass.state.components[id.index()];
    end.slot = bodies.slot_of_vertex[v.index()];
    end.rest_arm = pass.state.vertices.rest_position[v.index()] - component.rest_centre;
  }
  return end;
}

/// Nodes of a component by their shares; `sign`: 1 on side A, -1 on side B. All have the arm of
/// `place`, where side A is: both sides then feel the same line of action, and angular momentum is
/// conserved exactly. The rest of that moment, beyond the nodes' own, is rigid and deforms nothing.
void add_node_ends(Constraint& row, const TouchedNodes& nodes, ComponentId id, double sign,
                   const Vec3& place, const ContactBodies& bodies, const ContactPass& pass) {
  const Component& component = pass.state.components[id.index()];
  const Vec3 arm = place - component.centre;
  if (component.rigid) {
    add_end(
        row,
        {.body = bodies.body_of_component[id.index()], .weight = sign, .arm = arm, .lever = arm});
    return;
  }
  for (std::size_t i = 0; i < nodes.count; ++i) {
    if (nodes.share[i] == 0) continue;
    ContactEnd end = vertex_end(bodies, pass, nodes.row[i], sign * nodes.share[i]);
    end.lever = arm - end.arm;
    end.arm = arm;
    add_end(row, end);
  }
}

/// The points that a row acts on. Its gap, slip and bounds are the caller's.
Constraint row_of(const ContactPoint& contact, const ContactBodies& bodies,
                  const ContactPass& pass) {
  Constraint row;
  row.normal = contact.normal;
  row.impulse = contact.impulse;
  if (!contact.vertex.is_none()) {
    add_end(row, vertex_end(bodies, pass, contact.vertex, 1));
  } else if (contact.is_body_a()) {
    add_node_ends(row, nodes_of_a(contact, pass.input.corners), component_of_a(contact, pass.state),
                  1, place_of_side_a(pass, contact), bodies, pass);
  } else if (pass.obstacles[contact.ball].mass) {
    const Obstacle& ball = pass.obstacles[contact.ball];
    const Vec3 arm = contact.is_sphere_a()
                         ? Vec3(-radius_of(ball.shape) * contact.normal)
                         : Vec3(point_of_obstacle(contact, ball.shape) - centre_of(ball));
    add_end(row,
            {bodies.body_of_ball[contact.ball], ContactEnd::no_slot, 1, arm, Vec3::Zero(), {}});
  }
  const Vec3 place = place_of_side_a(pass, contact);
  if (contact.obstacle == ContactPoint::none) {
    add_node_ends(row, touched_nodes(contact, pass.state, pass.input.corners),
                  component_of_b(contact, pass.state), -1, place, bodies, pass);
  } else if (pass.obstacles[contact.obstacle].mass) {
    // From the ball's centre to where side A is, not to its surface: both sides then feel the same
    // line of action, and angular momentum is conserved exactly.
    const Vec3 arm = place - centre_of(pass.obstacles[contact.obstacle]);
    add_end(
        row,
        {bodies.body_of_ball[contact.obstacle], ContactEnd::no_slot, -1, arm, Vec3::Zero(), {}});
  }
  return row;
}

/// The enlisted bodies and their rows.
template <class MakeComponent>
void gather(ContactBodies& bodies, std::span<const ContactPoint> contacts, const ContactPass& pass,
            MakeComponent make_component) {
  bodies.bodies.clear();
  for (std::size_t b = 0; b < bodies.component.size(); ++b) {
    bodies.bodies.push_back(bodies.component[b].is_none()
                                ? responding_ball(pass.obstacles[bodies.ball[b]])
                                : make_component(pass,
                                                 pass.state.components[bodies.component[b].index()],
                                                 bodies.slots[b]));
  }
  bodies.rows.clear();
  for (const ContactPoint& contact : contacts) {
    bodies.rows.push_back(row_of(contact, bodies, pass));
  }
}

}  // namespace

bool takes_split_blow(const ContactPass& pass, const Component& component) {
  return component.rigid || is_floating(pass.input.settings.integrator);
}

Vec3 place_of_side_a(const ContactPass& pass, const ContactPoint& contact) {
  if (contact.is_body_a()) {
    return nodes_of_a(contact, pass.input.corners).sum(pass.state.vertices.position);
  }
  const Shape& ball = pass.obstacles[contact.ball].shape;
  const Vec3 place = point_of_obstacle(contact, ball);
  return contact.is_sphere_a() ? Vec3(place - radius_of(ball) * contact.normal) : place;
}

void gather_bodies(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                   const ContactPass& pass) {
  enlist_all(bodies, contacts, pass);
  solve_for_columns(bodies, pass);
  gather(bodies, contacts, pass, responding_component);
  merge_ends(bodies.rows, bodies.bodies);
}

void gather_rows(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                 const ContactPass& pass) {
  enlist_all(bodies, contacts, pass);
  gather(bodies, contacts, pass, [](const auto&...) { return RespondingBody{}; });
}

void gather_lumped_bodies(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                          const ContactPass& pass) {
  enlist_all(bodies, contacts, pass);
  gather(bodies, contacts, pass, lumped_component);
  // Vertices respond independently, and the body turns by the remaining moment: the turn by the
  // whole moment less the turn by the moment of the vertices.
  for (Constraint& row : bodies.rows) {
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      ContactEnd& end = row.ends[e];
      if (!end.vertex.is_none()) end.rest_arm = end.arm - end.lever;
    }
  }
  merge_ends(bodies.rows, bodies.bodies);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
#include "fracture/simulation/queries/poses.hpp"

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

/// m: where side A of a contact is.
Vec3 place_of(const SimulationState& s, const ContactPoint& contact) {
  if (contact.is_body_a()) {
    return nodes_of_a(contact, s.cells.map.corners()).sum(s.mechanics.vertices.position);
  }
  const Shape& shape = s.obstacles[contact.ball].shape;
  const Vec3 place = point_of_obstacle(contact, shape);
  return contact.is_sphere_a() ? Vec3(place - radius_of(shape) * contact.normal) : place;
}

std::optional<std::uint32_t> obstacle_of(std::uint32_t row) {
  if (row == ContactPoint::none) return std::nullopt;
  return row;
}

}  // namespace

std::vector<PiecePose> piece_poses(const Simulation& simulation) {
  const SimulationState& s = *simulation.state;
  std::vector<PiecePose> poses;
  for_each_living(s.mechanics, {}, [&](const Component& c) {
    poses.push_back({.id = c.id,
                     .body = body_of(simulation, c.tetrahedra.front()),
                     .parent = s.cells.labels.parent[c.id.index()],
                     .mass = c.mass,
                     .rest_centre = c.rest_centre,
                     .reference = {c.centre, c.orientation},
                     .drawn = s.display[c.id.index()],
                     .velocity = c.supported ? c.frame_velocity : Vec3(c.momentum / c.mass)});
  });
  return poses;
}

std::vector<ContactEvent> contact_events(const Simulation& simulation) {
  const SimulationState& s = *simulation.state;
  std::vector<ContactEvent> events;
  for (const ContactMemory::Remembered& last : s.contact.last_contacts) {
    const ContactPoint& c = last.contact;
    if (c.impulse.isZero(0)) continue;
    events.push_back({.a = {component_of_a(c, s.mechanics), obstacle_of(c.ball)},
                      .b = {component_of_b(c, s.mechanics), obstacle_of(c.obstacle)},
                      .place = place_of(s, c),
                      .impulse = c.impulse,
                      .duration = last.step});
  }
  return events;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
#include "fracture/simulation/poses.hpp"

#include <variant>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

/// m: where side A of a contact is.
Vec3 place_of(const SimulationState& s, const ContactPoint& contact) {
  const std::vector<Vec3>& position = s.mechanics.vertices.position;
  if (!contact.vertex.is_none()) return position[contact.vertex.index()];
  if (contact.is_body_a()) {
    const auto corners = s.cells.map.corners(contact.tetrahedron_a);
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      place += contact.weights_a[i] * position[corners[i].index()];
    }
    return place;
  }
  const Shape& shape = s.obstacles[contact.ball].shape;
  if (contact.corner != ContactPoint::none) return corner_at(shape, contact.corner);
  const auto* ball = std::get_if<Sphere>(&shape);
  return ball ? Vec3(ball->center - ball->radius * contact.normal) : Vec3(Vec3::Zero());
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

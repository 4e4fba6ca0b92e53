// SPDX-License-Identifier: MIT
// Rows, rigid pieces and bonds of a part of an impact, as explicit steps take them.
#include "mechanics/contact/waves/explicit_wave.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

LumpedSide side_of_rigid(WaveScratch& wave, std::uint32_t rigid, const Vec3& place) {
  LumpedSide side;
  WaveRigid& body = wave.contacts.rigid[rigid];
  side.rigid = rigid;
  side.arm = place - body.centre;
  body.reach = std::max(body.reach, side.arm.norm());
  return side;
}

LumpedSide side_of_component(WaveScratch& wave, ComponentId id, const TouchedNodes& nodes,
                             const Vec3& place) {
  const std::uint32_t rigid = wave.rigid_of_component[id.index()];
  LumpedSide side;
  if (rigid != LumpedSide::none) {
    side = side_of_rigid(wave, rigid, place);
  } else {
    side.body = wave.bodies.body_of_component[id.index()];
    side.first = static_cast<std::uint32_t>(wave.contacts.ends.size());
    for (std::size_t i = 0; i < nodes.count; ++i) {
      if (nodes.share[i] == 0) continue;
      wave.contacts.ends.push_back(
          {wave.bodies.node_of_vertex[nodes.row[i].index()], nodes.share[i]});
      ++side.count;
    }
  }
  side.is_component = true;
  return side;
}

LumpedSide side_of_obstacle(WaveScratch& wave, const ContactStep& step, std::uint32_t row,
                            const Vec3& place) {
  const std::uint32_t rigid = wave.rigid_of_obstacle[row];
  if (rigid != LumpedSide::none) return side_of_rigid(wave, rigid, place);
  LumpedSide side;
  side.velocity = step.pass.obstacles[row].velocity;
  side.start = place;
  return side;
}

/// The nodes of side B, a tetrahedron, and their shares. Of an overlap: those of the point of the
/// tetrahedron where side A is. Impulses on two places would need a moment, which does work.
TouchedNodes nodes_of_b(const ContactStep& step, const ContactPoint& c, const Vec3& place) {
  const MechanicsState& state = step.pass.state;
  const std::span<const Corners> corners = step.pass.input.corners;
  if (!c.is_of_overlap() || is_second_order(state.elements, c.tetrahedron)) {
    return touched_nodes(c, state, corners);
  }
  constexpr double farthest = 2;
  ContactPoint under = c;
  under.weights = barycentric(places_of(corners[c.tetrahedron.index()], paths_of(step)), place);
  const bool is_near =
      std::ranges::all_of(under.weights, [](double w) { return std::abs(w) < farthest; });
  return touched_nodes(is_near ? under : c, state, corners);
}

LumpedRow row_of(WaveScratch& wave, const ContactStep& step, const ContactPoint& c, double count) {
  const ContactPass& pass = step.pass;
  const std::span<const Corners> corners = pass.input.corners;
  const Vec3 place = place_of_side_a(pass, c);
  LumpedRow row;
  row.sides[0] = c.is_body_a() ? side_of_component(wave, component_of_a(c, pass.state),
                                                   nodes_of_a(c, corners), place)
                               : side_of_obstacle(wave, step, c.ball, place);
  row.sides[1] = c.is_body_b() ? side_of_component(wave, component_of_b(c, pass.state),
                                                   nodes_of_b(step, c, place), place)
                               : side_of_obstacle(wave, step, c.obstacle, place);
  row.normal = c.normal;
  row.gap_start = c.gap_start - target_gap(c);
  row.push = push_out(step, c) / step.h();
  // Overlaps hold along their normals: the faces that touch have the friction.
  row.friction = c.is_of_overlap() ? 0 : c.friction;
  row.give = step.settings.compliance;
  for (const LumpedSide& side : row.sides) {
    const auto [along, across] = response_of(side, wave.contacts, wave.bodies.nodes, c.normal);
    row.normal_response += along;
    row.tangential_response += across;
  }
  // As in `response_of` of implicit rows: a push lifts resting bodies, and wedges none.
  row.push_most = row.normal_response > 0 ? 100 * row.push / row.normal_response : 0;
  row.impulse = last_impulse(step, c) / count;
  return row;
}

}  // namespace

void enlist_rigid(WaveScratch& wave, const ContactStep& step) {
  const MechanicsState& state = step.pass.state;
  std::vector<WaveRigid>& rigid = wave.contacts.rigid;
  rigid.clear();
  wave.rigid_of_component.assign(state.components.size(), LumpedSide::none);
  wave.rigid_of_obstacle.assign(step.pass.obstacles.size(), LumpedSide::none);
  for_each_living(state, step.pass.input.members, [&](const Component& c) {
    if (deforms_in_wave(c) || c.rung == Rung::asleep) return;
    wave.rigid_of_component[c.id.index()] = static_cast<std::uint32_t>(rigid.size());
    WaveRigid body;
    body.component = c.id;
    body.centre = c.centre;
    body.orientation = c.orientation;
    const auto [push, torque] = surface_load(step, c);
    body.push = push;
    body.torque = torque;
    if (c.supported) {
      body.velocity = c.frame_velocity;
    } else {
      body.inverse_mass = 1 / c.mass;
      body.inverse_inertia = world_inertia(state, c).inverse();
      body.velocity = c.momentum / c.mass;
      body.angular_momentum = c.angular_momentum;
      body.spin = body.inverse_inertia * c.angular_momentum;
      if (c.rung != Rung::carried) body.fall = step.pass.input.loads.gravity;
    }
    rigid.push_back(body);
  });
  for (std::uint32_t k = 0; k < step.pass.obstacles.size(); ++k) {
    const Obstacle& free = step.pass.obstacles[k];
    if (!free.mass || !step.pass.input.members.has_ball(k)) continue;
    wave.rigid_of_obstacle[k] = static_cast<std::uint32_t>(rigid.size());
    WaveRigid body;
    body.component = ComponentId::none();
    body.obstacle = k;
    body.inverse_mass = 1 / *free.mass;
    body.inverse_inertia = inverse_inertia(free);
    body.centre = pose_of(free.shape).centre;
    body.velocity = free.velocity;
    body.orientation = pose_of(free.shape).orientation;
    body.angular_momentum = angular_momentum_of(free);
    body.spin = free.spin;
    body.fall = step.pass.input.loads.gravity;
    rigid.push_back(body);
  }
}

void make_rows(WaveScratch& wave, const ContactStep& step, double count) {
  LumpedContacts& contacts = wave.contacts;
  contacts.ends.clear();
  contacts.rows.clear();
  contacts.work = {};
  contacts.twist.assign(wave.bodies.bodies.size(), Vec3::Zero());
  for (const ContactPoint& c : step.contacts) {
    contacts.rows.push_back(row_of(wave, step, c, count));
  }
  measure_gaps(contacts, wave.bodies.nodes, 0);
  for (LumpedRow& row : contacts.rows) row.apart = row.sides[0].place - row.sides[1].place;
}

void take_ties(WaveScratch& wave, ContactStep& step, double count) {
  step.ties = gather_ties(step.memory, paths_of(step));
  std::vector<Vec3> first;
  for (const TiePair& pair : step.ties) {
    step.tied.push_back(contact_of(pair));
    first.push_back(last_impulse(step, step.tied.back()) / count);
  }
  make_bonds(wave.bonds, step.ties, first, wave.bodies);
}

}  // namespace sunder

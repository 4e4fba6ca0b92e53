// SPDX-License-Identifier: MIT
// Contacts, rigid pieces and bonds of a part of an impact, as explicit steps take them.
#include "mechanics/contact/waves/explicit_wave.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

/// Where everything gets in `ahead` s as it moves now, for detection.
void predict_free_flight(ContactStep& step, double ahead) {
  MechanicsScratch::Predicted& predicted = step.pass.mechanics.predicted;
  const VertexColumns& v = step.pass.state.vertices;
  predict(step.pass.mechanics, step.pass.state, step.pass.input, {});
  predicted.position = v.position;
  predicted.velocity = v.velocity;
  for_each_living(step.pass.state, {}, [&](const Component& c) {
    PredictedFrame& frame = predicted.frame[c.id.index()];
    frame.centre = c.centre;
    frame.orientation = c.orientation;
    if (!step.pass.input.members.has(c.id) || c.rung == Rung::asleep) return;
    frame.centre += ahead * (c.supported ? c.frame_velocity : Vec3(c.momentum / c.mass));
    for (const VertexId i : c.vertices)
      predicted.position[i.index()] += ahead * v.velocity[i.index()];
  });
  step.scratch.ball_end.resize(step.pass.obstacles.size());
  for (std::size_t k = 0; k < step.pass.obstacles.size(); ++k) {
    const Obstacle& free = step.pass.obstacles[k];
    if (!free.mass) continue;
    step.scratch.ball_end[k] = {pose_of(free.shape).centre + ahead * free.velocity,
                                turned_obstacle(free, angular_momentum_of(free), ahead)};
  }
}

/// Whether the bodies of a contact are members that move. A sleeping one waits for the next
/// detection.
bool takes_part(const ContactStep& step, const ContactPoint& contact) {
  bool all = true;
  for_each_component(contact, step.pass.state, [&](ComponentId id) {
    const bool sleeps = step.pass.state.components[id.index()].rung == Rung::asleep;
    all = all && step.pass.input.members.has(id) && !sleeps;
  });
  return all;
}

/// m: how far a vertex may be from where it was expected: a share of the smallest mean cell of
/// those that deform.
double stray_limit(const ContactStep& step) {
  constexpr double share = 0.02;
  const MechanicsState& state = step.pass.state;
  double cell = std::numeric_limits<double>::infinity();
  for_each_living(state, step.pass.input.members, [&](const Component& c) {
    if (deforms_in_wave(c)) cell = std::min(cell, mean_cell(state, c));
  });
  return std::isfinite(cell) ? share * cell : 0;
}

/// Whether a vertex of a member is farther from where the last search for contacts expected it than
/// `most` m.
bool has_strayed(const ContactStep& step, double most) {
  const WaveScratch& wave = *step.scratch.wave;
  const VertexColumns& v = step.pass.state.vertices;
  const double since = wave.since_search - step.h();
  for (std::size_t i = 0; i < wave.searched_position.size(); ++i) {
    if (!step.pass.input.members.has(v.component[i])) continue;
    const Vec3 expected = wave.searched_position[i] + since * wave.searched_velocity[i];
    if ((v.position[i] - expected).squaredNorm() > most * most) return true;
  }
  return false;
}

using VertexCopy = std::pair<VertexId, VertexId>;

/// Vertices that fans have split since the part before, each with a copy of it: they are still
/// where it was. Sorted.
std::vector<VertexCopy> copies_since(const std::vector<Vec3>& position, std::size_t before) {
  std::map<std::array<double, 3>, std::vector<VertexId>> at;
  const auto key_of = [&](std::size_t v) {
    return std::array{position[v].x(), position[v].y(), position[v].z()};
  };
  for (std::size_t v = before; v < position.size(); ++v) at[key_of(v)].emplace_back(v);
  std::vector<VertexCopy> copies;
  for (std::size_t v = 0; v < before && !at.empty(); ++v) {
    const auto found = at.find(key_of(v));
    if (found == at.end()) continue;
    for (const VertexId copy : found->second) copies.emplace_back(VertexId{v}, copy);
  }
  return copies;
}

/// Of a vertex and an obstacle.
bool is_on_obstacle(const ContactPoint& contact) {
  return !contact.vertex.is_none() && contact.obstacle != ContactPoint::none;
}

/// Contacts of the part before where they are now, those of split vertices for all their copies.
/// Vertices on obstacles and crack faces are found as they are now.
void take_kept_contacts(ContactStep& step) {
  const StepPaths paths = paths_of(step);
  const WaveScratch& wave = *step.scratch.wave;
  const auto take = [&](ContactPoint contact) {
    if (!takes_part(step, contact)) return;
    contact.impulse.setZero();
    contact.offset = contact.gap_start - contact.normal.dot(path_of(contact, paths).start);
    step.contacts.push_back(contact);
  };
  const std::vector<VertexCopy> copies =
      copies_since(step.pass.state.vertices.position, wave.vertices_of_kept);
  for (ContactPoint contact : wave.kept) {
    if (!contact.face.is_none() || is_on_obstacle(contact)) continue;
    take(contact);
    if (contact.vertex.is_none()) continue;
    for (const VertexCopy& copy :
         std::ranges::equal_range(copies, contact.vertex, {}, &VertexCopy::first)) {
      contact.vertex = copy.second;
      take(contact);
    }
  }
  DetectScratch& detect = step.scratch.detect;
  find_on_obstacles(detect, paths, step.settings);
  if (step.settings.between_pieces) {
    find_between_partners(detect, step.memory, paths, step.settings);
  }
  std::ranges::copy_if(detect.found, std::back_inserter(step.contacts),
                       [&](const ContactPoint& contact) { return takes_part(step, contact); });
}

LumpedSide side_of_rigid(const WaveScratch& wave, std::uint32_t rigid, const Vec3& place) {
  LumpedSide side;
  side.rigid = rigid;
  side.arm = place - wave.contacts.rigid[rigid].centre;
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

LumpedSide side_of_obstacle(const WaveScratch& wave, const ContactStep& step, std::uint32_t row,
                            const Vec3& place) {
  const std::uint32_t rigid = wave.rigid_of_obstacle[row];
  if (rigid != LumpedSide::none) return side_of_rigid(wave, rigid, place);
  LumpedSide side;
  side.velocity = step.pass.obstacles[row].velocity;
  side.start = place;
  return side;
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
                                                   touched_nodes(c, pass.state, corners), place)
                               : side_of_obstacle(wave, step, c.obstacle, place);
  row.normal = c.normal;
  row.gap_start = c.gap_start - target_gap(c);
  row.push = push_out(step, c) / step.h();
  row.friction = c.friction;
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

void gather_contacts(ContactStep& step) {
  WaveScratch& wave = *step.scratch.wave;
  double ahead = step.pass.input.part.contacts_for;
  step.margin = stray_limit(step);
  wave.since_search += step.h();
  if (ahead == 0) {
    ahead = wave.searched_for - (wave.since_search - step.h());
    if (!has_strayed(step, step.margin)) {
      predict_free_flight(step, step.h());
      return take_kept_contacts(step);
    }
  }
  wave.searched_position = step.pass.state.vertices.position;
  wave.searched_velocity = step.pass.state.vertices.velocity;
  wave.searched_for = ahead;
  wave.since_search = step.h();
  step.ahead = ahead;
  predict_free_flight(step, ahead);
  step.look = ContactStep::Look::all;
  meet(step, 0);
  step.ahead = 0;
  step.contacts = step.scratch.detect.found;
}

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

// SPDX-License-Identifier: MIT
// Sums of impulses by obstacle and by held box, and of works by load.
#include "fracture/simulation/ledger/force_report.hpp"

#include <algorithm>

#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// Impulse of the supports on one node.
struct NodeImpulse {
  VertexId node;
  Vec3 impulse;  ///< N s, world
};

/// A component by its held nodes.
struct HeldNodes {
  std::vector<VertexId> node;      ///< ascending
  std::vector<Holders> box;        ///< of each: rows of boxes, axis by axis
  std::vector<std::size_t> boxes;  ///< all of them, ascending
};

HeldNodes held_nodes(HeldRegions& regions, const MechanicsState& m, const Component& component) {
  HeldNodes held;
  for (const VertexId v : component.vertices) {
    if (m.vertices.support[v.index()].is_none()) continue;
    held.node.push_back(v);
    held.box.push_back(regions.of(m, v));
    for (const std::size_t row : held.box.back()) {
      const auto at = std::ranges::lower_bound(held.boxes, row);
      if (row == HeldRegions::none || (at != held.boxes.end() && *at == row)) continue;
      held.boxes.insert(at, row);
    }
  }
  return held;
}

Vec3 along_axis(const Component& component, const Vec3& vector, int axis) {
  const Vec3 e = component.orientation * Vec3::Unit(axis);
  return e * e.dot(vector);
}

/// Adds to each box the impulses on its nodes, axis by axis. The rest of `total` goes to the nodes
/// by mass, and the moment left after that in equal parts to the boxes.
void divide(ForceReport& forces, const HeldNodes& held, const MechanicsState& m,
            const Component& component, const Impulse& total,
            std::span<const NodeImpulse> impulses) {
  Impulse left = total;
  for (std::size_t k = 0; k < impulses.size(); ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t box = held.box[k][static_cast<std::size_t>(axis)];
      if (box == HeldRegions::none) continue;
      const Impulse given = impulse_at(m.vertices.position[impulses[k].node.index()],
                                       along_axis(component, impulses[k].impulse, axis));
      forces.held[box] += given;
      left -= given;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    double mass = 0;
    for (std::size_t k = 0; k < held.node.size(); ++k) {
      if (held.box[k][static_cast<std::size_t>(axis)] == HeldRegions::none) continue;
      mass += m.vertices.mass[held.node[k].index()];
    }
    if (mass == 0) continue;
    const Vec3 rest = along_axis(component, left.head<3>(), axis);
    for (std::size_t k = 0; k < held.node.size(); ++k) {
      const std::size_t box = held.box[k][static_cast<std::size_t>(axis)];
      if (box == HeldRegions::none) continue;
      const std::size_t v = held.node[k].index();
      const Impulse given = impulse_at(m.vertices.position[v], m.vertices.mass[v] / mass * rest);
      forces.held[box] += given;
      left.tail<3>() -= given.tail<3>();
    }
  }
  for (const std::size_t box : held.boxes) {
    forces.held[box].tail<3>() += left.tail<3>() / static_cast<double>(held.boxes.size());
  }
}

/// Row of a node among the held ones, or none.
std::optional<std::size_t> held_row(const HeldNodes& held, VertexId v) {
  const auto at = std::ranges::lower_bound(held.node, v);
  if (at == held.node.end() || *at != v) return std::nullopt;
  return static_cast<std::size_t>(at - held.node.begin());
}

/// The impulse on each held node that balances stress at the end of the part, weight, loads and
/// contact.
std::vector<NodeImpulse> node_impulses(const HeldNodes& held, const AdoptedPart& part,
                                       const Component& component) {
  const MechanicsState& m = part.state.mechanics;
  const ElementColumns& e = m.elements;
  const double h = part.input.settings.time_step;
  std::vector<NodeImpulse> impulses;
  for (const VertexId v : held.node) {
    Vec3 force = m.vertices.mass[v.index()] * part.input.loads.gravity;
    if (!part.input.loads.force.empty()) force += part.input.loads.force[v.index()];
    impulses.push_back({v, -h * force});
  }
  for (const TetId t : component.tetrahedra) {
    const ElementNodes nodes = nodes_of(e, part.input.corners, t);
    for (std::size_t k = 0; k < nodes.count; ++k) {
      if (m.vertices.support[nodes.row[k].index()].is_none()) continue;
      const auto row = held_row(held, nodes.row[k]);
      if (!row) continue;
      impulses[*row].impulse +=
          h * (component.orientation * node_force(e, e.stress, e.corner_stress, t, k));
    }
  }
  const auto take = [&](VertexId v, const Vec3& impulse) {
    if (const auto row = held_row(held, v)) impulses[*row].impulse -= impulse;
  };
  const auto take_all = [&](const TouchedNodes& nodes, const Vec3& impulse) {
    for (std::size_t k = 0; k < nodes.count; ++k) take(nodes.row[k], nodes.share[k] * impulse);
  };
  for (const ContactPoint& c : part.result.contacts) {
    if (c.is_body_a()) take_all(nodes_of_a(c, part.input.corners), c.impulse);
    if (c.is_body_b()) take_all(touched_nodes(c, m, part.input.corners), -c.impulse);
  }
  return impulses;
}

void add_supports(ForceReport& forces, HeldRegions& regions, const AdoptedPart& part,
                  std::span<const Impulse> supports) {
  const MechanicsState& m = part.state.mechanics;
  for (std::size_t c = 0; c < supports.size(); ++c) {
    const Component& component = m.components[c];
    if (supports[c].isZero(0)) continue;
    const HeldNodes held = held_nodes(regions, m, component);
    if (held.boxes.size() == 1) {
      forces.held[held.boxes[0]] += supports[c];
    } else {
      divide(forces, held, m, component, supports[c], node_impulses(held, part, component));
    }
  }
}

void add_contacts(ForceReport& forces, const ContactStepResult& result) {
  for (std::size_t k = 0; k < result.contacts.size(); ++k) {
    const ContactPoint& c = result.contacts[k];
    Impulse on_a;
    on_a << c.impulse, result.moments[k];
    if (c.ball != ContactPoint::none) forces.obstacle[c.ball] += on_a;
    if (c.obstacle != ContactPoint::none) forces.obstacle[c.obstacle] -= on_a;
  }
}

/// Works of single loads, as `add_work` of the energy ledger sums them.
void add_loads(ForceReport& forces, const AdoptedPart& part, double end) {
  const MechanicsState& m = part.state.mechanics;
  for (const CornerLoad& load : part.state.loads) {
    if (load.load == CornerLoad::no_load) continue;
    const ComponentId id = m.elements.component[tetrahedron_of(load.corner).index()];
    const bool is_carried = m.components[id.index()].rung == Rung::carried;
    if (!part.input.members.has(id) || is_carried) continue;
    const std::size_t v = node_of(load, m.elements, part.input.corners).index();
    forces.load_work[load.load] += force_at(load, end, part.before.orientation[id.index()])
                                       .dot(m.vertices.position[v] - part.before.position[v]);
  }
}

}  // namespace

ForceReport no_forces(const Scene& scene) {
  std::size_t held = 0, loads = 0;
  for (const BodySettings& body : scene.bodies) {
    held += body.held.size();
    loads += body.loads.size();
  }
  return {std::vector<Impulse>(scene.obstacles.size(), Impulse::Zero()),
          std::vector<Impulse>(held, Impulse::Zero()), std::vector<double>(loads, 0)};
}

HeldRegions::HeldRegions(const Scene& scene, std::span<const BodyRows> bodies)
    : scene_(scene), bodies_(bodies) {
  std::size_t row = 0;
  for (const BodySettings& body : scene.bodies) {
    first_.push_back(row);
    row += body.held.size();
  }
}

Holders HeldRegions::of(const MechanicsState& state, VertexId node) {
  const MotionId motion = state.vertices.support[node.index()];
  if (motion.is_none()) return {none, none, none};
  of_motion_.resize(state.motions.size());
  std::optional<Holders>& known = of_motion_[motion.index()];
  if (known) return *known;
  const ComponentId id = state.vertices.component[node.index()];
  const std::size_t t = state.components[id.index()].tetrahedra.front().index();
  const auto after = std::ranges::upper_bound(bodies_, t, {}, &BodyRows::first_tetrahedron);
  const auto body = static_cast<std::size_t>(after - bodies_.begin()) - 1;
  known = holders_of(scene_.bodies[body].held, state.vertices.rest_position[node.index()]);
  for (std::size_t& box : *known) {
    if (box != none) box += first_[body];
  }
  return *known;
}

void add_raised_forces(ForceReport& forces, HeldRegions& regions, const MechanicsState& state,
                       const RaisedComponent& raised) {
  const HeldNodes held = held_nodes(regions, state, raised.component);
  std::vector<NodeImpulse> impulses;
  for (const VertexId v : held.node) {
    const Vec3 change = state.vertices.velocity[v.index()] - raised.before[v.index()];
    impulses.push_back({v, state.vertices.mass[v.index()] * change});
  }
  divide(forces, held, state, raised.component, raised.given, impulses);
}

void add_part_forces(ForceReport& forces, HeldRegions& regions, const AdoptedPart& part,
                     std::span<const Impulse> supports, double end) {
  add_contacts(forces, part.result);
  add_loads(forces, part, end);
  add_supports(forces, regions, part, supports);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Impulses by their source.
#include "fracture/simulation/momentum_ledger.hpp"

#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

/// Adds what contact gave held components to what their momentum changed by, with the other sign.
void take_contacts(Vec3& supports, const AdoptedPart& part) {
  const MechanicsState& m = part.state.mechanics;
  const auto is_held = [&](ComponentId id) { return m.components[id.index()].supported; };
  for (const ContactPoint& c : part.result.contacts) {
    if (!c.vertex.is_none() && is_held(m.vertices.component[c.vertex.index()])) {
      supports -= c.impulse;
    }
    if (!c.tetrahedron.is_none() && is_held(m.elements.component[c.tetrahedron.index()])) {
      supports += c.impulse;
    }
  }
}

void take_loads(Vec3& supports, const AdoptedPart& part) {
  const MechanicsState& m = part.state.mechanics;
  const std::vector<Vec3>& force = part.input.loads.force;
  for (std::size_t v = 0; v < force.size(); ++v) {
    const ComponentId id = m.vertices.component[v];
    if (!part.input.members.has(id) || !m.components[id.index()].supported) continue;
    supports -= part.input.settings.time_step * force[v];
  }
}

}  // namespace

void add_part_momentum(MomentumLedger& ledger, const AdoptedPart& part) {
  const MechanicsState& m = part.state.mechanics;
  const Vec3 fall = part.input.settings.time_step * part.input.loads.gravity;
  bool any_held = false;
  for_each_living(m, part.input.members, [&](const Component& c) {
    if (c.rung == Rung::asleep) return;
    const Vec3 weight = c.rung == Rung::carried ? Vec3::Zero() : Vec3(c.mass * fall);
    ledger.gravity += weight;
    if (!c.supported) return;
    any_held = true;
    ledger.supports += c.momentum - part.before.momentum[c.id.index()] - weight;
  });
  if (any_held) {
    take_contacts(ledger.supports, part);
    take_loads(ledger.supports, part);
  }
  for (std::size_t k = 0; k < part.state.obstacles.size(); ++k) {
    const Obstacle& obstacle = part.state.obstacles[k];
    if (!obstacle.mass) {
      ledger.obstacles += part.result.report.impulse_of(k);
    } else if (part.input.members.has_ball(k)) {
      ledger.gravity += *obstacle.mass * fall;
    }
  }
}

}  // namespace sunder

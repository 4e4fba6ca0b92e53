// SPDX-License-Identifier: MIT
// Impulses by their source, and where they act.
#include "fracture/simulation/ledger/momentum_ledger.hpp"

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

/// The moment, from the start of a part (0) to its end (1), at which loads act on a moving body.
/// With contact they are an impulse at the start, else they act in the middle.
double moment_of_loads(const AdoptedPart& part, const std::vector<char>& touched, std::size_t row) {
  const bool floats = part.input.settings.integrator == Integrator::floating_frame;
  return is_struck(touched, row) || !floats ? 0 : 0.5;
}

/// m: where weight acts on a free component.
Vec3 place_of_weight(const AdoptedPart& part, const Component& c) {
  const std::size_t row = c.id.index();
  const Vec3& start = part.before.centre[row];
  if (part.result.trace) return part.result.trace->weight_place[row];
  return start + moment_of_loads(part, part.result.touched, row) * (c.centre - start);
}

/// m: where a surface load acts on a vertex.
Vec3 place_of_load(const AdoptedPart& part, const Component& c, VertexId v) {
  const std::size_t row = c.id.index();
  const Vec3& start = part.before.position[v.index()];
  const Vec3 arm = part.before.orientation[row].conjugate() * (start - part.before.centre[row]);
  const Vec3 end = c.centre + c.orientation * arm;
  return start + moment_of_loads(part, part.result.touched, row) * (end - start);
}

/// The impulse on side A of a contact.
Impulse impulse_of(const ContactStepResult& result, std::size_t contact) {
  Impulse given;
  given << result.contacts[contact].impulse, result.moments[contact];
  return given;
}

Impulse momentum_of(const Vec3& centre, const Vec3& momentum, const Vec3& angular_momentum) {
  Impulse sum = impulse_at(centre, momentum);
  sum.tail<3>() += angular_momentum;
  return sum;
}

/// Takes the impulses of contacts on held components off those of their supports.
void take_contacts(std::vector<Impulse>& supports, const AdoptedPart& part) {
  const MechanicsState& m = part.state.mechanics;
  const auto is_held = [&](ComponentId id) {
    return !id.is_none() && m.components[id.index()].supported;
  };
  for (std::size_t k = 0; k < part.result.contacts.size(); ++k) {
    const ContactPoint& c = part.result.contacts[k];
    const Impulse given = impulse_of(part.result, k);
    const ComponentId a = component_of_a(c, m), b = component_of_b(c, m);
    if (is_held(a)) supports[a.index()] -= given;
    if (is_held(b)) supports[b.index()] += given;
  }
}

/// Calls `visit(component, impulse)` for the surface loads on the members of the part, in pieces.
template <class Visit>
void for_each_load(const AdoptedPart& part, Visit visit) {
  const MechanicsState& m = part.state.mechanics;
  const std::vector<Vec3>& force = part.input.loads.force;
  if (part.result.trace) {
    for_each_living(m, part.input.members, [&](const Component& c) {
      const Impulse& given = part.result.trace->loads[c.id.index()];
      if (!given.isZero(0)) visit(c, given);
    });
    return;
  }
  for (std::size_t v = 0; v < force.size(); ++v) {
    const Component& c = m.components[m.vertices.component[v].index()];
    if (!part.input.members.has(c.id) || force[v].isZero(0)) continue;
    visit(c, impulse_at(place_of_load(part, c, VertexId{v}),
                        part.input.settings.time_step * force[v]));
  }
}

/// Impulse of weight on a component in the part; zero for a carried one.
Impulse weight_of(const AdoptedPart& part, const Component& c) {
  if (c.rung == Rung::carried) return Impulse::Zero();
  const Vec3 fall = part.input.settings.time_step * part.input.loads.gravity;
  return impulse_at(place_of_weight(part, c), c.mass * fall);
}

void add_obstacles(MomentumLedger& ledger, const AdoptedPart& part) {
  for (std::size_t k = 0; k < part.result.contacts.size(); ++k) {
    const ContactPoint& c = part.result.contacts[k];
    const auto is_driven = [&](std::uint32_t row) {
      return row != ContactPoint::none && !part.state.obstacles[row].mass;
    };
    if (is_driven(c.obstacle)) ledger.obstacles += impulse_of(part.result, k);
    if (is_driven(c.ball)) ledger.obstacles -= impulse_of(part.result, k);
  }
}

void add_weight_of_balls(MomentumLedger& ledger, const AdoptedPart& part) {
  const double h = part.input.settings.time_step;
  for (std::size_t k = 0; k < part.state.obstacles.size(); ++k) {
    const Obstacle& ball = part.state.obstacles[k];
    if (!ball.mass || !part.input.members.has_ball(k)) continue;
    if (part.result.trace) {
      ledger.gravity += impulse_at(part.result.trace->ball_weight_place[k],
                                   h * *ball.mass * part.input.loads.gravity);
      continue;
    }
    const Vec3 start = pose_of(part.before.obstacles[k].shape).centre;
    const Vec3 way =
        moment_of_loads(part, part.result.ball_touched, k) * (pose_of(ball.shape).centre - start);
    ledger.gravity += impulse_at(start + way, h * *ball.mass * part.input.loads.gravity);
  }
}

}  // namespace

Impulse momentum_of(const Component& component) {
  return momentum_of(component.centre, component.momentum, component.angular_momentum);
}

Impulse total_momentum(const SimulationState& state) {
  Impulse sum;
  sum << momentum(state.mechanics.vertices), angular_momentum(state.mechanics.vertices);
  for (const Obstacle& ball : state.obstacles) {
    if (!ball.mass) continue;
    sum += impulse_at(pose_of(ball.shape).centre, *ball.mass * ball.velocity);
    sum.tail<3>() += angular_momentum_of(ball);
  }
  return sum;
}

void support_impulses(std::vector<Impulse>& supports, const AdoptedPart& part) {
  const MechanicsState& m = part.state.mechanics;
  supports.clear();
  for_each_living(m, part.input.members, [&](const Component& c) {
    if (!c.supported || c.rung == Rung::asleep) return;
    supports.resize(m.components.size(), Impulse::Zero());
    const PartStart& start = part.before;
    const std::size_t row = c.id.index();
    supports[row] =
        momentum_of(c) -
        momentum_of(start.centre[row], start.momentum[row], start.angular_momentum[row]) -
        weight_of(part, c);
  });
  if (supports.empty()) return;
  for_each_load(part, [&](const Component& c, const Impulse& given) {
    if (c.supported) supports[c.id.index()] -= given;
  });
  take_contacts(supports, part);
}

void add_part_momentum(MomentumLedger& ledger, const AdoptedPart& part,
                       std::span<const Impulse> supports) {
  for_each_living(part.state.mechanics, part.input.members, [&](const Component& c) {
    if (c.rung != Rung::asleep) ledger.gravity += weight_of(part, c);
  });
  for (const Impulse& given : supports) ledger.supports += given;
  for_each_load(part, [&](const Component&, const Impulse& given) { ledger.loads += given; });
  add_obstacles(ledger, part);
  add_weight_of_balls(ledger, part);
}

}  // namespace sunder

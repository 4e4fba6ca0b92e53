// SPDX-License-Identifier: MIT
// Which contacts are blows: those ahead in a step, those felt in a sub-step of a wave.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/impact/impact_energy.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// Judges blows and notes them; each component once.
class BlowJudge {
 public:
  BlowJudge(ContactStep& step, std::span<const ContactPoint> contacts)
      : step_(step), contacts_(contacts) {}

  /// Whether `speed` is a blow for the component that could break it; then it is struck.
  bool strikes(const Component& component, double speed) {
    const MechanicsState& state = step_.pass.state;
    const ImpactSettings& impact = *step_.pass.input.part.impact;
    if (!is_blow(state, component, speed, strength_of(step_, component.id), impact)) return false;
    const auto [verdict, is_new] = verdicts_.try_emplace(component.id, Verdict::breaks);
    if (!is_new) return verdict->second == Verdict::breaks;
    verdict->second = verdict_on(component.id);
    Blows& blows = step_.blows;
    switch (verdict->second) {
      case Verdict::spared_by_pair:
        blows.spared_by_pair.push_back(component.id);
        return false;
      case Verdict::spared_by_island:
        blows.spared_by_island.push_back(component.id);
        return false;
      case Verdict::breaks:
        break;
    }
    blows.struck.push_back(component.id);
    blows.sub_step = std::min(blows.sub_step, component.cell_travel);
    return true;
  }

 private:
  Verdict verdict_on(ComponentId id) {
    const std::span<const double> threshold = step_.pass.input.part.threshold;
    if (threshold.empty()) return Verdict::breaks;
    if (!energy_) energy_.emplace(step_, contacts_);
    return energy_->judge(id, threshold[id.index()]);
  }

  ContactStep& step_;
  std::span<const ContactPoint> contacts_;
  std::optional<ImpactEnergy> energy_;
  std::map<ComponentId, Verdict> verdicts_;
};

/// The strongest contact of a component.
struct Touch {
  double impulse = 0;  ///< N s
  Vec3 normal = Vec3::Zero();
  Vec3 place = Vec3::Zero();    ///< m, where both are pushed
  Vec3 own = Vec3::Zero();      ///< m/s, velocity of the component there at the start
  Vec3 against = Vec3::Zero();  ///< m/s, of the other side
};

/// Velocity of an obstacle where a contact is. The spin of a ball brings nothing nearer.
Vec3 velocity_of(const ContactStep& step, std::uint32_t row, const ContactPoint& contact) {
  const Obstacle& obstacle = step.pass.obstacles[row];
  if (!obstacle.mass || is_sphere(obstacle)) return obstacle.velocity;
  return surface_velocity(obstacle, place_of_side_a(step.pass, contact));
}

Vec3 velocity_of_side_b(const ContactStep& step, const ContactPoint& contact) {
  if (contact.obstacle != ContactPoint::none) return velocity_of(step, contact.obstacle, contact);
  return touched_nodes(contact, step.pass.state, step.pass.input.corners)
      .sum(step.pass.state.vertices.velocity);
}

Vec3 velocity_of_side_a(const ContactStep& step, const ContactPoint& contact) {
  if (contact.ball != ContactPoint::none) return velocity_of(step, contact.ball, contact);
  return nodes_of_a(contact, step.pass.input.corners).sum(step.pass.state.vertices.velocity);
}

/// Row = ComponentId; cracks that close within it left out.
std::vector<Touch> strongest_touches(const ContactStep& step) {
  std::vector<Touch> touches(step.pass.state.components.size());
  const auto see = [&](ComponentId id, const ContactPoint& contact, const Vec3& own,
                       const Vec3& against) {
    Touch& touch = touches[id.index()];
    const double impulse = contact.impulse.norm();
    if (!(impulse > touch.impulse)) return;
    touch = {impulse, contact.normal, place_of_side_a(step.pass, contact), own, against};
  };
  for (const ContactPoint& contact : step.contacts) {
    const std::array<Component*, 2> sides = sides_of(step, contact);
    if (sides[0] == sides[1]) continue;
    const Vec3 of_a = velocity_of_side_a(step, contact), of_b = velocity_of_side_b(step, contact);
    if (sides[0]) see(sides[0]->id, contact, of_a, of_b);
    if (sides[1]) see(sides[1]->id, contact, of_b, of_a);
  }
  return touches;
}

/// m/s: the velocity of a component at a place as one rigid body; `own` of a supported one.
Vec3 rigid_velocity(const MechanicsState& state, const Component& component, const Touch& touch) {
  if (component.supported) return touch.own;
  const Vec3 spin = solve3(world_inertia(state, component), component.angular_momentum);
  return component.momentum / component.mass + spin.cross(touch.place - component.centre);
}

/// m/s: the speed at which two surfaces meet, of their points or of the whole component. A foot
/// that stands already is no measure of the body that comes after it.
double speed_of_surfaces(const MechanicsState& state, const Component& component,
                         const Touch& touch) {
  const Vec3 whole = rigid_velocity(state, component, touch);
  return std::max(std::abs(touch.normal.dot(touch.own - touch.against)),
                  std::abs(touch.normal.dot(whole - touch.against)));
}

/// m/s: of any vertex of the component towards the other side.
double fastest_vertex(const MechanicsState& state, const Component& component, const Touch& touch) {
  double fastest = 0;
  for (VertexId v : component.vertices) {
    const Vec3 relative = state.vertices.velocity[v.index()] - touch.against;
    fastest = std::max(fastest, std::abs(touch.normal.dot(relative)));
  }
  return fastest;
}

/// m/s: the speed of a blow that was felt. A spinning piece that is pressed at a corner keeps its
/// window by its fastest vertex, unless blows up to the strength count as nothing.
double blow_speed(const MechanicsState& state, const Component& component, const Touch& touch,
                  const ImpactSettings& settings) {
  return settings.negligible < 1 ? fastest_vertex(state, component, touch)
                                 : speed_of_surfaces(state, component, touch);
}

}  // namespace

void look_for_blows(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  const StepPaths paths = paths_of(step);
  Blows& blows = step.blows;
  const std::vector<ContactPoint> all = found.found;
  BlowJudge judge(step, all);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Meeting meeting = meeting_of(all[k], paths, step.settings.allowed_penetration);
    bool blow = false;
    if (std::isfinite(meeting.time)) {
      const std::array<Component*, 2> sides = sides_of(step, all[k]);
      // A crack that closes within one component brings it nothing that it did not have.
      for (const Component* side : sides) {
        if (side && sides[0] != sides[1]) blow = judge.strikes(*side, meeting.speed) || blow;
      }
    }
    if (blow) blows.time = std::min(blows.time, meeting.time);
    if (blow && step.deformation() == Deformation::frozen) continue;
    found.found[kept] = all[k];
    found.found_gap[kept++] = found.found_gap[k];
  }
  found.found.resize(kept);
  found.found_gap.resize(kept);
  sort_unique(blows.struck);
  sort_unique(blows.spared_by_pair);
  sort_unique(blows.spared_by_island);
}

void feel_blows(ContactStep& step) {
  const MechanicsState& state = step.pass.state;
  const std::vector<Touch> touches = strongest_touches(step);
  BlowJudge judge(step, step.contacts);
  for (const Component& component : state.components) {
    const Touch& touch = touches[component.id.index()];
    if (touch.impulse == 0) continue;
    judge.strikes(component, blow_speed(state, component, touch, *step.pass.input.part.impact));
  }
}

}  // namespace sunder

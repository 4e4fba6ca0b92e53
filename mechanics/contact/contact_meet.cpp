// SPDX-License-Identifier: MIT
// What meets in a step: contacts along the predicted paths, blows among them, whom they wake.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mechanics/contact/contact_step.hpp"

namespace sunder {
namespace {

/// How much lower than predicted a free body ends once its weight is taken as a blow at the start:
/// + h^2 g / 2 for what has not been touched yet, nothing for the rest.
Vec3 weight_shift(const ContactStep& step, ComponentId id) {
  const Component& component = step.pass.state.components[id.index()];
  const bool falls_later = component.isolated || !is_explicit(step.pass.input.settings.integrator);
  const bool shifts = falls_later && !component.supported && component.rung != Rung::asleep &&
                      !step.scratch.blows.component_touched[id.index()];
  return shifts ? Vec3{0.5 * step.h() * step.h() * step.pass.input.loads.gravity} : Vec3::Zero();
}

Vec3 weight_shift_of_ball(const ContactStep& step, std::uint32_t row) {
  const bool shifts = step.pass.obstacles[row].mass && !step.scratch.blows.ball_touched[row];
  return shifts ? Vec3{0.5 * step.h() * step.h() * step.pass.input.loads.gravity} : Vec3::Zero();
}

/// Rounding of a gap: nothing below it is an overlap.
double rounding_of(const ContactPath& path, const ContactPoint& contact) {
  return 128 * std::numeric_limits<double>::epsilon() * (path.size + std::abs(contact.offset));
}

/// Counts a contact against both components; false when one of them has enough.
bool take_place(ContactStep& step, const ContactPoint& contact) {
  const MechanicsState& state = step.pass.state;
  const std::uint32_t most = step.settings.max_contacts_per_component;
  std::uint32_t* a = nullptr;
  std::uint32_t* b = nullptr;
  if (contact.ball == ContactPoint::none) {
    a = &step.scratch.count[state.vertices.component[contact.vertex.index()].index()];
  }
  if (contact.obstacle == ContactPoint::none) {
    b = &step.scratch.count[state.elements.component[contact.tetrahedron.index()].index()];
  }
  if ((a && *a >= most) || (b && *b >= most)) return false;
  if (a) ++*a;
  if (b) ++*b;
  return true;
}

/// Spreads equal depths over a face instead of filling it from one side.
std::uint32_t scattered(VertexId v) { return v.value * 2654435761u; }

/// Whether two sides meet so fast that it is a blow for one of them.
bool is_blow_for_a_side(const ContactStep& step, const ContactPoint& contact, double speed,
                        Blows& blows) {
  const MechanicsState& state = step.pass.state;
  const ImpactSettings& impact = *step.pass.input.part.impact;
  bool any = false;
  const auto try_side = [&](ComponentId id) {
    const Component& component = state.components[id.index()];
    if (!is_blow(state, component, speed, strength_of(step, id), impact)) return;
    any = true;
    blows.struck.push_back(id);
    blows.sub_step = std::min(blows.sub_step, wave_sub_step(state, component, impact));
  };
  if (contact.ball == ContactPoint::none) {
    try_side(state.vertices.component[contact.vertex.index()]);
  }
  if (contact.obstacle == ContactPoint::none) {
    try_side(state.elements.component[contact.tetrahedron.index()]);
  }
  return any;
}

/// Blows among the contacts found: they are told, and in a frozen part forgotten.
void look_for_blows(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  const StepPaths paths = paths_of(step);
  Blows& blows = step.blows;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < found.found.size(); ++k) {
    const Meeting meeting = meeting_of(found.found[k], paths);
    const bool blow = std::isfinite(meeting.time) &&
                      is_blow_for_a_side(step, found.found[k], meeting.speed, blows);
    if (blow) blows.time = std::min(blows.time, meeting.time);
    if (blow && step.deformation() == Deformation::frozen) continue;
    found.found[kept] = found.found[k];
    found.found_gap[kept++] = found.found_gap[k];
  }
  found.found.resize(kept);
  found.found_gap.resize(kept);
  std::sort(blows.struck.begin(), blows.struck.end());
  blows.struck.erase(std::unique(blows.struck.begin(), blows.struck.end()), blows.struck.end());
}

/// Finds contacts along the paths as they are predicted. False when there are blows on them that
/// the step must not run into.
bool detect_contacts(ContactStep& step) {
  find_contacts(step.scratch.detect, step.memory, paths_of(step), step.settings);
  if (!step.pass.input.part.impact || step.is_wave()) return true;
  look_for_blows(step);
  return step.deformation() == Deformation::frozen || step.blows.struck.empty();
}

/// The components that a contact acts on; null where a side is none.
std::array<Component*, 2> sides_of(const ContactStep& step, const ContactPoint& contact) {
  MechanicsState& state = step.pass.state;
  std::array<Component*, 2> sides{};
  if (contact.ball == ContactPoint::none) {
    sides[0] = &state.components[state.vertices.component[contact.vertex.index()].index()];
  }
  if (contact.obstacle == ContactPoint::none) {
    sides[1] = &state.components[state.elements.component[contact.tetrahedron.index()].index()];
  }
  return sides;
}

bool on_lower_rung(const Component* side) { return side && side->rung != Rung::full; }

/// Whether neither side of a contact moves in this step.
bool lie_still(const ContactStep& step, const ContactPoint& contact,
               const std::array<Component*, 2>& sides) {
  if (contact.ball != ContactPoint::none) return false;
  for (const Component* side : sides) {
    if (side && side->rung != Rung::asleep) return false;
  }
  if (contact.obstacle == ContactPoint::none) return true;
  const Obstacle& obstacle = step.pass.obstacles[contact.obstacle];
  return !obstacle.mass && obstacle.velocity.isZero(0);
}

/// Depth of the deepest overlap that the contacts found will have, or `deepest`, m.
double deepest_violation(const ContactStep& step, double deepest) {
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.scratch.detect.found) {
    const ContactPath path = path_of(contact, paths);
    const double gap_error = predicted_gap_error(step, contact, path);
    if (gap_error < -rounding_of(path, contact)) deepest = std::max(deepest, -gap_error);
  }
  return deepest;
}

/// Takes components that a contact found may act on, one that `add_new_contacts` would take, to the
/// rung `full`; which, ascending.
std::vector<ComponentId> wake(ContactStep& step, double deepest) {
  std::vector<ComponentId> woken;
  deepest = deepest_violation(step, deepest);
  if (deepest == 0) return woken;
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.scratch.detect.found) {
    const std::array<Component*, 2> sides = sides_of(step, contact);
    if (!on_lower_rung(sides[0]) && !on_lower_rung(sides[1])) continue;
    if (lie_still(step, contact, sides)) continue;
    if (!(predicted_gap_error(step, contact, path_of(contact, paths)) <= deepest)) continue;
    for (Component* side : sides) {
      if (!on_lower_rung(side)) continue;
      side->rung = Rung::full;
      woken.push_back(side->id);
    }
  }
  std::sort(woken.begin(), woken.end());
  return woken;
}

/// Forgets contacts with what stays on a lower rung: nothing overlaps it.
void leave_alone(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < found.found.size(); ++k) {
    const std::array<Component*, 2> sides = sides_of(step, found.found[k]);
    if (on_lower_rung(sides[0]) || on_lower_rung(sides[1])) continue;
    found.found[kept] = found.found[k];
    found.found_gap[kept++] = found.found_gap[k];
  }
  found.found.resize(kept);
  found.found_gap.resize(kept);
}

}  // namespace

Vec3 relative_shift(const ContactStep& step, const ContactPoint& contact) {
  const MechanicsState& state = step.pass.state;
  Vec3 shift = contact.ball == ContactPoint::none
                   ? weight_shift(step, state.vertices.component[contact.vertex.index()])
                   : weight_shift_of_ball(step, contact.ball);
  if (contact.obstacle != ContactPoint::none) {
    shift -= weight_shift_of_ball(step, contact.obstacle);
  } else {
    shift -= weight_shift(step, state.elements.component[contact.tetrahedron.index()]);
  }
  return shift;
}

double predicted_gap_error(const ContactStep& step, const ContactPoint& contact,
                           const ContactPath& path) {
  if (step.is_wave()) return wave_gap_error(step, contact);
  return gap_end(contact, path) + contact.normal.dot(relative_shift(step, contact)) -
         target_gap(step, contact);
}

bool meet(ContactStep& step, double deepest) {
  bool clear = detect_contacts(step);
  const MechanicsState& state = step.pass.state;
  if (std::ranges::none_of(state.components,
                           [](const Component& c) { return on_lower_rung(&c); })) {
    return clear;
  }
  for (;;) {
    const std::vector<ComponentId> woken = wake(step, deepest);
    if (woken.empty()) break;
    predict(step.pass.mechanics, step.pass.state, step.pass.input, woken);
    clear = detect_contacts(step) && clear;
  }
  leave_alone(step);
  return clear;
}

void wake_touched(ContactStep& step) {
  // What wakes may lie against others that sleep.
  for (bool woken = true; woken;) {
    woken = false;
    for (const ContactPoint& contact : step.contacts) {
      const std::array<Component*, 2> sides = sides_of(step, contact);
      if (lie_still(step, contact, sides)) continue;
      for (Component* side : sides) {
        if (!on_lower_rung(side)) continue;
        side->rung = Rung::full;
        woken = true;
      }
    }
  }
  std::erase_if(step.contacts, [&](const ContactPoint& contact) {
    return lie_still(step, contact, sides_of(step, contact));
  });
}

double add_new_contacts(ContactStep& step, double deepest) {
  DetectScratch& found = step.scratch.detect;
  const StepPaths paths = paths_of(step);
  std::vector<ContactKey>& known = step.scratch.known;
  known.clear();
  for (const ContactPoint& c : step.contacts) known.push_back(key_of(c));
  std::sort(known.begin(), known.end());
  found.order.clear();
  for (std::uint32_t k = 0; k < found.found.size(); ++k) {
    const ContactPoint& contact = found.found[k];
    if (std::binary_search(known.begin(), known.end(), key_of(contact))) continue;
    const ContactPath path = path_of(contact, paths);
    double& gap_error = found.found_gap[k];
    gap_error = predicted_gap_error(step, contact, path);
    if (gap_error < -rounding_of(path, contact)) deepest = std::max(deepest, -gap_error);
    found.order.push_back(k);
  }
  if (deepest == 0) return 0;
  std::erase_if(found.order, [&](std::uint32_t k) { return !(found.found_gap[k] <= deepest); });
  std::sort(found.order.begin(), found.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(found.found_gap[a], scattered(found.found[a].vertex), a) <
           std::tuple(found.found_gap[b], scattered(found.found[b].vertex), b);
  });
  found.taken.clear();
  for (const std::uint32_t k : found.order) {
    if (take_place(step, found.found[k])) {
      found.taken.push_back(k);
    } else {
      ++step.report.left_out;
    }
  }
  std::sort(found.taken.begin(), found.taken.end());
  for (const std::uint32_t k : found.taken) step.contacts.push_back(found.found[k]);
  return deepest;
}

}  // namespace sunder

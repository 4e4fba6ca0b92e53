// SPDX-License-Identifier: MIT
// Contacts along the predicted paths of a step, blows among them, and the components that they
// wake.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// How much farther than predicted `place` (m) of a free body goes once gravity and other loads are
/// impulses at the start. This is h^2 / 2 times their acceleration for bodies that have not been
/// touched yet, and zero for the others.
Vec3 weight_shift(const ContactStep& step, ComponentId id, const Vec3& place) {
  const Component& component = step.pass.state.components[id.index()];
  const bool falls_later = component.rigid || !is_explicit(step.pass.input.settings.integrator);
  const bool shifts = falls_later && !component.supported && component.rung != Rung::asleep &&
                      component.rung != Rung::carried &&
                      !step.scratch.blows.component_touched[id.index()];
  if (!shifts) return Vec3::Zero();
  Vec3 acceleration = step.pass.input.loads.gravity;
  if (!step.scratch.load_acceleration.empty()) {
    const auto& [linear, angular] = step.scratch.load_acceleration[id.index()];
    acceleration += linear + angular.cross(place - component.centre);
  }
  return 0.5 * step.h() * step.h() * acceleration;
}

Vec3 weight_shift_of_ball(const ContactStep& step, std::uint32_t row) {
  const bool shifts = step.pass.obstacles[row].mass && !step.scratch.blows.ball_touched[row];
  return shifts ? Vec3{0.5 * step.h() * step.h() * step.pass.input.loads.gravity} : Vec3::Zero();
}

/// Rounding of a gap: nothing below it is an overlap.
double rounding_of(const ContactPath& path, const ContactPoint& contact) {
  return 128 * std::numeric_limits<double>::epsilon() * (path.size + std::abs(contact.offset));
}

/// The two bodies of a contact, the same for both orders; obstacles after components.
std::uint64_t pair_of(const ContactStep& step, const ContactPoint& contact) {
  const MechanicsState& state = step.pass.state;
  const auto components = static_cast<std::uint64_t>(state.components.size());
  const std::uint64_t a =
      contact.is_body_a() ? component_of_a(contact, state).value : components + contact.ball;
  const std::uint64_t b =
      contact.is_body_b() ? component_of_b(contact, state).value : components + contact.obstacle;
  return std::min(a, b) << 32 | std::max(a, b);
}

/// Spreads equal depths over a face instead of filling it from one side.
std::uint32_t scattered(const ContactPoint& c) {
  const std::uint32_t number = c.corner != ContactPoint::none ? c.corner
                               : c.vertex.is_none()           ? c.tetrahedron_a.value + c.place_a
                                                              : c.vertex.value;
  return number * 2654435761u;
}

/// Takes the contacts in `order`, deepest first, into `taken`. A pair of bodies with more than
/// `max_contacts_per_pair` keeps the deepest half of so many, and others spread over the rest: a
/// set that spans the same patch. The next pass finds an omitted contact again if it is still too
/// deep.
void take_spanning_sets(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  const std::size_t most = step.settings.max_contacts_per_pair;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> pairs;
  for (const std::uint32_t k : found.order) pairs[pair_of(step, found.found[k])].push_back(k);
  found.taken.clear();
  for (auto& [pair, contacts] : pairs) {
    if (contacts.size() > most) {
      const auto rest = contacts.begin() + static_cast<std::ptrdiff_t>(most / 2);
      std::sort(rest, contacts.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(scattered(found.found[a]), a) < std::tuple(scattered(found.found[b]), b);
      });
      contacts.resize(most);
    }
    found.taken.insert(found.taken.end(), contacts.begin(), contacts.end());
  }
}

/// Leaves contacts that begin apart to the next pass, where all bodies in them rest on something:
/// weight that their supports will bear lets them dip, for a step, into the next support.
void leave_to_next_pass(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  const MechanicsState& state = step.pass.state;
  const double rim = rim_of(step.settings);
  if (found.found.empty()) return;
  std::vector<char>& rests = step.scratch.rests;
  rests.assign(state.components.size() + step.pass.obstacles.size(), 0);
  const auto for_each_body = [&](const ContactPoint& c, auto visit) {
    for_each_component(c, state, [&](ComponentId id) { visit(id.index()); });
    for (const std::uint32_t row : {c.ball, c.obstacle}) {
      if (row != ContactPoint::none && step.pass.obstacles[row].mass) {
        visit(state.components.size() + row);
      }
    }
  };
  for (const ContactPoint& c : found.found) {
    if (c.gap_start <= rim) for_each_body(c, [&](std::size_t row) { rests[row] = 1; });
  }
  keep_found(found, [&](std::size_t k) {
    bool waits = found.found[k].gap_start > rim;
    for_each_body(found.found[k], [&](std::size_t row) { waits = waits && rests[row]; });
    step.has_left = step.has_left || waits;
    return !waits;
  });
}

/// The part of a unit impulse along `along` (world) that acts on nodes that it moves. Needs: a
/// component that supports hold.
double loose_share(const MechanicsState& state, const Component& component,
                   const TouchedNodes& nodes, const Vec3& along) {
  const Vec3 in_body = component.orientation.conjugate() * along;
  double share = 0;
  for (std::size_t i = 0; i < nodes.count; ++i) {
    share += std::abs(nodes.share[i]) * free_part(state, nodes.row[i], in_body).norm();
  }
  return share;
}

/// Whether supports hold both sides of a contact where they meet, so that no impulse parts them. A
/// node with a small share would have to go far, and would take an impulse without bound.
bool meets_at_supports(const ContactStep& step, const ContactPoint& contact) {
  constexpr double least_share = 1e-3;
  const MechanicsState& state = step.pass.state;
  const std::span<const Corners> corners = step.pass.input.corners;
  const auto body_holds = [&](ComponentId id, const auto& nodes_of_side) {
    const Component& component = state.components[id.index()];
    return component.supported &&
           loose_share(state, component, nodes_of_side(), contact.normal) <= least_share;
  };
  const auto obstacle_holds = [&](std::uint32_t row) { return !step.pass.obstacles[row].mass; };
  const bool a_holds =
      contact.is_body_a()
          ? body_holds(component_of_a(contact, state), [&] { return nodes_of_a(contact, corners); })
          : obstacle_holds(contact.ball);
  if (!a_holds) return false;
  return contact.is_body_b() ? body_holds(component_of_b(contact, state),
                                          [&] { return touched_nodes(contact, state, corners); })
                             : obstacle_holds(contact.obstacle);
}

/// Finds the contacts that the step looks for, but those that no impulse parts.
void find_in_step(ContactStep& step) {
  DetectScratch& scratch = step.scratch.detect;
  const StepPaths paths = paths_of(step);
  if (step.look == ContactStep::Look::overlaps) {
    scratch.found.clear();
    scratch.found_gap.clear();
    find_overlaps(scratch, paths, step.settings, static_cast<std::uint8_t>(step.report.passes));
  } else {
    find_contacts(scratch, step.memory, paths, step.settings);
    // A whole step looks for overlaps in its last passes; an explicit part looks once.
    if (step.is_wave() && may_overlap(paths, step.settings)) {
      find_overlaps(scratch, paths, step.settings, 0);
    }
  }
  keep_found(scratch, [&](std::size_t k) { return !meets_at_supports(step, scratch.found[k]); });
}

/// Finds contacts along the paths as they are predicted. False when there are blows on them that
/// the step must not run into.
bool detect_contacts(ContactStep& step) {
  find_in_step(step);
  if (step.look == ContactStep::Look::overlaps) return true;
  if (step.look == ContactStep::Look::resting) leave_to_next_pass(step);
  if (!step.pass.input.part.impact || step.is_wave()) return true;
  look_for_blows(step);
  return step.deformation() == Deformation::frozen || step.blows.struck.empty();
}

bool on_lower_rung(const Component* side) {
  return side && side->rung != Rung::full && side->rung != Rung::carried &&
         side->rung != Rung::stiff;
}

/// Whether neither side of a contact moves in this step.
bool lie_still(const ContactStep& step, const ContactPoint& contact,
               const std::array<Component*, 2>& sides) {
  for (const Component* side : sides) {
    if (side && side->rung != Rung::asleep) return false;
  }
  const auto stands = [&](std::uint32_t row) {
    if (row == ContactPoint::none) return true;
    const Obstacle& obstacle = step.pass.obstacles[row];
    return !obstacle.mass && obstacle.velocity.isZero(0);
  };
  return stands(contact.ball) && stands(contact.obstacle);
}

/// The same less the push-out of the contact; negative: there is something to solve.
double wanted_gap_error(const ContactStep& step, const ContactPoint& contact,
                        const ContactPath& path) {
  return predicted_gap_error(step, contact, path) - push_out(step, contact);
}

/// Depth of the deepest overlap that the contacts found will have, or `deepest`, m.
double deepest_violation(const ContactStep& step, double deepest) {
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.scratch.detect.found) {
    const ContactPath path = path_of(contact, paths);
    const double gap_error = wanted_gap_error(step, contact, path);
    if (gap_error < -rounding_of(path, contact)) deepest = std::max(deepest, -gap_error);
  }
  return deepest;
}

/// Takes components that a contact found may act on, one that `find_new_contacts` would find, to
/// the rung `full`; which, ascending.
std::vector<ComponentId> wake(ContactStep& step, double deepest) {
  std::vector<ComponentId> woken;
  deepest = deepest_violation(step, deepest);
  if (deepest == 0) return woken;
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.scratch.detect.found) {
    const std::array<Component*, 2> sides = sides_of(step, contact);
    if (!on_lower_rung(sides[0]) && !on_lower_rung(sides[1])) continue;
    if (lie_still(step, contact, sides)) continue;
    if (!(wanted_gap_error(step, contact, path_of(contact, paths)) <= deepest)) continue;
    for (Component* side : sides) {
      if (!on_lower_rung(side)) continue;
      side->rung = Rung::full;
      woken.push_back(side->id);
    }
  }
  std::sort(woken.begin(), woken.end());
  return woken;
}

/// Forgets contacts with components that stay on a lower rung: nothing overlaps these.
void leave_alone(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  keep_found(found, [&](std::size_t k) {
    const std::array<Component*, 2> sides = sides_of(step, found.found[k]);
    return !on_lower_rung(sides[0]) && !on_lower_rung(sides[1]);
  });
}

}  // namespace

std::array<Component*, 2> sides_of(const ContactStep& step, const ContactPoint& contact) {
  MechanicsState& state = step.pass.state;
  std::array<Component*, 2> sides{};
  if (contact.is_body_a()) sides[0] = &state.components[component_of_a(contact, state).index()];
  if (contact.is_body_b()) sides[1] = &state.components[component_of_b(contact, state).index()];
  return sides;
}

Vec3 relative_shift(const ContactStep& step, const ContactPoint& contact) {
  if (step.is_wave()) return Vec3::Zero();
  const MechanicsState& state = step.pass.state;
  const std::span<const Corners> corners = step.pass.input.corners;
  const auto of_body = [&](ComponentId id, const TouchedNodes& nodes) {
    return weight_shift(step, id, nodes.sum(state.vertices.position));
  };
  const Vec3 of_a = contact.is_body_a()
                        ? of_body(component_of_a(contact, state), nodes_of_a(contact, corners))
                        : weight_shift_of_ball(step, contact.ball);
  const Vec3 of_b = contact.is_body_b() ? of_body(component_of_b(contact, state),
                                                  touched_nodes(contact, state, corners))
                                        : weight_shift_of_ball(step, contact.obstacle);
  return of_a - of_b;
}

double predicted_gap_error(const ContactStep& step, const ContactPoint& contact,
                           const ContactPath& path) {
  return gap_end(contact, path) + contact.normal.dot(relative_shift(step, contact)) -
         target_gap(contact);
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
    // The prediction of explicit steps is the present motion, on any rung.
    if (step.is_wave()) continue;
    predict(step.pass.mechanics, step.pass.state, step.pass.input, woken);
    clear = detect_contacts(step) && clear;
  }
  leave_alone(step);
  return clear;
}

void wake_touched(ContactStep& step) {
  // A woken component may touch others that sleep.
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

double find_new_contacts(ContactStep& step, double deepest) {
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
    gap_error = wanted_gap_error(step, contact, path);
    if (gap_error < -rounding_of(path, contact)) deepest = std::max(deepest, -gap_error);
    found.order.push_back(k);
  }
  if (deepest == 0) return 0;
  // Crack faces are many: of these, only contacts that would overlap.
  std::erase_if(found.order, [&](std::uint32_t k) {
    return !(found.found_gap[k] <= (found.found[k].face.is_none() ? deepest : 0));
  });
  std::sort(found.order.begin(), found.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(found.found_gap[a], scattered(found.found[a]), a) <
           std::tuple(found.found_gap[b], scattered(found.found[b]), b);
  });
  return deepest;
}

void take_new_contacts(ContactStep& step) {
  DetectScratch& found = step.scratch.detect;
  take_spanning_sets(step);
  std::sort(found.taken.begin(), found.taken.end());
  for (const std::uint32_t k : found.taken) step.contacts.push_back(found.found[k]);
}

double leave_new_contacts(ContactStep& step) {
  const DetectScratch& found = step.scratch.detect;
  const StepPaths paths = paths_of(step);
  double worst = 0;
  step.scratch.left_out.clear();
  for (const std::uint32_t k : found.order) {
    const ContactPoint& contact = found.found[k];
    const double error = predicted_gap_error(step, contact, path_of(contact, paths));
    worst = std::max(worst, -error);
    if (error < -step.settings.allowed_penetration) step.scratch.left_out.push_back(contact);
  }
  return worst;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The step with contact: predict, find, solve, predict again, adopt.
#include "mechanics/contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mechanics/contact_bounce.hpp"
#include "mechanics/contact_step.hpp"
#include "mechanics/living.hpp"
#include "topology/assert.hpp"

namespace sunder {

ContactScratch::ContactScratch() : room(std::make_unique<Room>()) {}
ContactScratch::~ContactScratch() = default;
ContactScratch::ContactScratch(ContactScratch&&) noexcept = default;
ContactScratch& ContactScratch::operator=(ContactScratch&&) noexcept = default;

StepPaths paths_of(const ContactStep& step) {
  return {step.pass.state,        step.pass.input.corners, step.pass.mechanics.predicted.position,
          step.pass.obstacles,    step.room.ball_end,      step.h(),
          step.pass.input.members};
}

double target_gap(const ContactStep& step, const ContactPoint& contact) {
  const double allowed = -step.settings.allowed_penetration;
  if (contact.gap_start >= allowed) return std::min(0.0, contact.gap_start);
  return std::min(allowed, contact.gap_start + step.settings.push_out_speed * step.h());
}

namespace {

void predict_balls(ContactStep& step) {
  const std::vector<Obstacle>& obstacles = step.pass.obstacles;
  step.room.ball_end.resize(obstacles.size(), Vec3::Zero());
  if (step.is_wave()) return predict_wave_balls(step);
  const double h = step.h();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (!obstacles[k].mass) continue;
    Vec3 motion = h * obstacles[k].velocity;
    if (!step.room.blows.ball_touched[k]) motion += 0.5 * h * h * step.pass.input.loads.gravity;
    step.room.ball_end[k] = std::get<Sphere>(obstacles[k].shape).center + motion;
  }
}

/// How much lower than predicted a free body ends once its weight is taken as a blow at the start:
/// + h^2 g / 2 for what has not been touched yet, nothing for the rest.
Vec3 weight_shift(const ContactStep& step, ComponentId id) {
  const Component& component = step.pass.state.components[id.index()];
  const bool falls_later = component.isolated || !is_explicit(step.pass.input.settings.integrator);
  const bool shifts = falls_later && !component.supported && component.rung != Rung::asleep &&
                      !step.room.blows.component_touched[id.index()];
  return shifts ? Vec3{0.5 * step.h() * step.h() * step.pass.input.loads.gravity} : Vec3::Zero();
}

Vec3 weight_shift_of_ball(const ContactStep& step, std::uint32_t row) {
  const bool shifts = step.pass.obstacles[row].mass && !step.room.blows.ball_touched[row];
  return shifts ? Vec3{0.5 * step.h() * step.h() * step.pass.input.loads.gravity} : Vec3::Zero();
}

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

/// Rounding of a gap: nothing below it is an overlap.
double rounding_of(const ContactPath& path, const ContactPoint& contact) {
  return 128 * std::numeric_limits<double>::epsilon() *
         (path.start.norm() + path.end.norm() + std::abs(contact.offset));
}

/// What the end of the step lacks: gap less target, as predicted.
double predicted_lack(const ContactStep& step, const ContactPoint& contact,
                      const ContactPath& path) {
  if (step.is_wave()) return wave_lack(step, contact);
  return gap_end(contact, path) + contact.normal.dot(relative_shift(step, contact)) -
         target_gap(step, contact);
}

/// Counts a contact against both components; false when one of them has enough.
bool take_place(ContactStep& step, const ContactPoint& contact) {
  const MechanicsState& state = step.pass.state;
  const std::uint32_t most = step.settings.max_contacts_per_component;
  std::uint32_t* a = nullptr;
  std::uint32_t* b = nullptr;
  if (contact.ball == ContactPoint::none) {
    a = &step.room.count[state.vertices.component[contact.vertex.index()].index()];
  }
  if (contact.obstacle == ContactPoint::none) {
    b = &step.room.count[state.elements.component[contact.tetrahedron.index()].index()];
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
    if (!is_blow(state, component, speed, impact)) return;
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
  DetectScratch& found = step.room.detect;
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
  find_contacts(step.room.detect, step.memory, paths_of(step), step.settings);
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
double deepest_lack(const ContactStep& step, double deepest) {
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.room.detect.found) {
    const ContactPath path = path_of(contact, paths);
    const double lack = predicted_lack(step, contact, path);
    if (lack < -rounding_of(path, contact)) deepest = std::max(deepest, -lack);
  }
  return deepest;
}

/// Takes components that a contact found may act on, one that `add_new_contacts` would take, to the
/// rung `full`; which, ascending.
std::vector<ComponentId> rouse(ContactStep& step, double deepest) {
  std::vector<ComponentId> roused;
  deepest = deepest_lack(step, deepest);
  if (deepest == 0) return roused;
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.room.detect.found) {
    const std::array<Component*, 2> sides = sides_of(step, contact);
    if (!on_lower_rung(sides[0]) && !on_lower_rung(sides[1])) continue;
    if (lie_still(step, contact, sides)) continue;
    if (!(predicted_lack(step, contact, path_of(contact, paths)) <= deepest)) continue;
    for (Component* side : sides) {
      if (!on_lower_rung(side)) continue;
      side->rung = Rung::full;
      roused.push_back(side->id);
    }
  }
  std::sort(roused.begin(), roused.end());
  return roused;
}

/// Forgets contacts with what stays on a lower rung: nothing overlaps it.
void leave_alone(ContactStep& step) {
  DetectScratch& found = step.room.detect;
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

/// Contacts along the paths, with everything roused that they act on. False when there are blows
/// on them that the step must not run into.
bool meet(ContactStep& step, double deepest) {
  bool clear = detect_contacts(step);
  const MechanicsState& state = step.pass.state;
  if (std::ranges::none_of(state.components,
                           [](const Component& c) { return on_lower_rung(&c); })) {
    return clear;
  }
  for (;;) {
    const std::vector<ComponentId> roused = rouse(step, deepest);
    if (roused.empty()) break;
    predict(step.pass.mechanics, step.pass.state, step.pass.input, roused);
    clear = detect_contacts(step) && clear;
  }
  leave_alone(step);
  return clear;
}

/// Of the contacts found, adds what has come near since the last pass: overlaps, deepest first, and
/// what is nearer than the deepest overlap is deep. Gives that depth, m; 0 when nothing overlaps.
double add_new_contacts(ContactStep& step, double deepest) {
  DetectScratch& found = step.room.detect;
  const StepPaths paths = paths_of(step);
  std::vector<ContactKey>& known = step.room.known;
  known.clear();
  for (const ContactPoint& c : step.contacts) known.push_back(key_of(c));
  std::sort(known.begin(), known.end());
  found.order.clear();
  for (std::uint32_t k = 0; k < found.found.size(); ++k) {
    const ContactPoint& contact = found.found[k];
    if (std::binary_search(known.begin(), known.end(), key_of(contact))) continue;
    const ContactPath path = path_of(contact, paths);
    double& lack = found.found_gap[k];
    lack = predicted_lack(step, contact, path);
    if (lack < -rounding_of(path, contact)) deepest = std::max(deepest, -lack);
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

/// Gaps and slips of the rows at the predicted end of the step. Gives the largest error among the
/// contacts: an overlap, or an impulse where there is a gap.
double measure_rows(ContactStep& step) {
  if (step.is_wave()) return measure_wave_rows(step);
  const StepPaths paths = paths_of(step);
  double worst = 0;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    const ContactPoint& contact = step.contacts[k];
    ContactRow& row = step.room.bodies.rows[k];
    const ContactPath path = path_of(contact, paths);
    row.gap = predicted_lack(step, contact, path);
    row.compliance = step.settings.compliance / step.h();
    row.friction = contact.friction;
    row.impulse = contact.impulse;
    row.slip = path.end - path.start + relative_shift(step, contact);
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      const std::uint32_t ball = step.room.bodies.ball[row.ends[e].body];
      if (ball == ContactBodies::none) continue;
      row.slip +=
          step.h() * row.ends[e].weight * step.pass.obstacles[ball].spin.cross(row.ends[e].arm);
    }
    const double pressed = row.normal.dot(row.impulse);
    const double lack = row.gap + row.compliance * pressed;
    worst = std::max(worst, pressed > 0 ? std::abs(lack) : -lack);
  }
  return worst;
}

/// Solves, hands the changes on, and predicts what was touched.
void solve_pass(ContactStep& step) {
  ContactBodies& bodies = step.room.bodies;
  // With a unit step, displacements are velocities.
  const double over = step.is_wave() ? step.h() : 1;
  const SolveOutcome outcome = solve_contacts(
      bodies.rows, bodies.bodies,
      {step.is_wave() ? 1 : step.h(), step.report.tolerated / over, step.settings.max_iterations});
  step.report.iterations += outcome.iterations;
  step.report.converged = step.report.converged && outcome.converged;
  step.room.change.resize(step.contacts.size());
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    step.room.change[k] = bodies.rows[k].impulse - step.contacts[k].impulse;
    step.contacts[k].impulse = bodies.rows[k].impulse;
  }
  if (step.is_wave()) {
    apply_wave_changes(step);
  } else {
    apply_changes(step.room.blows, bodies, step.room.change, step.pass);
    predict_touched(step.room.blows, step.pass);
  }
  predict_balls(step);
  ++step.report.passes;
}

bool by_key(const ContactMemory::Remembered& a, const ContactMemory::Remembered& b) {
  return key_of(a.contact) < key_of(b.contact);
}

/// Lets the first pass begin with the forces that the same contacts needed in the last step.
void guess_from_last_step(ContactStep& step) {
  const auto& last = step.memory.last_contacts;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    const ContactMemory::Remembered contact{step.contacts[k], step.h()};
    const auto found = std::lower_bound(last.begin(), last.end(), contact, by_key);
    if (found == last.end() || key_of(found->contact) != key_of(contact.contact)) continue;
    // Turned with the normal, so that it stays inside the bounds and the circle.
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(found->contact.normal, contact.contact.normal);
    step.room.bodies.rows[k].guess = step.h() / found->step * (turn * found->contact.impulse);
  }
}

/// Whether all sides of a contact belong to what the step moves.
bool among_members(const ContactStep& step, const ContactPoint& contact) {
  const StepMembers& members = step.pass.input.members;
  const MechanicsState& state = step.pass.state;
  if (contact.ball != ContactPoint::none) return members.has_ball(contact.ball);
  return contact.vertex.index() < state.vertices.size() &&
         members.has(state.vertices.component[contact.vertex.index()]);
}

/// Contacts of this step in place of those of the members' last one.
void remember_contacts(ContactStep& step) {
  auto& last = step.memory.last_contacts;
  std::erase_if(last, [&](const auto& old) { return among_members(step, old.contact); });
  for (const ContactPoint& contact : step.contacts) last.push_back({contact, step.h()});
  std::sort(last.begin(), last.end(), by_key);
}

/// Passes until the predicted gaps are as solved for. What remains is the residual. False when
/// nothing was done for the sake of a blow.
bool resolve(ContactStep& step) {
  double deepest = 0;
  for (int k = 0; k <= step.settings.max_passes; ++k) {
    const std::size_t before = step.contacts.size();
    if (!meet(step, deepest) && k == 0) return false;
    deepest = add_new_contacts(step, deepest);
    if (deepest == 0) return true;
    step.report.tolerated = step.settings.tolerance * deepest;
    if (k == 0 || step.contacts.size() != before) {
      gather_bodies(step.room.bodies, step.contacts, step.pass);
    } else {
      for (ContactRow& row : step.room.bodies.rows) row.guess.setZero();
    }
    step.report.residual = measure_rows(step);
    // A thousandth of the overlap, and far below the depth that is never pushed out.
    const double good_enough =
        std::max({1e-3 * deepest, 1e-2 * step.settings.allowed_penetration, step.report.tolerated});
    const bool settled =
        k > 0 && step.contacts.size() == before && step.report.residual <= good_enough;
    if (settled || k == step.settings.max_passes) break;
    // In a wave sweeps begin at nothing and only take energy; the impulse of the last blow would
    // strike again where they are cut short (interlocked pieces gained 60 kJ by it).
    if (k == 0 && !step.is_wave()) guess_from_last_step(step);
    solve_pass(step);
  }
  return true;
}

void move_obstacles(ContactStep& step) {
  const Vec3 fall = step.h() * step.pass.input.loads.gravity;
  for (std::size_t k = 0; k < step.pass.obstacles.size(); ++k) {
    Obstacle& obstacle = step.pass.obstacles[k];
    if (!obstacle.mass) {
      translate(obstacle.shape, step.h() * obstacle.velocity);
    } else if (step.pass.input.members.has_ball(k) && !step.is_wave()) {
      std::get<Sphere>(obstacle.shape).center = step.room.ball_end[k];
      if (!step.room.blows.ball_touched[k]) obstacle.velocity += fall;
    }
  }
  if (step.is_wave()) move_wave_balls(step);
}

void count_contacts(ContactStep& step) {
  ContactReport& report = step.report;
  report.candidates = static_cast<std::uint32_t>(step.contacts.size());
  if (step.contacts.empty()) return;
  report.obstacle_impulse.assign(step.pass.obstacles.size(), Vec3::Zero());
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.contacts) {
    report.deepest = std::max(report.deepest, -gap_end(contact, path_of(contact, paths)));
  }
}

void sum_impulses(ContactStep& step) {
  for (const ContactPoint& contact : step.contacts) {
    ++step.report.contacts;
    if (contact.obstacle != ContactPoint::none) {
      step.report.obstacle_impulse[contact.obstacle] += contact.impulse;
    }
    if (contact.ball != ContactPoint::none) {
      step.report.obstacle_impulse[contact.ball] -= contact.impulse;
    }
  }
}

/// Makes room for a step.
void begin_step(ContactStep& step) {
  ContactScratch::Room& room = step.room;
  const MechanicsState& state = step.pass.state;
  const std::size_t balls = step.pass.obstacles.size();
  room.blows.component_touched.assign(state.components.size(), 0);
  room.blows.ball_touched.assign(balls, 0);
  room.blows.vertex_impulse.assign(state.vertices.size(), Vec3::Zero());
  room.blows.ball_impulse.assign(balls, Vec3::Zero());
  room.blows.ball_twist.assign(balls, Vec3::Zero());
  room.count.assign(state.components.size(), 0);
  const StepInput& input = step.pass.input;
  prepare(step.pass.mechanics, state, input);
  for_each_living(state, input.members, [&](const Component& component) {
    predict(step.pass.mechanics, state, input, {&component.id, 1});
  });
  if (input.members.component.empty()) return;
  // What keeps still is where it is; the room for it is there also where no member lives.
  predict(step.pass.mechanics, state, input, {});
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (input.members.has(state.vertices.component[v])) continue;
    step.pass.mechanics.predicted.position[v] = state.vertices.position[v];
  }
}

/// After the bodies were adopted: balls, bounces, memory.
void end_step(ContactStep& step, bool fine) {
  move_obstacles(step);
  std::erase_if(step.contacts, [](const ContactPoint& c) { return c.impulse.isZero(0); });
  const bool bounces =
      step.deformation() == Deformation::whole || step.deformation() == Deformation::catch_up;
  if (fine && bounces) {
    take_back_bounce(step.contacts, step.room.bodies, step.pass, step.settings);
  }
  sum_impulses(step);
  remember_contacts(step);
}

}  // namespace

ContactStepResult advance_with_contact(const ContactWorld& world, const StepInput& input,
                                       const ContactSettings& settings,
                                       const ContactStepScratch& scratch) {
  scratch.contact.contacts.clear();
  ContactStep step{{input, world.state, world.obstacles, scratch.mechanics},
                   world.memory,
                   settings,
                   scratch.contact.contacts,
                   *scratch.contact.room,
                   {},
                   {}};
  begin_step(step);
  predict_balls(step);
  update_allowances(world.memory, step.room.detect, paths_of(step), step.settings);
  ContactStepResult result;
  result.adopted = resolve(step);
  if (result.adopted) {
    count_contacts(step);
    if (step.is_wave() && input.part.impact) feel_blows(step);
    result.status = adopt(world.state, scratch.mechanics, input);
    end_step(step, result.status.outcome == StepOutcome::fine);
  }
  result.blows = std::move(step.blows);
  result.report = std::move(step.report);
  return result;
}

}  // namespace sunder

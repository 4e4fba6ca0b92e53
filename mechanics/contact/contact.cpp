// SPDX-License-Identifier: MIT
// The step with contact: predict, find, solve, predict again, adopt.
#include "mechanics/contact/contact.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/response/contact_bounce.hpp"
#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {

ContactScratch::ContactScratch() : buffers(std::make_unique<Buffers>()) {}
ContactScratch::~ContactScratch() = default;
ContactScratch::ContactScratch(ContactScratch&&) noexcept = default;
ContactScratch& ContactScratch::operator=(ContactScratch&&) noexcept = default;

StepPaths paths_of(const ContactStep& step) {
  const MechanicsScratch::Predicted& predicted = step.pass.mechanics.predicted;
  return {step.pass.state, step.pass.input.corners, predicted.position,
          predicted.frame, step.pass.obstacles,     step.scratch.ball_end,
          step.h(),        step.pass.input.members, step.pass.input.neighbours};
}

double target_gap(const ContactPoint& contact) { return std::min(0.0, contact.gap_start); }

double push_out(const ContactStep& step, const ContactPoint& contact) {
  const double too_deep = -step.settings.allowed_penetration - contact.gap_start;
  return std::clamp(too_deep, 0.0, step.settings.push_out_speed * step.h());
}

double row_error(const ContactRow& row) {
  const double pressed = row.normal.dot(row.impulse);
  const double gap = row.gap + row.compliance * pressed;
  return pressed > 0 ? std::max(-gap, gap - row.push) : -gap;
}

namespace {

void predict_balls(ContactStep& step) {
  const std::vector<Obstacle>& obstacles = step.pass.obstacles;
  step.scratch.ball_end.resize(obstacles.size());
  if (step.is_wave()) return predict_wave_balls(step);
  const double h = step.h();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (!obstacles[k].mass) continue;
    Vec3 motion = h * obstacles[k].velocity;
    if (!step.scratch.blows.ball_touched[k]) motion += 0.5 * h * h * step.pass.input.loads.gravity;
    const Obstacle& free = obstacles[k];
    step.scratch.ball_end[k] = {pose_of(free.shape).centre + motion,
                                turned_obstacle(free, angular_momentum_of(free), h)};
  }
}

/// Gaps and slips of the rows at the predicted end of the step. Gives the largest error among the
/// contacts: an overlap, or an impulse where there is a gap.
double measure_rows(ContactStep& step) {
  if (step.is_wave()) return measure_wave_rows(step);
  const StepPaths paths = paths_of(step);
  double worst = 0;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    const ContactPoint& contact = step.contacts[k];
    ContactRow& row = step.scratch.bodies.rows[k];
    if (k < step.tied_rows) {
      worst = std::max(worst, measure_tie(row, step.ties[k], contact.impulse, paths, {}));
      continue;
    }
    const ContactPath path = path_of(contact, paths);
    row.gap = predicted_gap_error(step, contact, path);
    row.push = push_out(step, contact);
    row.compliance = step.settings.compliance / step.h();
    row.friction = contact.friction;
    row.impulse = contact.impulse;
    row.slip = path.end - path.start + relative_shift(step, contact);
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      const std::uint32_t ball = step.scratch.bodies.ball[row.ends[e].body];
      // Ways of what is no sphere have their turns in them.
      if (ball == ContactBodies::none || !is_sphere(step.pass.obstacles[ball])) continue;
      row.slip +=
          step.h() * row.ends[e].weight * step.pass.obstacles[ball].spin.cross(row.ends[e].arm);
    }
    worst = std::max(worst, row_error(row));
  }
  return worst;
}

/// Solves, hands the changes on, and predicts what was touched.
void solve_pass(ContactStep& step) {
  ContactBodies& bodies = step.scratch.bodies;
  // With a unit step, displacements are velocities.
  const double over = step.is_wave() ? step.h() : 1;
  const SolveOutcome outcome =
      solve_contacts(bodies.rows, bodies.bodies,
                     {step.is_wave() ? 1 : step.h(), step.report.tolerated / over,
                      step.settings.max_iterations, step.pass.input.hurry});
  step.report.iterations += outcome.iterations;
  step.report.converged = step.report.converged && outcome.converged;
  step.scratch.change.resize(step.contacts.size());
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    step.scratch.change[k] = bodies.rows[k].impulse - step.contacts[k].impulse;
    step.contacts[k].impulse = bodies.rows[k].impulse;
  }
  if (step.is_wave()) {
    apply_wave_changes(step);
  } else {
    apply_changes(step.scratch.blows, bodies, step.scratch.change, step.pass);
    predict_touched(step.scratch.blows, step.pass);
  }
  predict_balls(step);
  ++step.report.passes;
}

/// Further passes are for methods whose bodies answer as the response says: others turn what it is
/// off by into impulses, the more the more passes there are.
int most_passes(const ContactStep& step) {
  constexpr int for_others = 3;
  const IntegratorSettings& method = step.pass.input.settings;
  const bool answers =
      is_floating(method.integrator) && method.isolated == IsolatedTetrahedra::rigid;
  return answers ? step.settings.max_passes : std::min(step.settings.max_passes, for_others);
}

/// Passes until the predicted gaps are as solved for. What remains is the residual. False when
/// nothing was done for the sake of a blow.
bool resolve(ContactStep& step) {
  double deepest = 0;
  int most = most_passes(step);
  // Bounds of ties follow the openings that a pass predicts.
  constexpr int passes_of_ties = 8;
  if (step.tied_rows > 0) most = std::max(most, passes_of_ties);
  for (int k = 0; k <= most; ++k) {
    const std::size_t before = step.contacts.size();
    hold_ties(step, k == 0);
    if (!meet(step, deepest) && k == 0) return false;
    deepest = find_new_contacts(step, deepest);
    if (deepest == 0 && step.tied_rows == 0) return true;
    // By default a ten thousandth of the depth that is never pushed out is as good as nothing, in
    // the many short sub-steps of a wave a thousandth: pieces that lie in a heap are not solved for
    // further. A finer tolerance, say 1e-8, gets its gaps.
    const double asked = step.settings.tolerance / 1e-5;
    const double nothing = (step.is_wave() ? 1e-3 : 1e-4) * step.settings.allowed_penetration;
    step.report.tolerated = std::max(step.settings.tolerance * deepest, asked * asked * nothing);
    for (std::size_t tie = 0; tie < step.tied_rows; ++tie) {
      const double fine = tie_tolerance * opening_end_of(step.ties[tie]);
      step.report.tolerated = std::min(step.report.tolerated, fine);
    }
    const bool is_last = k == most || (k > 0 && step.pass.input.is_hurried());
    if (is_last) {
      step.report.residual = std::max(measure_rows(step), leave_new_contacts(step));
      break;
    }
    take_new_contacts(step);
    if (k == 0 || step.contacts.size() != before) {
      gather_bodies(step.scratch.bodies, step.contacts, step.pass);
    } else {
      for (ContactRow& row : step.scratch.bodies.rows) row.guess.setZero();
    }
    step.report.residual = measure_rows(step);
    const bool settled =
        k > 0 && step.contacts.size() == before && step.report.residual <= step.report.tolerated;
    if (settled) break;
    if (k == 0) guess_from_last_step(step);
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
      const Vec3 momentum = angular_momentum_of(obstacle);
      put(obstacle.shape, step.scratch.ball_end[k]);
      if (!is_sphere(obstacle)) obstacle.spin = spin_of(obstacle, momentum);
      if (!step.scratch.blows.ball_touched[k]) obstacle.velocity += fall;
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
  report.left_out = step.scratch.left_out.size();
  for (const ContactPoint& contact : step.scratch.left_out) {
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

/// How surface loads move and turn what is free.
void note_loads(ContactStep& step) {
  step.scratch.load_acceleration.clear();
  const MechanicsState& state = step.pass.state;
  const std::vector<Vec3>& force = step.pass.input.loads.force;
  if (force.empty()) return;
  step.scratch.load_acceleration.resize(state.components.size(), {Vec3::Zero(), Vec3::Zero()});
  for_each_living(state, step.pass.input.members, [&](const Component& component) {
    if (component.supported) return;
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (VertexId v : component.vertices) {
      const Vec3& f = force[v.index()];
      sum += f;
      moment += (state.vertices.position[v.index()] - component.centre).cross(f);
    }
    if (sum.isZero(0) && moment.isZero(0)) return;
    step.scratch.load_acceleration[component.id.index()] = {
        sum / component.mass, world_inertia(state, component).inverse() * moment};
  });
}

/// As many rows in the scratch as the step needs, and a first prediction.
void begin_step(ContactStep& step) {
  ContactScratch::Buffers& scratch = step.scratch;
  MechanicsState& state = step.pass.state;
  const std::size_t balls = step.pass.obstacles.size();
  scratch.blows.component_touched.assign(state.components.size(), 0);
  scratch.blows.ball_touched.assign(balls, 0);
  scratch.blows.component_twist.assign(state.components.size(), Vec3::Zero());
  scratch.blows.component_push.assign(state.components.size(), Vec3::Zero());
  scratch.blows.vertex_impulse.assign(state.vertices.size(), Vec3::Zero());
  scratch.blows.ball_impulse.assign(balls, Vec3::Zero());
  scratch.blows.ball_twist.assign(balls, Vec3::Zero());
  scratch.left_out.clear();
  note_loads(step);
  const StepInput& input = step.pass.input;
  prepare(state, input);
  begin_ties(step);
  for_each_living(state, input.members, [&](const Component& component) {
    if (scratch.blows.component_touched[component.id.index()]) return;
    predict(step.pass.mechanics, state, input, {&component.id, 1});
  });
  if (step.is_wave() && !step.ties.empty()) predict_struck(step);
  if (input.members.component.empty()) return;
  // What keeps still is where it is; its rows are there also where no member lives.
  predict(step.pass.mechanics, state, input, {});
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (input.members.has(state.vertices.component[v])) continue;
    step.pass.mechanics.predicted.position[v] = state.vertices.position[v];
  }
}

/// Before the bodies are adopted: what is without an impulse is no contact; moments of the others.
std::vector<Vec3> finish_contacts(ContactStep& step) {
  std::erase_if(step.contacts, [](const ContactPoint& c) { return c.impulse.isZero(0); });
  std::vector<Vec3> moments;
  for (const ContactPoint& c : step.contacts) {
    moments.push_back(
        (place_of_side_a(step.pass, c) + way_of_impulse(step.pass, c)).cross(c.impulse));
  }
  return moments;
}

/// What a bounce took back or gave, it did where the part ends.
void take_back_bounce(std::vector<Vec3>& moments, ContactStep& step) {
  std::vector<Vec3> before;
  for (const ContactPoint& c : step.contacts) before.push_back(c.impulse);
  take_back_bounce(step.contacts, step.scratch.bodies, step.pass, step.settings);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const ContactPoint& c = step.contacts[k];
    moments[k] += place_of_side_a(step.pass, c).cross(c.impulse - before[k]);
  }
}

/// After the bodies were adopted: balls, bounces, memory.
void end_step(ContactStep& step, std::vector<Vec3>& moments, bool fine) {
  move_obstacles(step);
  const bool bounces =
      step.settings.method == ContactMethod::impulses &&
      (step.deformation() == Deformation::whole || step.deformation() == Deformation::catch_up);
  if (fine && bounces) take_back_bounce(moments, step);
  sum_impulses(step);
  remember_contacts(step);
}

}  // namespace

void add_contact(ContactReport& sum, const ContactReport& part) {
  add_part(sum, part);
  if (part.residual - part.tolerated >= sum.residual - sum.tolerated) {
    sum.residual = part.residual;
    sum.tolerated = part.tolerated;
  }
  sum.converged = sum.converged && part.converged;
  const std::size_t obstacles = std::max(sum.obstacle_impulse.size(), part.obstacle_impulse.size());
  sum.obstacle_impulse.resize(obstacles, Vec3::Zero());
  for (std::size_t k = 0; k < part.obstacle_impulse.size(); ++k) {
    sum.obstacle_impulse[k] += part.obstacle_impulse[k];
  }
}

ContactStepResult advance_with_contact(const ContactWorld& world, const StepInput& input,
                                       const ContactSettings& settings,
                                       const ContactStepScratch& scratch) {
  ContactStep step{{input, world.state, world.obstacles, scratch.mechanics},
                   world.memory,
                   settings,
                   *scratch.contact.buffers,
                   {},
                   {},
                   {}};
  begin_step(step);
  predict_balls(step);
  ContactStepResult result;
  if (settings.method == ContactMethod::penalty) {
    push_by_penalty(step);
    predict_balls(step);
  } else {
    update_partners(world.memory, step.scratch.detect, paths_of(step));
    result.adopted = resolve(step);
  }
  if (result.adopted) {
    result.ties = finish_ties(step);
    count_contacts(step);
    if (step.is_wave() && input.part.impact) feel_blows(step);
    // Where ties open, waves run: as if it were struck.
    const std::vector<ComponentId>& torn = result.ties.torn;
    step.blows.struck.insert(step.blows.struck.end(), torn.begin(), torn.end());
    sort_unique(step.blows.struck);
    result.moments = finish_contacts(step);
    result.status = adopt(world.state, scratch.mechanics, input);
    end_step(step, result.moments, result.status.outcome == StepOutcome::fine);
    if (step.report.candidates > 0 || !step.ties.empty()) {
      result.touched = step.scratch.blows.component_touched;
      result.ball_touched = step.scratch.blows.ball_touched;
    }
  }
  result.blows = std::move(step.blows);
  result.report = std::move(step.report);
  result.contacts = std::move(step.contacts);
  return result;
}

}  // namespace sunder

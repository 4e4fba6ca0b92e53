// SPDX-License-Identifier: MIT
// The passes of a step with contact: find, solve, predict again, until nothing new is met.
#include <algorithm>
#include <cmath>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "mechanics/contact/push_out.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {

double target_gap(const ContactPoint& contact) { return std::min(0.0, contact.gap_start); }

double push_out(const ContactStep& step, const ContactPoint& contact) {
  // Patches of overlaps hold in explicit steps: pushed, those of wedged pieces work against others.
  if (step.is_wave() && contact.is_of_overlap()) return 0;
  return push_out_distance(step.settings, contact.gap_start, step.h());
}

double row_error(const Constraint& row) {
  const double pressed = row.normal.dot(row.impulse);
  const double gap = row.contact().gap + row.compliance * pressed;
  return pressed > 0 ? std::max(-gap, gap - row.contact().push) : -gap;
}

void predict_balls(ContactStep& step) {
  const std::vector<Obstacle>& obstacles = step.pass.obstacles;
  step.scratch.ball_end.resize(obstacles.size());
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

namespace {

/// m: how much less the matter of a piece moves where a sphere touches it than it would at the
/// centre of the sphere. Paths of spheres are those of their centres.
Vec3 turn_of_arm(const ContactStep& step, const ContactPoint& contact) {
  if (!contact.is_sphere_a() || !contact.is_body_b()) return Vec3::Zero();
  const Vec3 arm = radius_of(step.pass.obstacles[contact.ball].shape) * contact.normal;
  const ComponentId id = component_of_b(contact, step.pass.state);
  const Eigen::Quaterniond turn = step.pass.mechanics.predicted.frame[id.index()].orientation *
                                  step.pass.state.components[id.index()].orientation.conjugate();
  return turn * arm - arm;
}

/// Gap and slip of a contact's row at the predicted end of the step. Gives its error, m.
double measure_contact(const ContactStep& step, const ContactPoint& contact, Constraint& row,
                       const StepPaths& paths) {
  const ContactPath path = path_of(contact, paths);
  ContactConstraint& law = row.contact();
  law.gap = predicted_gap_error(step, contact, path);
  law.push = push_out(step, contact);
  law.friction = contact.friction;
  row.compliance = step.settings.compliance / step.h();
  row.impulse = contact.impulse;
  row.slip = path.end - path.start + relative_shift(step, contact) + turn_of_arm(step, contact);
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const std::uint32_t ball = step.scratch.bodies.ball[row.ends[e].body];
    // The ways of all other obstacles contain their turns.
    if (ball == ContactBodies::none || !is_sphere(step.pass.obstacles[ball])) continue;
    row.slip +=
        step.h() * row.ends[e].weight * step.pass.obstacles[ball].spin.cross(row.ends[e].arm);
  }
  return row_error(row);
}

/// Gaps and slips of the rows at the predicted end of the step. Gives the largest error among the
/// contacts: an overlap, or an impulse where there is a gap.
double measure_rows(ContactStep& step) {
  const StepPaths paths = paths_of(step);
  double worst = 0;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    const ContactPoint& contact = step.contacts[k];
    Constraint& row = step.scratch.bodies.rows[k];
    const double error = k < step.tied_rows ? measure_tie(row, step.ties[k], contact.impulse, paths)
                                            : measure_contact(step, contact, row, paths);
    worst = std::max(worst, error);
  }
  return worst;
}

/// Solves, hands the changes on, and predicts all bodies that were touched.
void solve_pass(ContactStep& step) {
  ContactBodies& bodies = step.scratch.bodies;
  const SolveOutcome outcome = solve_contacts(
      bodies.rows, bodies.bodies,
      {step.h(), step.report.tolerated, step.settings.max_iterations, step.pass.input.hurry, true});
  step.report.iterations += outcome.iterations;
  step.report.converged = step.report.converged && outcome.converged;
  step.report.force_error = outcome.impulse / step.h();
  step.stalled = outcome.stalled;
  step.scratch.change.resize(step.contacts.size());
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    step.scratch.change[k] = bodies.rows[k].impulse - step.contacts[k].impulse;
    step.contacts[k].impulse = bodies.rows[k].impulse;
  }
  apply_changes(step.scratch.blows, bodies, step.scratch.change, step.pass);
  predict_touched(step.scratch.blows, step.pass);
  predict_balls(step);
  ++step.report.passes;
}

/// Further passes are for methods with bodies that answer as the response says. Other methods turn
/// the error of the response into impulses, and each pass adds to them.
int most_passes(const ContactStep& step) {
  constexpr int for_others = 3;
  const IntegratorSettings& method = step.pass.input.settings;
  const bool answers =
      is_floating(method.integrator) && method.isolated == IsolatedTetrahedra::rigid;
  return answers ? step.settings.max_passes : std::min(step.settings.max_passes, for_others);
}

/// The gap error that counts as none, m, where contacts would end `deepest` too deep. By default a
/// ten thousandth of the depth that is never pushed out is as good as nothing: pieces that lie in a
/// heap are not solved for further. A finer tolerance, say 1e-8, gets its gaps.
double tolerated_error(const ContactStep& step, double deepest) {
  const double asked = step.settings.tolerance / 1e-5;
  const double nothing = 1e-4 * step.settings.allowed_penetration;
  double tolerated = std::max(step.settings.tolerance * deepest, asked * asked * nothing);
  for (std::size_t tie = 0; tie < step.tied_rows; ++tie) {
    tolerated = std::min(tolerated, tie_tolerance * opening_end_of(step.ties[tie]));
  }
  return tolerated;
}

/// Where there is nothing more to solve: whether another detection may find more, and which.
bool looks_further(ContactStep& step) {
  using Look = ContactStep::Look;
  if (step.look == Look::resting && step.has_left) {
    step.look = Look::all;
    return true;
  }
  if (step.look == Look::overlaps) return false;
  if (!may_overlap(paths_of(step), step.settings)) return false;
  step.look = Look::overlaps;
  return true;
}

}  // namespace

bool resolve(ContactStep& step) {
  using Look = ContactStep::Look;
  double deepest = 0;
  int most = most_passes(step);
  // Bounds of ties follow the openings that a pass predicts.
  constexpr int passes_of_ties = 8;
  if (step.tied_rows > 0) most = std::max(most, passes_of_ties);
  step.look = Look::resting;
  bool has_seen_all = false;
  for (int k = 0;;) {
    const std::size_t before = step.contacts.size();
    const bool is_clear = meet(step, deepest);
    if (!is_clear && (k == 0 || !has_seen_all)) return false;
    has_seen_all = has_seen_all || step.look == Look::all || !step.has_left;
    deepest = find_new_contacts(step, deepest);
    if (deepest == 0 && step.tied_rows == 0) {
      if (looks_further(step)) continue;
      return true;
    }
    step.report.tolerated = tolerated_error(step, deepest);
    if (k == most || (k > 0 && step.pass.input.is_hurried())) {
      step.report.residual = std::max(measure_rows(step), leave_new_contacts(step));
      return true;
    }
    take_new_contacts(step);
    if (k == 0 || step.contacts.size() != before) {
      gather_bodies(step.scratch.bodies, step.contacts, step.pass);
    } else {
      for (Constraint& row : step.scratch.bodies.rows) row.guess.setZero();
    }
    step.report.residual = measure_rows(step);
    // Another pass of a solve that stalled would stall again.
    const double near = step.stalled ? 64 : 1;
    const bool settled = k > 0 && step.contacts.size() == before &&
                         step.report.residual <= near * step.report.tolerated;
    if (settled) {
      if (looks_further(step)) continue;
      return true;
    }
    if (k == 0) guess_from_last_step(step);
    solve_pass(step);
    step.look = Look::all;
    ++k;
  }
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The sweeps of projected Gauss-Seidel over contact rows, sped up by conjugation.
#include "mechanics/contact/solver/contact_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/solver/contact_subspace.hpp"
#include "mechanics/contact/solver/tie_row.hpp"

namespace sunder {
namespace {

/// Largest eigenvalue of the response in the contact plane: the safe divisor for both directions.
double tangential_response(const ContactRow& row) {
  const Vec3 u = row.normal.unitOrthogonal();
  const Vec3 w = row.normal.cross(u);
  const double uu = u.dot(row.response * u);
  const double ww = w.dot(row.response * w);
  const double uw = 0.5 * (u.dot(row.response * w) + w.dot(row.response * u));
  return 0.5 * (uu + ww) + std::sqrt(0.25 * (uu - ww) * (uu - ww) + uw * uw);
}

Vec3 projected_on_disk(const Vec3& v, double radius) {
  const double length = v.norm();
  return length <= radius ? v : Vec3{v * (radius / length)};
}

/// The normal impulse that a row needs, if it has `before` and its gap is `gap`: what is too deep
/// is pushed by ever less, and by nothing from `push_most` on. Wedged pieces cannot be pushed
/// apart; a push without end would press them until friction threw them out.
double wanted_normal(const ContactRow& row, double before, double gap) {
  double wanted = before - gap / row.normal_response;
  if (row.push > 0) {
    const double give = row.push / row.push_most;
    const double pushed = before + (row.push - gap - give * before) / (row.normal_response + give);
    wanted = std::max(wanted, std::min(pushed, row.push_most));
  }
  return std::clamp(wanted, row.least, row.most);
}

double relax_tie(ContactRow& row, std::span<RespondingBody> bodies, double step) {
  const Vec3 before = row.impulse;
  row.impulse = tie_wanted(row, opening_of(row, relative_displacement(row, bodies, step)));
  const Vec3 change = row.impulse - before;
  if (!change.isZero(0)) add_impulse(row, bodies, change);
  return change.norm() * row.tie_response;
}

/// One visit of a row: its new impulse, and by how far (m) it was from where it should be.
double relax(ContactRow& row, std::span<RespondingBody> bodies, double step) {
  if (row.is_tie()) return relax_tie(row, bodies, step);
  const double normal_response = row.normal_response;
  if (!(normal_response > 0)) return 0;
  const Vec3& n = row.normal;
  const Vec3 before = row.impulse;
  const double before_n = n.dot(before);
  const Vec3 moved = relative_displacement(row, bodies, step);
  const double gap = row.gap + n.dot(moved) + row.compliance * before_n;
  const double wanted_n = wanted_normal(row, before_n, gap);
  double error = std::abs(wanted_n - before_n) * normal_response;
  // Friction sees the slip that the new normal impulse leaves.
  const Vec3 normal_change = (wanted_n - before_n) * n;
  Vec3 wanted_t = Vec3::Zero();
  if (row.disk > 0) {
    const double divisor = row.tangential_response;
    const Vec3 total = row.slip + moved + row.response * normal_change;
    const Vec3 slip = total - n * n.dot(total);
    const Vec3 before_t = before - before_n * n;
    if (divisor > 0) {
      wanted_t = projected_on_disk(before_t - slip / divisor, row.disk);
      error = std::max(error, (wanted_t - before_t).norm() * divisor);
    }
  }
  row.impulse = wanted_n * n + wanted_t;
  const Vec3 change = row.impulse - before;
  if (!change.isZero(0)) add_impulse(row, bodies, change);
  return error;
}

/// Impulses of a sweep and where the last one led: what conjugation needs.
struct Search {
  std::vector<Vec3> before, direction, onward;
  double last = 0;  ///< squared length of the last sweep's change
};

/// Goes on in the direction that sweeps have gone, as far as conjugate gradients would [Silcowitz,
/// Niebe, Erleben 2010: nonsmooth nonlinear conjugate gradients]; starts afresh when a sweep
/// changed more than the one before. May leave the bounds: the next sweep returns.
void conjugate(Search& search, std::span<ContactRow> rows, std::span<RespondingBody> bodies) {
  double now = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    now += (rows[k].impulse - search.before[k]).squaredNorm();
  }
  const bool afresh = !(search.last > 0) || now > search.last;
  const double beta = afresh ? 0 : now / search.last;
  search.last = now;
  std::vector<Vec3>& onward = search.onward;
  onward.resize(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    onward[k] = beta * search.direction[k];
    search.direction[k] = onward[k] + rows[k].impulse - search.before[k];
    rows[k].impulse += onward[k];
  }
  if (!afresh) add_impulses(rows, bodies, onward);
}

/// Lets the disks follow the normal impulses. Gives the largest change, as the displacement (m) it
/// stands for.
double follow_disks(std::span<ContactRow> rows) {
  double largest = 0;
  for (ContactRow& row : rows) {
    if (row.is_tie()) continue;
    const double pressed = row.normal.dot(row.impulse);
    const double disk = row.friction * std::max(0.0, pressed);
    // What sticks inside both disks does not feel the change.
    const double friction = (row.impulse - pressed * row.normal).norm();
    const bool slips = friction >= (1 - 1e-9) * std::min(disk, row.disk);
    const double change = disk - row.disk;
    if (slips) largest = std::max(largest, std::abs(change) * row.tangential_response);
    // In a wedge friction and pressure take from each other, more than there is: shorter ways where
    // the change turns back.
    const bool turns_back = change * row.disk_change < 0;
    row.disk_share = turns_back ? 0.5 * row.disk_share : std::min(1.0, 1.25 * row.disk_share);
    row.disk += row.disk_share * change;
    row.disk_change = change;
  }
  return largest;
}

/// Friction that a disk allowed and the normal impulse at the end does not: by no more than the
/// tolerance where the solve converged.
void keep_to_cones(std::span<ContactRow> rows, std::span<RespondingBody> bodies) {
  // What presses by a rounding of friction does not press.
  double rounding = 0;
  for (const ContactRow& row : rows) rounding = std::max(rounding, 1e-12 * row.impulse.norm());
  for (ContactRow& row : rows) {
    const double pressed = row.normal.dot(row.impulse);
    const Vec3 tangential = row.impulse - pressed * row.normal;
    const double most = row.friction * std::max(0.0, pressed);
    const bool presses = pressed > rounding;
    if (row.is_tie() || row.friction == 0 || (presses && tangential.norm() <= most)) continue;
    const Vec3 kept =
        presses ? Vec3(pressed * row.normal + projected_on_disk(tangential, most)) : Vec3::Zero();
    const Vec3 change = kept - row.impulse;
    row.impulse = kept;
    add_impulse(row, bodies, change);
  }
}

/// What rows do by their impulses: the displacement without any, and what impulses of earlier
/// passes give, both as the rows stand when the solve begins.
struct Energy {
  std::vector<Vec3> without, earlier;
};

Energy energy_of(std::span<const ContactRow> rows, std::span<RespondingBody> bodies, double step) {
  Energy energy;
  for (const ContactRow& row : rows) add_impulse(row, bodies, row.impulse);
  for (const ContactRow& row : rows) {
    const Vec3& n = row.normal;
    energy.earlier.push_back(relative_displacement(row, bodies, step));
    const Vec3 now = row.is_tie() ? row.slip
                                  : Vec3((row.gap - row.push) * n + row.slip - n * n.dot(row.slip));
    energy.without.push_back(now - energy.earlier.back());
  }
  return energy;
}

/// Whether the impulses as they are give the bodies energy: never, unless a solve was cut short.
bool gives_energy(std::span<const ContactRow> rows, std::span<const RespondingBody> bodies,
                  const Energy& energy, double step) {
  double work = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Vec3 response = energy.earlier[k] + relative_displacement(rows[k], bodies, step);
    work += rows[k].impulse.dot(energy.without[k] + 0.5 * response);
  }
  return work > 0;
}

/// Once round all rows; by how far the farthest was from where it should be, m.
double sweep(std::span<ContactRow> rows, std::span<RespondingBody> bodies, double step) {
  double farthest = 0;
  for (ContactRow& row : rows) farthest = std::max(farthest, relax(row, bodies, step));
  return farthest;
}

void start_from_nothing(std::span<ContactRow> rows, std::span<RespondingBody> bodies) {
  for (ContactRow& row : rows) {
    add_impulse(row, bodies, -row.impulse);
    row.impulse.setZero();
  }
}

/// Impulses anew, from none, without friction and without conjugation: each visit takes energy. Not
/// many sweeps: what they leave is not solved anyway, and a wedge of overlaps without a way out is
/// pressed harder by each.
void press_only(std::span<ContactRow> rows, std::span<RespondingBody> bodies,
                const SolveLimits& limits) {
  start_from_nothing(rows, bodies);
  for (ContactRow& row : rows) row.disk = 0;
  constexpr int enough = 64;
  for (int i = 0; i < std::min(enough, limits.max_iterations / 2); ++i) {
    if (sweep(rows, bodies, limits.step) <= limits.tolerance) return;
  }
}

/// Twice what the impulses of rows would give at rest, N s m: each alone, and all together.
struct Effort {
  double alone = 0, together = 0;
};

Effort effort_of(std::span<const ContactRow> rows, std::span<const RespondingBody> bodies,
                 const Energy& energy, double step) {
  Effort effort;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Vec3& j = rows[k].impulse;
    if (j.isZero(0)) continue;
    effort.alone += j.dot(rows[k].response * j);
    effort.together += j.dot(energy.earlier[k] + relative_displacement(rows[k], bodies, step));
  }
  return effort;
}

/// In a wedge pressure and friction can raise each other without end and hold each other so well
/// that next to nothing moves, as little as the sweeps ask for. Such impulses come from no motion
/// of the bodies, and what the response is off by gives energy. A tall stack strains as hard, but
/// by its weight, without friction too. Puts pressure alone in their place.
void release_wedges(std::span<ContactRow> rows, std::span<RespondingBody> bodies,
                    const Energy& energy, const SolveLimits& limits) {
  constexpr double holds = 64, by_friction = 16;
  const Effort effort = effort_of(rows, bodies, energy, limits.step);
  if (!(effort.alone > holds * effort.together)) return;
  std::vector<Vec3> change;
  for (const ContactRow& row : rows) change.push_back(row.impulse);
  press_only(rows, bodies, limits);
  const Effort pressed = effort_of(rows, bodies, energy, limits.step);
  if (effort.alone > by_friction * pressed.alone) return;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    change[k] -= rows[k].impulse;
    rows[k].impulse += change[k];
  }
  add_impulses(rows, bodies, change);
}

/// Where contacts are more than their bodies can tell apart, pressure and the disks that follow it
/// change for ever by a little: the residual falls no more.
class Stall {
 public:
  /// Whether the residual has not halved for long, and is near the tolerance.
  bool is_over(const SolveOutcome& now, const SolveLimits& limits) {
    constexpr int patience = 128;
    constexpr double near = 64;
    if (now.residual < 0.5 * least_) {
      least_ = now.residual;
      at_ = now.iterations;
    }
    return now.iterations - at_ > patience && now.residual <= near * limits.tolerance;
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int at_ = 0;
};

}  // namespace

SolveOutcome solve_contacts(std::span<ContactRow> rows, std::span<RespondingBody> bodies,
                            const SolveLimits& limits) {
  SolveOutcome outcome;
  if (rows.empty()) return outcome;
  set_to_rest(bodies);
  const Energy energy = energy_of(rows, bodies, limits.step);
  set_to_rest(bodies);
  for (ContactRow& row : rows) {
    set_own_response(row, bodies, limits.step);
    row.disk_change = 0;
    row.disk_share = 1;
    row.normal_response = row.normal.dot(row.response * row.normal) + row.compliance;
    row.tangential_response = tangential_response(row);
    if (row.is_tie()) row.tie_response = tie_response_of(row);
    // A hundred times what would push the two sides apart were they free: it lifts what rests.
    row.push_most = row.normal_response > 0 ? 100 * row.push / row.normal_response : 0;
    add_impulse(row, bodies, row.guess);
    row.impulse += row.guess;
  }
  // What a wedge pressed with in the last step must not be where this one begins.
  if (gives_energy(rows, bodies, energy, limits.step)) start_from_nothing(rows, bodies);
  Search search{
      std::vector<Vec3>(rows.size()), std::vector<Vec3>(rows.size(), Vec3::Zero()), {}, 0};
  // Sweeps of a round with the same disks, unless it converges earlier.
  constexpr int round_length = 8;
  int sweeps = 0;
  double moved = 0;
  Stall stall;
  follow_disks(rows);
  outcome.converged = false;
  while (outcome.iterations < limits.max_iterations) {
    ++outcome.iterations;
    for (std::size_t k = 0; k < rows.size(); ++k) search.before[k] = rows[k].impulse;
    outcome.residual = sweep(rows, bodies, limits.step);
    if (limits.hurry && *limits.hurry) break;
    if (++sweeps >= round_length || outcome.residual <= std::max(limits.tolerance, 0.1 * moved)) {
      moved = follow_disks(rows);
      outcome.residual = std::max(outcome.residual, moved);
      outcome.stalled = limits.ends_stalled && outcome.residual > limits.tolerance &&
                        stall.is_over(outcome, limits);
      outcome.converged = outcome.residual <= limits.tolerance || outcome.stalled;
      if (outcome.converged) break;
      sweeps = 0;
      const int left = limits.max_iterations - outcome.iterations - 1;
      if (left > 1) {
        // Where few sweeps are allowed they find what is free sooner.
        const bool again = left > 64;
        outcome.iterations += solve_subspace(rows, bodies, limits.step, std::min(24, left), again);
        search.last = 0;
        continue;
      }
    }
    // The last sweep stands as it is: its impulses keep their bounds.
    if (outcome.iterations < limits.max_iterations) conjugate(search, rows, bodies);
  }
  keep_to_cones(rows, bodies);
  if (gives_energy(rows, bodies, energy, limits.step)) {
    outcome.converged = false;
    press_only(rows, bodies, limits);
  } else if (!outcome.converged) {
    release_wedges(rows, bodies, energy, limits);
  }
  return outcome;
}

}  // namespace sunder

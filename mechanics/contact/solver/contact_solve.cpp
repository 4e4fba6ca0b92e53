// SPDX-License-Identifier: MIT
// The sweeps of projected Gauss-Seidel over rows, sped up by conjugation.
#include "mechanics/contact/solver/contact_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/solver/contact_law.hpp"
#include "mechanics/contact/solver/contact_subspace.hpp"
#include "mechanics/contact/solver/tie_row.hpp"

namespace sunder {
namespace {

Vec3 projected_on_disk(const Vec3& v, double radius) {
  const double length = v.norm();
  return length <= radius ? v : Vec3{v * (radius / length)};
}

/// One visit of a contact: pressure first, then friction inside the disk as it is.
double relax_contact(Constraint& row, const RowResponse& response, std::span<RespondingBody> bodies,
                     double step) {
  const double normal_response = response.normal_response;
  if (!(normal_response > 0)) return 0;
  const Vec3& n = row.normal;
  const Vec3 before = row.impulse;
  const double before_n = n.dot(before);
  const Vec3 moved = relative_displacement(row, bodies, step);
  const double gap = row.contact().gap + n.dot(moved) + row.compliance * before_n;
  const double wanted_n = contact_wanted(row, response, before_n, gap);
  double error = std::abs(wanted_n - before_n) * normal_response;
  // Friction sees the slip that the new normal impulse leaves.
  const Vec3 normal_change = (wanted_n - before_n) * n;
  Vec3 wanted_t = Vec3::Zero();
  if (response.disk > 0) {
    const double divisor = response.tangential_response;
    const Vec3 total = row.slip + moved + response.response * normal_change;
    const Vec3 slip = total - n * n.dot(total);
    const Vec3 before_t = before - before_n * n;
    if (divisor > 0) {
      wanted_t = projected_on_disk(before_t - slip / divisor, response.disk);
      error = std::max(error, (wanted_t - before_t).norm() * divisor);
    }
  }
  row.impulse = wanted_n * n + wanted_t;
  const Vec3 change = row.impulse - before;
  if (!change.isZero(0)) add_impulse(row, bodies, change);
  return error;
}

/// One visit of a bond.
double relax_bond(Constraint& row, std::span<RespondingBody> bodies, double step) {
  const Vec3 before = row.impulse;
  row.impulse = bond_wanted(row, opening_of(row, relative_displacement(row, bodies, step)));
  const Vec3 change = row.impulse - before;
  if (!change.isZero(0)) add_impulse(row, bodies, change);
  return change.norm() * row.bond().response;
}

/// One visit of row k: its new impulse, and by how far (m) it was from where it should be.
double relax(const RowSolve& solve, std::size_t k) {
  Constraint& row = solve.rows[k];
  return row.is_bond() ? relax_bond(row, solve.bodies, solve.step)
                       : relax_contact(row, solve.responses[k], solve.bodies, solve.step);
}

/// Once round all rows; by how far the farthest was from where it should be, m.
double sweep(const RowSolve& solve) {
  double farthest = 0;
  for (std::size_t k = 0; k < solve.rows.size(); ++k) {
    farthest = std::max(farthest, relax(solve, k));
  }
  return farthest;
}

/// Impulses of a sweep and the last direction: the data of conjugation.
struct Search {
  std::vector<Vec3> before, direction, onward;
  double last = 0;  ///< squared length of the last sweep's change
};

/// Goes on in the direction that sweeps have gone, as far as conjugate gradients would [Silcowitz,
/// Niebe, Erleben 2010: nonsmooth nonlinear conjugate gradients]; starts afresh when a sweep
/// changed more than the one before. May leave the bounds: the next sweep returns.
void conjugate(Search& search, const RowSolve& solve) {
  const std::span<Constraint> rows = solve.rows;
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
  if (!afresh) add_impulses(rows, solve.bodies, onward);
}

/// Lets the disk of a contact follow its normal impulse. Gives the change, as the displacement (m)
/// it stands for, where the contact slips.
double follow_disk(const Constraint& row, RowResponse& response) {
  const double pressed = row.normal.dot(row.impulse);
  const double disk = row.contact().friction * std::max(0.0, pressed);
  // Friction that sticks inside both disks does not feel the change.
  const double friction = (row.impulse - pressed * row.normal).norm();
  const bool slips = friction >= (1 - 1e-9) * std::min(disk, response.disk);
  const double change = disk - response.disk;
  // In a wedge friction and pressure take from each other, more than there is: shorter ways where
  // the change turns back.
  const bool turns_back = change * response.disk_change < 0;
  response.disk_share =
      turns_back ? 0.5 * response.disk_share : std::min(1.0, 1.25 * response.disk_share);
  response.disk += response.disk_share * change;
  response.disk_change = change;
  return slips ? std::abs(change) * response.tangential_response : 0;
}

/// Lets all disks follow. Gives the largest change, m. Bonds have no disk.
double follow_disks(const RowSolve& solve) {
  double largest = 0;
  for (std::size_t k = 0; k < solve.rows.size(); ++k) {
    if (solve.rows[k].is_bond()) continue;
    largest = std::max(largest, follow_disk(solve.rows[k], solve.responses[k]));
  }
  return largest;
}

/// Takes back friction that a disk allowed and the normal impulse at the end does not. A contact
/// that presses by no more than `rounding` (N s) does not press.
void keep_to_cone(Constraint& row, std::span<RespondingBody> bodies, double rounding) {
  const double coefficient = row.contact().friction;
  const double pressed = row.normal.dot(row.impulse);
  const Vec3 tangential = row.impulse - pressed * row.normal;
  const double most = coefficient * std::max(0.0, pressed);
  const bool presses = pressed > rounding;
  if (coefficient == 0 || (presses && tangential.norm() <= most)) return;
  const Vec3 kept =
      presses ? Vec3(pressed * row.normal + projected_on_disk(tangential, most)) : Vec3::Zero();
  const Vec3 change = kept - row.impulse;
  row.impulse = kept;
  add_impulse(row, bodies, change);
}

/// Takes all contacts back to their cones: by no more than the tolerance where the solve converged.
void keep_to_cones(const RowSolve& solve) {
  // A contact that presses by a rounding of friction does not press.
  double rounding = 0;
  for (const Constraint& row : solve.rows) {
    rounding = std::max(rounding, 1e-12 * row.impulse.norm());
  }
  for (Constraint& row : solve.rows) {
    if (!row.is_bond()) keep_to_cone(row, solve.bodies, rounding);
  }
}

/// The displacement of rows without impulses, and their displacement from impulses of earlier
/// passes. Both are values at the begin of the solve.
struct Energy {
  std::vector<Vec3> without, earlier;
};

/// m: the displacement that a contact works against with its impulse as it is.
Vec3 displacement_of_contact(const Constraint& row) {
  const Vec3& n = row.normal;
  return (row.contact().gap - row.contact().push) * n + row.slip - n * n.dot(row.slip);
}

/// m: the same of a bond, its opening.
Vec3 displacement_of_bond(const Constraint& row) { return row.slip; }

/// Needs: `bodies` at rest.
Energy energy_of(std::span<const Constraint> rows, std::span<RespondingBody> bodies, double step) {
  Energy energy;
  for (const Constraint& row : rows) add_impulse(row, bodies, row.impulse);
  for (const Constraint& row : rows) {
    energy.earlier.push_back(relative_displacement(row, bodies, step));
    const Vec3 now = row.is_bond() ? displacement_of_bond(row) : displacement_of_contact(row);
    energy.without.push_back(now - energy.earlier.back());
  }
  return energy;
}

/// Whether the impulses as they are give the bodies energy: never, unless a solve was cut short.
bool gives_energy(const RowSolve& solve, const Energy& energy) {
  double work = 0;
  for (std::size_t k = 0; k < solve.rows.size(); ++k) {
    const Vec3 response =
        energy.earlier[k] + relative_displacement(solve.rows[k], solve.bodies, solve.step);
    work += solve.rows[k].impulse.dot(energy.without[k] + 0.5 * response);
  }
  return work > 0;
}

void start_from_nothing(const RowSolve& solve) {
  for (Constraint& row : solve.rows) {
    add_impulse(row, solve.bodies, -row.impulse);
    row.impulse.setZero();
  }
}

/// Solves again from zero impulses, without friction and without conjugation: each visit takes
/// energy. The sweeps are few: contacts still open after them are not solved anyway. Each further
/// sweep would also press a wedge of overlaps without a way out harder.
void press_only(const RowSolve& solve, const SolveLimits& limits) {
  start_from_nothing(solve);
  for (RowResponse& response : solve.responses) response.disk = 0;
  constexpr int enough = 64;
  for (int i = 0; i < std::min(enough, limits.max_iterations / 2); ++i) {
    if (sweep(solve) <= limits.tolerance) return;
  }
}

/// Twice the work of row impulses on bodies at rest, N s m: of each alone, and of all together.
struct Effort {
  double alone = 0, together = 0;
};

Effort effort_of(const RowSolve& solve, const Energy& energy) {
  Effort effort;
  for (std::size_t k = 0; k < solve.rows.size(); ++k) {
    const Vec3& j = solve.rows[k].impulse;
    if (j.isZero(0)) continue;
    effort.alone += j.dot(solve.responses[k].response * j);
    effort.together +=
        j.dot(energy.earlier[k] + relative_displacement(solve.rows[k], solve.bodies, solve.step));
  }
  return effort;
}

/// In a wedge pressure and friction can raise each other without end. They cancel so well that next
/// to nothing moves, as little as the tolerance of the sweeps. Such impulses come from no motion of
/// the bodies, and the error of the response gives energy. A tall stack strains as hard, but by its
/// weight, without friction too. Puts pressure alone in their place.
void release_wedges(const RowSolve& solve, const Energy& energy, const SolveLimits& limits) {
  constexpr double holds = 64, by_friction = 16;
  const Effort effort = effort_of(solve, energy);
  if (!(effort.alone > holds * effort.together)) return;
  std::vector<Vec3> change;
  for (const Constraint& row : solve.rows) change.push_back(row.impulse);
  press_only(solve, limits);
  const Effort pressed = effort_of(solve, energy);
  if (effort.alone > by_friction * pressed.alone) return;
  for (std::size_t k = 0; k < solve.rows.size(); ++k) {
    change[k] -= solve.rows[k].impulse;
    solve.rows[k].impulse += change[k];
  }
  add_impulses(solve.rows, solve.bodies, change);
}

/// Contacts can be more than the independent motions of their bodies. Pressure and the disks that
/// follow it then change for ever by a little: the residual falls no more.
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

/// Responses of all rows, and of bonds the step of their sweeps.
std::vector<RowResponse> respond(std::span<Constraint> rows, std::span<const RespondingBody> bodies,
                                 double step) {
  std::vector<RowResponse> responses;
  responses.reserve(rows.size());
  for (Constraint& row : rows) {
    responses.push_back(response_of(row, bodies, step));
    if (row.is_bond()) row.bond().response = bond_response(row, responses.back().response);
  }
  return responses;
}

/// Whether the solve may end after a round, by the changes of its last sweep and of the disks
/// (`moved`, m).
void judge_round(SolveOutcome& outcome, double moved, Stall& stall, const SolveLimits& limits) {
  outcome.residual = std::max(outcome.residual, moved);
  outcome.stalled =
      limits.ends_stalled && outcome.residual > limits.tolerance && stall.is_over(outcome, limits);
  outcome.converged = outcome.residual <= limits.tolerance || outcome.stalled;
}

/// Solves for the free parts of impulses, if iterations are left for that. False: there are none.
bool spend_on_subspace(SolveOutcome& outcome, const RowSolve& solve, const SolveLimits& limits) {
  const int left = limits.max_iterations - outcome.iterations - 1;
  if (left <= 1) return false;
  // Where few sweeps are allowed, the sweeps find the free parts sooner.
  const bool again = left > 64;
  outcome.iterations += solve_subspace(solve, std::min(24, left), again);
  return true;
}

/// N s: by which an impulse has changed most.
double largest_change(std::span<const Constraint> rows, std::span<const Vec3> before) {
  double squared = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    squared = std::max(squared, (rows[k].impulse - before[k]).squaredNorm());
  }
  return std::sqrt(squared);
}

/// Rounds of sweeps with the same disks, until the impulses converge.
SolveOutcome sweep_in_rounds(const RowSolve& solve, const SolveLimits& limits) {
  // Sweeps of a round, unless it converges earlier.
  constexpr int round_length = 8;
  const std::size_t count = solve.rows.size();
  SolveOutcome outcome{.converged = false};
  Search search{std::vector<Vec3>(count), std::vector<Vec3>(count, Vec3::Zero()), {}, 0};
  Stall stall;
  int sweeps = 0;
  double moved = 0;
  follow_disks(solve);
  while (outcome.iterations < limits.max_iterations) {
    ++outcome.iterations;
    for (std::size_t k = 0; k < count; ++k) search.before[k] = solve.rows[k].impulse;
    outcome.residual = sweep(solve);
    outcome.impulse = largest_change(solve.rows, search.before);
    if (limits.hurry && *limits.hurry) break;
    if (++sweeps >= round_length || outcome.residual <= std::max(limits.tolerance, 0.1 * moved)) {
      moved = follow_disks(solve);
      judge_round(outcome, moved, stall, limits);
      if (outcome.converged) break;
      sweeps = 0;
      if (spend_on_subspace(outcome, solve, limits)) {
        search.last = 0;
        continue;
      }
    }
    // The last sweep stands as it is: its impulses keep their bounds.
    if (outcome.iterations < limits.max_iterations) conjugate(search, solve);
  }
  return outcome;
}

}  // namespace

SolveOutcome solve_contacts(std::span<Constraint> rows, std::span<RespondingBody> bodies,
                            const SolveLimits& limits) {
  if (rows.empty()) return {};
  set_to_rest(bodies);
  const Energy energy = energy_of(rows, bodies, limits.step);
  set_to_rest(bodies);
  std::vector<RowResponse> responses = respond(rows, bodies, limits.step);
  const RowSolve solve{rows, responses, bodies, limits.step};
  for (Constraint& row : rows) {
    add_impulse(row, bodies, row.guess);
    row.impulse += row.guess;
  }
  // The impulses of a wedge in the last step are no start for this one.
  if (gives_energy(solve, energy)) start_from_nothing(solve);
  SolveOutcome outcome = sweep_in_rounds(solve, limits);
  keep_to_cones(solve);
  if (gives_energy(solve, energy)) {
    outcome.converged = false;
    press_only(solve, limits);
  } else if (!outcome.converged) {
    release_wedges(solve, energy, limits);
  }
  // The next solve of a row goes on from its disk.
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!rows[k].is_bond()) rows[k].contact().disk = responses[k].disk;
  }
  return outcome;
}

}  // namespace sunder

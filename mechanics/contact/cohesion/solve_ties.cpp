// SPDX-License-Identifier: MIT
// Accelerated projected gradients over the ties of each component.
#include "mechanics/contact/cohesion/solve_ties.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mechanics/contact/solver/tie_row.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/solver/component_system.hpp"
#include "mechanics/ties/tie_law.hpp"

namespace sunder {
namespace {

/// The ties of one component at work.
struct TieProblem {
  std::span<Constraint> rows;
  std::span<const TiePair> pairs;
  std::vector<std::size_t> members;  ///< which of them
  const ComponentSystem& system;
  const MechanicsState& state;
  std::span<const Vec3> ends;  ///< m, one a row: the opening that the step ends with as predicted
  double time_step;            ///< s
  Mat3 turn;                   ///< from the body's frame to the world
  Eigen::VectorXd field;
  std::vector<char> needed;          ///< supernodes that tied vertices depend on
  std::vector<double> bearing = {};  ///< N, of each member: its `tie_bound`, which only falls
};

/// Free vertices of the ties, in the system's numbering.
std::vector<std::uint32_t> tied_vertices(const TieProblem& p) {
  std::vector<std::uint32_t> tied;
  for (const std::size_t k : p.members) {
    for (const VertexId v : {p.pairs[k].a, p.pairs[k].b}) {
      const std::uint32_t local = p.state.systems.local_row[v.index()];
      if (local < p.system.free_count) tied.push_back(local);
    }
  }
  return tied;
}

/// Adds an impulse, body frame, at a vertex; held ones take none.
void strike(TieProblem& p, VertexId v, const Vec3& impulse) {
  const std::size_t local = p.state.systems.local_row[v.index()];
  if (local < p.system.free_count)
    p.field.segment<3>(static_cast<Eigen::Index>(3 * local)) += impulse;
}

Vec3 answer(const TieProblem& p, VertexId v) {
  const std::size_t local = p.state.systems.local_row[v.index()];
  if (local >= p.system.free_count) return Vec3::Zero();
  return p.field.segment<3>(static_cast<Eigen::Index>(3 * local));
}

/// m/s by which impulses, one a member, open their ties.
std::vector<Vec3> openings(TieProblem& p, const std::vector<Vec3>& impulses) {
  p.field.setZero(static_cast<Eigen::Index>(3 * p.system.free_count));
  for (std::size_t i = 0; i < p.members.size(); ++i) {
    const TiePair& pair = p.pairs[p.members[i]];
    const Vec3 own = p.turn.transpose() * impulses[i];
    strike(p, pair.a, own);
    strike(p, pair.b, -own);
  }
  solve_system(p.system, p.field, FactorUse::wave, p.needed);
  std::vector<Vec3> opened;
  for (const std::size_t k : p.members) {
    opened.push_back(p.turn * (answer(p, p.pairs[k].a) - answer(p, p.pairs[k].b)));
  }
  return opened;
}

/// Bounds of the response, m/s for N s: each vertex by its mass, shared by the ties at it.
void set_responses(TieProblem& p) {
  std::map<VertexId, int> ties_at;
  for (const std::size_t k : p.members) {
    ++ties_at[p.pairs[k].a];
    ++ties_at[p.pairs[k].b];
  }
  const auto of = [&](VertexId v) {
    const bool held = p.state.systems.local_row[v.index()] >= p.system.free_count;
    return held ? 0 : ties_at[v] / p.state.vertices.mass[v.index()];
  };
  for (const std::size_t k : p.members) {
    CohesiveBond& bond = p.rows[k].bond();
    const double shear = std::max(1.0, bond.sliding_stiffness);
    bond.response = shear * (of(p.pairs[k].a) + of(p.pairs[k].b)) + p.rows[k].compliance;
  }
}

/// Bounds for what has not opened any farther in the step: the most that a tie can bear.
void raise_bounds(TieProblem& p) {
  for (const std::size_t k : p.members) {
    p.bearing.push_back(tie_bound(p.pairs[k], Vec3::Zero()));
    p.rows[k].bond().most =
        p.time_step * p.bearing.back() * mode_factor(p.pairs[k], p.rows[k].impulse, p.ends[k]);
  }
}

/// Bounds for the openings that changes of velocity lead to, where that is less. Gives the largest
/// change, as a share.
double lower_bounds(TieProblem& p, std::span<const Vec3> moved) {
  double lowered = 0;
  for (std::size_t i = 0; i < p.members.size(); ++i) {
    const std::size_t k = p.members[i];
    const Vec3 end = p.ends[k] + WaveScheme::theta * p.time_step * moved[i];
    const double bearing = tie_bound(p.pairs[k], end);
    if (bearing < p.bearing[i]) {
      lowered = std::max(lowered, 1 - bearing / p.bearing[i]);
      p.bearing[i] = bearing;
    }
    p.rows[k].bond().most =
        p.time_step * p.bearing[i] * mode_factor(p.pairs[k], p.rows[k].impulse, end);
  }
  return lowered;
}

/// Shares of openings from which on bounds follow (those on the way there would end ties), and
/// beyond which the solve is given `extra` times as many back-solves; both as multiples of the
/// tolerance. Bounds that still fall by more than `settled` are not settled.
constexpr double nearly = 100, coarse = 20, extra = 4, settled = 1e-3;

TieOutcome solve(TieProblem& p, double tolerance, int most) {
  const std::size_t n = p.members.size();
  set_responses(p);
  raise_bounds(p);
  std::vector<Vec3> start(n), now(n), ahead(n), change(n);
  for (std::size_t i = 0; i < n; ++i) start[i] = now[i] = ahead[i] = p.rows[p.members[i]].impulse;
  TieOutcome outcome{.residual = std::numeric_limits<double>::infinity()};
  double inertia = 1;
  while (outcome.iterations < (outcome.residual > coarse * tolerance ? extra * most : most)) {
    ++outcome.iterations;
    for (std::size_t i = 0; i < n; ++i) change[i] = ahead[i] - start[i];
    const std::vector<Vec3> moved = openings(p, change);
    double turn_back = 0;
    outcome.residual = 0;
    const double next_inertia = 0.5 * (1 + std::sqrt(1 + 4 * inertia * inertia));
    const double share = (inertia - 1) / next_inertia;
    for (std::size_t i = 0; i < n; ++i) {
      Constraint& row = p.rows[p.members[i]];
      row.impulse = ahead[i];
      const double response = row.bond().response;
      const Vec3 next = bond_wanted(row, opening_of(row, moved[i]));
      const double off = p.time_step * response * (next - ahead[i]).norm();
      outcome.residual = std::max(outcome.residual, off / opening_end_of(p.pairs[p.members[i]]));
      turn_back += response * (ahead[i] - next).dot(next - now[i]);
      ahead[i] = next + share * (next - now[i]);
      now[i] = next;
    }
    inertia = next_inertia;
    if (turn_back > 0) {
      inertia = 1;
      ahead = now;
    }
    if (outcome.residual > nearly * tolerance) continue;
    if (lower_bounds(p, moved) > settled) {
      inertia = 1;
      ahead = now;
    } else if (outcome.residual <= tolerance) {
      break;
    }
  }
  for (std::size_t i = 0; i < n; ++i) p.rows[p.members[i]].impulse = now[i];
  return outcome;
}

}  // namespace

TieOutcome solve_ties(std::span<Constraint> rows, std::span<const TiePair> pairs,
                      std::span<const Vec3> ends, const ContactPass& pass, double tolerance,
                      int most) {
  std::map<ComponentId, std::vector<std::size_t>> by_component;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    by_component[pass.state.vertices.component[pairs[k].a.index()]].push_back(k);
  }
  TieOutcome outcome;
  for (auto& [id, members] : by_component) {
    TieProblem problem{rows,
                       pairs,
                       std::move(members),
                       *pass.state.systems.present[id.index()],
                       pass.state,
                       ends,
                       pass.input.settings.time_step,
                       pass.state.components[id.index()].orientation.toRotationMatrix(),
                       {},
                       {}};
    mark_supernodes(problem.needed, problem.system, tied_vertices(problem));
    const TieOutcome own = solve(problem, tolerance, most);
    outcome.iterations += own.iterations;
    outcome.residual = std::max(outcome.residual, own.residual);
  }
  return outcome;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Ties in the course of a step: gathered, solved for in waves, settled.
#include <algorithm>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/cohesion/solve_ties.hpp"

namespace sunder {
namespace {

/// Hands a change of a tie's impulse on: both sides get it where A is, as of a contact.
void strike_pair(ContactStep& step, const TiePair& pair, const Vec3& change) {
  StepBlows& blows = step.scratch.blows;
  const MechanicsState& state = step.pass.state;
  const std::size_t id = state.vertices.component[pair.a.index()].index();
  const Vec3 apart =
      state.vertices.position[pair.a.index()] - state.vertices.position[pair.b.index()];
  blows.component_touched[id] = 1;
  blows.vertex_impulse[pair.a.index()] += change;
  blows.vertex_impulse[pair.b.index()] -= change;
  blows.component_twist[id] -= apart.cross(change);
}

/// The rows of all ties for the step as it is predicted.
std::vector<Constraint> measured(ContactStep& step) {
  std::vector<Constraint> rows(step.ties.size());
  const StepPaths paths = paths_of(step);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    measure_tie(rows[k], step.ties[k], step.tied[k].impulse, paths,
                step.pass.mechanics.predicted.velocity);
  }
  return rows;
}

/// Takes impulses in place of those that the ties have, and predicts that.
void take_impulses(ContactStep& step, std::span<const Constraint> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    strike_pair(step, step.ties[k], rows[k].impulse - step.tied[k].impulse);
    step.tied[k].impulse = rows[k].impulse;
  }
  predict_struck(step);
}

}  // namespace

void begin_ties(ContactStep& step) {
  if (step.deformation() == Deformation::frozen) return;
  step.ties = gather_ties(step.memory, paths_of(step));
  for (const TiePair& pair : step.ties) step.tied.push_back(contact_of(pair));
  if (step.ties.empty()) return;
  if (!step.is_wave()) {
    step.tied_rows = step.ties.size();
    step.contacts = step.tied;
    return;
  }
  for (std::size_t k = 0; k < step.ties.size(); ++k) {
    step.tied[k].impulse = last_impulse(step, step.tied[k]);
    strike_pair(step, step.ties[k], step.tied[k].impulse);
  }
}

void hold_ties(ContactStep& step, bool is_first) {
  if (step.ties.empty() || !step.is_wave()) return;
  const int most = is_first ? 100 : 20;
  std::vector<Constraint> rows = measured(step);
  std::vector<Vec3> ends;
  const StepPaths paths = paths_of(step);
  for (const TiePair& pair : step.ties) ends.push_back(opening_at_end(pair, paths));
  const TieOutcome outcome = solve_ties(rows, step.ties, ends, step.pass, tie_tolerance, most);
  step.tie_iterations += outcome.iterations;
  step.tie_residual = outcome.residual;
  take_impulses(step, rows);
}

TieReport finish_ties(ContactStep& step) {
  for (std::size_t k = 0; k < step.tied_rows; ++k) step.tied[k].impulse = step.contacts[k].impulse;
  step.contacts.erase(step.contacts.begin(),
                      step.contacts.begin() + static_cast<std::ptrdiff_t>(step.tied_rows));
  step.tied_rows = 0;
  std::vector<Vec3> impulses;
  for (const ContactPoint& tied : step.tied) impulses.push_back(tied.impulse);
  TieReport report = settle_ties(step.ties, impulses, paths_of(step));
  report.iterations = step.tie_iterations;
  report.residual = step.tie_residual;
  return report;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The report of a run: counts, step times, ledgers and warnings, as report.json has them.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/output/fragment.hpp"
#include "apps/sunder/run/report/run_warnings.hpp"
#include "apps/sunder/run/report/tie_report.hpp"
#include "apps/sunder/run/report/time_sample.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// How a run ended; or it goes on.
enum class RunEnd { finished, interrupted, failed, running };

/// The energies of a state, J.
struct Energies {
  double kinetic = 0, strain = 0, gravity = 0;
};

/// Everything that is added up over a run.
struct RunStatistics {
  /// Wall time of every step and of its stages, ms.
  TimeSample step_ms;
  std::array<TimeSample, stage_names.size()> stage_ms;
  std::size_t fans = 0, faces_split = 0;
  /// The reports of the steps, added up (`counters_of`).
  SearchCounts search;
  ContactReport contact;
  ImpactReport impact;
  LadderReport ladder;
  RubbleStepReport rubble;
  SolveReport solve;
  EnergyLedger energy;
  TieStatistics ties;
  /// Steps with contact, with contact that did not converge, with sub-steps, and those that reached
  /// `ImpactSettings::max_sub_steps`.
  std::size_t contact_steps = 0, unconverged_steps = 0, impact_steps = 0, stopped_steps = 0;
  /// Of contact that did not converge: the worst gap error, m, the error tolerated in that step, m,
  /// the error of a force, N, and the step.
  double worst_residual = 0, tolerated = 0, force_error = 0;
  std::uint64_t worst_step = 0;
  /// Of an integrator's step, for any component.
  std::uint64_t most_iterations = 0;
  /// Of the oracle: fans that predicted a separation, those of them that had one, fans that had
  /// one.
  std::size_t predicted = 0, predicted_rightly = 0, separated = 0;
  /// Wall time of each fan from its plane to its components, us, without and with new ones; and the
  /// tetrahedra the searches for components met.
  std::array<TimeSample, 2> fan_us;
  std::size_t searched = 0;
  /// J.
  double damping_work = 0, energy_released = 0;
  std::vector<CrackEnergy> cracks;
  Energies energy_at_start;
  /// Of everything that moves (bodies and free balls) at the start, and the impulses since.
  Impulse momentum_at_start = Impulse::Zero();
  MomentumLedger momentum;
  /// kg.
  double mass_at_start = 0;
  /// m: farthest that a point of a piece was drawn from where section 3.3's target has it, and
  /// when.
  double drawn_off = 0;
  std::uint64_t drawn_off_step = 0;
  std::vector<Finding> warnings;  ///< of the scene, and of the model where it was left
  RunTroubles troubles;
  /// Whether the small-displacement model was left once (docs/explanation/theory.md, Limits).
  bool turned_too_far = false;
};

/// The statistics of a run that stands at its start; `warnings` are those of building it.
RunStatistics begin_statistics(const Simulation& start, std::vector<Finding> warnings);

/// Adds one step. `step_ms`: its wall time.
void add_step(RunStatistics& statistics, const Simulation& now, const StepReport& report,
              double step_ms);

/// The warnings of a run after its start, in the order of its report.
std::vector<Finding> warnings_on_the_way(const RunStatistics& statistics, const Scene& scene);

/// Everything that a run warns of, from its scene on.
std::vector<Finding> all_warnings(const RunStatistics& statistics, const Scene& scene);

/// A failure that `advance` reports, as a finding with step, vertex, value and remedy; nothing when
/// the step is fine.
std::optional<Finding> step_failure(const StepReport& report, const Simulation& now);

/// report.json of a run, keys as docs/reference/scene.md has them. `pieces`: as `fragments` gives
/// them at the end.
nlohmann::ordered_json run_report(const RunStatistics& statistics, const Simulation& now,
                                  std::span<const Fragment> pieces, RunEnd end);

/// A few lines for people: steps, mean and largest step, fans, pieces, largest piece, mass error.
std::string summary_table(const nlohmann::ordered_json& report);

}  // namespace sunder

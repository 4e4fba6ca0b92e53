// SPDX-License-Identifier: MIT
// What a run tells about itself: counts, step times, ledgers and warnings, as report.json has them.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/output/fragment.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// How a run ended.
enum class RunEnd { finished, interrupted, failed };

/// The energies of a state, J.
struct Energies {
  double kinetic = 0, strain = 0, gravity = 0;
};

/// Momentum of everything that moves (bodies and free balls) and what it was given from outside,
/// kg m/s: impulses of gravity, of surface loads and of obstacles without mass.
struct MomentumLedger {
  Vec3 start = Vec3::Zero(), gravity = Vec3::Zero(), loads = Vec3::Zero(), obstacles = Vec3::Zero();
};

/// How contact went over a run.
struct ContactStatistics {
  std::size_t steps = 0, not_converged = 0, left_out = 0;
  std::uint32_t most = 0;
  /// m.
  double deepest = 0, worst_residual = 0;
  std::uint64_t worst_step = 0;
};

/// What impact windows did over a run.
struct ImpactStatistics {
  std::size_t steps = 0, opened = 0, sub_steps = 0, stopped_steps = 0;
  std::uint32_t most_components = 0;
  /// s, simulated.
  double time = 0;
  double coarseness = 0;
};

/// How many components and tetrahedra took steps on each rung, over a run.
struct LadderStatistics {
  std::array<std::size_t, rung_count> components{}, tetrahedra{};
};

/// How iterations of integrators went over a run; nothing of those that have none.
struct SolveStatistics {
  /// The most of any component in each step.
  std::uint64_t iterations = 0, most_iterations = 0;
  std::uint64_t force_evaluations = 0, sub_steps = 0;
  /// Steps in which a component's iterations were given up.
  std::size_t not_converged = 0;
};

/// Everything that is added up over a run.
struct RunStatistics {
  /// Wall time of every step and of its stages, ms.
  std::vector<float> step_ms;
  std::array<std::vector<float>, stage_names.size()> stage_ms;
  std::size_t fans = 0, faces_split = 0;
  /// Of Gershgorin's bound and of vertices that were over their threshold.
  std::size_t tested = 0, suspects = 0, reached = 0, empty_fans = 0, relieved = 0;
  /// Vertices that still wait with an empty fan, and most that the node stress `fit` did not fit.
  std::size_t still_empty = 0, unfitted = 0;
  std::size_t refused_fans = 0;
  /// Left over by the last step's budget.
  std::size_t waiting = 0;
  /// Of the oracle: fans that predicted a separation, those of them that had one, fans that had
  /// one.
  std::size_t predicted = 0, predicted_rightly = 0, separated = 0;
  /// Wall time of each fan from its plane to its components, us, without and with new ones; and the
  /// tetrahedra the searches for components met.
  std::array<std::vector<float>, 2> fan_us;
  std::size_t searched = 0;
  /// J.
  double damping_work = 0, energy_released = 0;
  double gravity_work = 0, load_work = 0, contact_work = 0, support_work = 0, friction = 0;
  double numerical_loss = 0, residual = 0, residual_size = 0, moved = 0;
  std::vector<CrackEnergy> cracks;
  Energies energy_at_start;
  MomentumLedger momentum;
  ContactStatistics contact;
  ImpactStatistics impact;
  LadderStatistics ladder;
  SolveStatistics solve;
  /// kg.
  double mass_at_start = 0;
  std::vector<Finding> warnings;
  /// Whether the small-displacement model was left once (docs/decisions.md, Validity).
  bool turned_too_far = false;
};

/// The statistics of a run that stands at its start; `warnings` are what building it found.
RunStatistics begin_statistics(const Simulation& start, std::vector<Finding> warnings);

/// Adds one step. `step_ms`: its wall time.
void add_step(RunStatistics& statistics, const Simulation& now, const StepReport& report,
              double step_ms);

/// What `advance` reports as a failure, as a finding with step, vertex, value and remedy; nothing
/// when the step is fine.
std::optional<Finding> step_failure(const StepReport& report, const Simulation& now);

/// report.json of a run, keys as docs/scene.md has them. `pieces`: as `fragments` gives them at the end.
nlohmann::ordered_json run_report(const RunStatistics& statistics, const Simulation& now,
                                  std::span<const Fragment> pieces, RunEnd end);

/// A few lines for people: steps, mean and largest step, fans, pieces, largest piece, mass error.
std::string summary_table(const nlohmann::ordered_json& report);

}  // namespace sunder

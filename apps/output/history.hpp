// SPDX-License-Identifier: MIT
// history.csv: energies, works, forces and counts of a run, a row for each interval. No file is
// written here.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Of what happened since the row before, and of what adds up over the run.
struct HistorySums {
  double since = 0;                     ///< s, time of the row before
  std::vector<Impulse> obstacle, held;  ///< since then, as `ForceReport`
  double gap_error = 0, overlap = 0;    ///< m, largest since then
  std::vector<double> load_work;        ///< J, over the run
  double released = 0, taken = 0;       ///< J, of cracks, over the run
};

/// The rows of a run so far. Plain data, for checkpoints.
struct History {
  static constexpr std::uint64_t no_step = std::numeric_limits<std::uint64_t>::max();
  HistorySums sums;
  std::vector<double> values;        ///< row by row
  std::uint64_t last_row = no_step;  ///< step of the last row
};

/// What the columns of a row are taken from.
struct HistoryMoment {
  const Simulation& simulation;
  const HistorySums& sums;
  std::array<double, 3> energy{};  ///< J: kinetic, elastic, potential
  std::size_t pieces = 0;
  double largest_mass = 0, asleep_mass = 0;  ///< kg
  double interval = 0;                       ///< s
};

/// A column: its name in the first line, its unit and a sentence for readers, its value in a row.
struct HistoryColumn {
  std::string name, unit, text;
  std::function<double(const HistoryMoment&)> value;
};

/// The columns of a scene's history, in their order: the one list of them.
std::vector<HistoryColumn> history_columns(const Scene& scene);

/// A history whose first row is now, with forces of 0.
History begin_history(const Simulation& start);

/// Adds what a step did. O(obstacles + held boxes + loads).
void add_step(History& history, const StepReport& report);

/// Adds a row of now. Forces are means over the time since the row before. O(tetrahedra).
void add_row(History& history, const Simulation& now);

/// The table as CSV (RFC 4180, one header line, SI units, numbers that read back exactly).
std::string history_csv(const History& history, const Scene& scene);

/// Steps between rows where the scene names no interval: 1, or the least that makes 2 000 rows with
/// start and end.
std::uint64_t usual_history_stride(std::uint64_t steps);

}  // namespace sunder

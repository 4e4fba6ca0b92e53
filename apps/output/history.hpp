// SPDX-License-Identifier: MIT
// history.csv: energies, works, forces and counts of a run, one row per interval. No file is
// written here. `history_columns` in output_columns.hpp lists the columns.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Sums over the steps of a run. Rows of forces and works are those of `ForceReport`.
struct HistorySums {
  double since = 0;                     ///< s, time of the last row
  std::vector<Impulse> obstacle, held;  ///< since the last row
  double gap_error = 0, overlap = 0;    ///< m, largest since the last row
  std::vector<double> load_work;        ///< J, since the first row
  double released = 0, taken = 0;       ///< J, of cracks, since the first row
};

/// The rows of a run so far. Plain data, for checkpoints.
struct History {
  static constexpr std::uint64_t no_step = std::numeric_limits<std::uint64_t>::max();
  HistorySums sums;
  /// m, world: the points about which moments are, by obstacles and by held boxes.
  std::vector<Vec3> obstacle_centre, held_centre;
  std::vector<double> values;        ///< row by row
  std::uint64_t last_row = no_step;  ///< step of the last row
};

/// A history with the present state as its first row, with forces of 0.
History begin_history(const Simulation& start);

/// Adds the forces, works and overlaps of one step. O(obstacles + held boxes + loads). Needs:
/// `Simulation::reports_forces`.
void add_step(History& history, const StepReport& report);

/// Adds a row of the present state. Forces are means over the time since the last row.
/// O(tetrahedra).
void add_row(History& history, const Simulation& now);

/// The table as CSV (RFC 4180, one header line, SI units, numbers that read back exactly).
std::string history_csv(const History& history, const Scene& scene);

/// Steps between rows where the scene names no interval: the least number that gives at most
/// 2 000 rows with start and end.
std::uint64_t usual_history_stride(std::uint64_t steps);

}  // namespace sunder

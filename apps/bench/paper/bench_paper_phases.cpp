// SPDX-License-Identifier: MIT
// Phases of fracturing, and the largest step's place in them.
#include "apps/bench/paper/bench_paper_phases.hpp"

#include <algorithm>
#include <vector>

namespace sunder {

FracturePhases fracture_phases(std::span<const double> step_ms,
                               std::span<const std::uint32_t> step_fans) {
  FracturePhases result;
  if (step_ms.empty()) return result;
  const auto largest = std::ranges::max_element(step_ms);
  const auto row_of_max = static_cast<std::size_t>(largest - step_ms.begin());
  result.max_step = row_of_max + 1;
  result.max_breaks = step_fans[row_of_max] > 0;
  result.later_near_max = static_cast<std::size_t>(
      std::count_if(largest + 1, step_ms.end(), [&](double ms) { return ms > 0.9 * *largest; }));
  std::vector<std::vector<std::size_t>> phases;
  for (std::size_t row = 0; row < step_fans.size(); ++row) {
    if (step_fans[row] == 0) continue;
    ++result.breaking_steps;
    if (phases.empty() || row - phases.back().back() > phase_gap) phases.emplace_back();
    phases.back().push_back(row);
  }
  result.phases = phases.size();
  if (phases.empty()) return result;
  result.first_break = phases.front().front() + 1;
  for (const std::vector<std::size_t>& phase : phases) {
    if (phase.front() > row_of_max) break;
    result.phase_length = phase.size();
    result.max_in_phase =
        static_cast<std::size_t>(std::ranges::upper_bound(phase, row_of_max) - phase.begin());
  }
  return result;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Where in a run the largest step lies: the paper says, at the beginning of a fracturing phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sunder {

/// A phase of fracturing: steps with fans, parted where at least `phase_gap` steps in a row have
/// none.
inline constexpr std::size_t phase_gap = 10;

/// Steps count from 1.
struct FracturePhases {
  std::size_t phases = 0, breaking_steps = 0, first_break = 0;
  std::size_t max_step = 0;  ///< with the largest time of all
  bool max_breaks = false;   ///< whether it has a fan
  /// Place of it among the steps with fans of its phase, from 1, or how many of them were before
  /// it; and how many steps with fans that phase has. 0: before the first phase.
  std::size_t max_in_phase = 0, phase_length = 0;
  /// Later steps, anywhere in the run, with more than nine tenths of the largest time.
  std::size_t later_near_max = 0;
};

/// Needs: rows of the same steps.
FracturePhases fracture_phases(std::span<const double> step_ms,
                               std::span<const std::uint32_t> step_fans);

}  // namespace sunder

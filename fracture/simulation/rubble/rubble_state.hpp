// SPDX-License-Identifier: MIT
// The memory of the rung `rubble` from step to step.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/rubble/rubble.hpp"

namespace sunder {

/// Saved with the simulation.
struct RubbleState {
  RubbleMemory memory;
  /// Rows = ComponentId, obstacles: stepped only on the clock of the rubble until the tick ends.
  /// Empty: none.
  std::vector<char> apart, ball_apart;
  /// J, row = ComponentId: energy that contact took from its islands since it has been on the rung.
  /// Rigid bodies lose it; the real pieces could have kept it as deformation.
  std::vector<double> spent;
};

/// The clock of the rubble: a tick is so many steps, or a step so many ticks; one of the two is 1.
struct RubbleClock {
  std::uint64_t steps = 1, ticks = 1;
  double tick = 0;  ///< s
};

/// The multiple or fraction of the scene's step (s) that is nearest to 1/240 s.
RubbleClock rubble_clock(double time_step);

}  // namespace sunder

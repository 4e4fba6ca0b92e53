// SPDX-License-Identifier: MIT
// The rung `rubble` in a step: at the start of a tick its pieces take all of it.
#pragma once

#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"
#include "fracture/simulation/step_report.hpp"

namespace sunder {

/// Makes rigid bodies of pieces that never break by somebody's word (`turn_pieces_rigid`), be rubble
/// on or off. Where a tick begins with the step at hand: chooses who is rubble (`choose_rubble`), and takes
/// them through the whole tick with their contacts; whoever was rubble and is not goes to `full`.
/// Until the tick ends their rows are those of its end, and nothing else moves them
/// (`RubbleState::apart`). What it did with energy and momentum is added to the report.
void begin_rubble(StepReport& report, Simulation& sim);

}  // namespace sunder

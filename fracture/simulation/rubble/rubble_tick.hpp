// SPDX-License-Identifier: MIT
// The rung `rubble` in a step: at the start of a tick its pieces take all of it.
#pragma once

#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"
#include "fracture/simulation/step_report.hpp"

namespace sunder {

/// Makes rigid bodies of pieces that are declared never to break (`turn_pieces_rigid`), with rubble
/// on or off. If a tick begins with the present step, it chooses the rubble (`choose_rubble`) and
/// takes it through the whole tick with its contacts. Components that are no longer rubble go to
/// `full`. Until the tick ends the rows of rubble are those of its end, and nothing else moves them
/// (`RubbleState::apart`). Changes of energy and momentum are added to the report.
void begin_rubble(StepReport& report, Simulation& sim);

}  // namespace sunder

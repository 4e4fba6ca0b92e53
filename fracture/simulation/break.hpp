// SPDX-License-Identifier: MIT
// Which faces part at the end of a part of a step: algorithm 3, or a script in its place.
#pragma once

#include "fracture/simulation/state.hpp"

namespace sunder {

/// Looks for fractures among the members at the state as it is, or makes the fans that the script
/// has for `place`, and splits their faces. Masses, frames and components are then
/// `rebuild_pieces`' to bring up to date. After a fan of the script that cannot be made,
/// `state.script->departure` says so.
FractureReport break_members(SimulationState& state, const FractureSettings& settings,
                             SearchPlace place, const StepMembers& members,
                             FractureScratch& scratch, const FanWatch& watch = {});

}  // namespace sunder

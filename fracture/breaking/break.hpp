// SPDX-License-Identifier: MIT
// Which faces part at the end of a part of a step: algorithm 3, or a script in its place.
#pragma once

#include <optional>

#include "fracture/breaking/break_vertices.hpp"
#include "fracture/breaking/fan_script.hpp"

namespace sunder {

/// Looks for fractures among the members on the body as it is, or makes the fans that the script
/// has for `place`, and splits their faces. Masses, frames and components are then
/// `rebuild_pieces`' to bring up to date. After a fan of the script that cannot be made,
/// `script->departure` says so.
FractureReport break_members(BreakableBody body, std::optional<FanScript>& script,
                             const FractureSettings& settings, SearchPlace place,
                             const StepMembers& members, FractureScratch& scratch, double untested,
                             const FanWatch& watch = {});

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Whether pieces have turned further against their references than the linear model is good for.
#pragma once

#include <optional>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Code of the warning of `check_turns`.
inline constexpr const char* turned_too_far = "turned_too_far";

/// The warning of a step, about the first component of which more than a twentieth by volume has
/// turned so far that the false strain is over half of the breaking strain. O(1) per component,
/// O(n) for one that has.
std::optional<Finding> check_turns(const Simulation& simulation, const StepReport& report);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// How long compression waves travel: through a cell, and through a component.
#pragma once

#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// s, the time of a compression wave's way through a cell of mean size: the mean of (6 V)^(1/3) /
/// c.
double cell_travel(const MechanicsState& state, const Component& component);

/// L/c of a component, s.
double extent_travel(const MechanicsState& state, const Component& component);

}  // namespace sunder

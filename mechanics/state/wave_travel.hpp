// SPDX-License-Identifier: MIT
// How long compression waves travel: through a cell, and through a component.
#pragma once

#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// s: `Component::cell_travel`. O(tetrahedra).
double mean_cell_travel(const MechanicsState& state, const Component& component);

/// m: a compression wave's way in `Component::cell_travel`. Needs: tetrahedra.
double mean_cell(const MechanicsState& state, const Component& component);

/// L/c of a component, s.
double extent_travel(const MechanicsState& state, const Component& component);

}  // namespace sunder

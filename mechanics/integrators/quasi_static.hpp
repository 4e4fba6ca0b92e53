// SPDX-License-Identifier: MIT
// Equilibrium in place of motion, for supported components under loads that change slowly.
#pragma once

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// The displacement at the end of the step is the static solution to the loads, K d = R^T f with
/// held vertices where they are then; its rate is the mean one of the step, accelerations are none.
/// Needs `step.system` factored with `quasi_static_matrix`. One back-solve.
void step_quasi_static(const ComponentStep& step);

/// A = K.
constexpr SystemMatrix quasi_static_matrix() { return {0, 1}; }

}  // namespace sunder

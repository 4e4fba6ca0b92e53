// SPDX-License-Identifier: MIT
// Explicit velocity Verlet on the conservative force: the independent twin, and small stiff pieces.
#pragma once

#include <span>

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// v += h a / 2, x += h v, v += h a(x) / 2: second order, symplectic. Momenta are kept to rounding,
/// as the conservative force has no net torque. Stable below 2 / (highest angular frequency) only.
/// Two passes over the tetrahedra. No damping.
void step_verlet(const ComponentStep& step);

/// A step that is surely stable, s: the least over elements of 2 / sqrt(lambda_max(M_e^-1 K_e)),
/// M_e = a quarter of the element's mass at each corner; 0.7 to 0.8 of the true limit. Infinite for
/// no elements. O(|T|) with a 12 x 12 eigenvalue each.
double explicit_step_bound(const MechanicsState& state);

}  // namespace sunder

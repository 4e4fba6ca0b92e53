// SPDX-License-Identifier: MIT
// Implicit Euler by Broyden's method: the paper's own choice, and the same from a better start.
#pragma once

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// Solves M (y - v - h g) - h (f + f_el(x + h y)) = 0 for the velocities y at the end of the step,
/// x += h y - h^2 g / 2 (free fall is the parabola), by
///   B+ = B + F+ s^T / (s^T s)
/// in its limited-memory form that keeps the steps s only (Sherman and Morrison). This is our
/// reconstruction of the scheme of Hilde, Meseure and Chaillou 2001, which the paper names; their
/// text was not available. With B0 = M (`BroydenStart::mass`) it needs hundreds of evaluations at
/// twice the explicit step and diverges from about three on. With the factor it takes two to five.
/// It ends at `tolerance` and restarts after `broyden_memory` updates. The factor takes the step,
/// and the report says so, at `max_iterations`, or when the residual has grown by 1e12. The same
/// holds at a root that is not the step's (`is_nearest_root`). Momentum is exact at any tolerance.
/// Costs an evaluation of forces per iteration. No damping.
void step_broyden(const ComponentStep& step);

}  // namespace sunder

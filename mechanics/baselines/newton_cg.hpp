// SPDX-License-Identifier: MIT
// Implicit Euler by Newton's method, its linear systems by conjugate gradients.
#pragma once

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// Solves the equation of `step_broyden` by Newton's method with the matrix M + h^2 R K R^T. K is
/// of the component in its frame, or of every element in its own. Each system is solved by
/// conjugate gradients with the inverse of its 3 x 3 diagonal blocks as preconditioner [Baraff and
/// Witkin 1998].
/// The rigid part of a step is solved apart and exactly, so that gravity and momentum do not depend
/// on the end of the iterations. `tolerance` is that of the step's residual. The iterations of
/// conjugate gradients grow with h times the highest frequency (some 270 at 30 GPa, 1 ms, 6 000
/// tetrahedra). At `max_iterations` of them, or at a root that is not the step's
/// (`is_nearest_root`), the factor takes the step and the report says so. No damping.
void step_newton_cg(const ComponentStep& step);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The default integrator: rigid motion apart, displacement in the body frame by generalised-alpha.
#pragma once

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// One step of a component with x = c + R (r0 + d), v = P/M + R (w x q + d'), q = r0 + d:
///  - rigid part: `advance_centre` and `turn_through_step`; P and L are exact;
///  - deformation: M d'' + C d' + K d = b by generalised-alpha on the constant factor, with
///    b = R^T f - m [w x (w x q) + 2 w x d' + w' x d] at the time where the scheme balances forces,
///    freed of its rigid part, so that sum m d = 0 and sum m r0 x d = 0 stay true;
///  - rounding that gathers in d goes into the frame (x unchanged), that in d' into w.
/// Supported components: the frame moves with its support, held vertices keep their motion,
/// b = R^T f, nothing is projected.
/// One solve and one product with K (one more with damping). Isolated tetrahedra are not for it.
void step_floating_frame(const ComponentStep& step);

}  // namespace sunder

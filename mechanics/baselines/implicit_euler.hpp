// SPDX-License-Identifier: MIT
// The paper's baseline: implicit Euler, linearised once a step in the rigid reference.
#pragma once

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// (M + h C + h^2 K) dv = h R^T f - h K (d + h v) - h C v in the body frame,
/// x += h (v + dv) - h^2 g / 2 (free fall is the parabola) [Baraff and Witkin 1998], with the
/// constant factor, and C on the deformation only. The frame is that of x_n, or of x_n + h v_n
/// (`EulerFrame`). Known faults, kept as the baseline's: false stress E (h w)^2 / (2 (1 - nu)) in
/// the one frame, loss of spin w0 / sqrt(1 + 2 h w0^2 t) in the other, damping of every
/// oscillation. The force is the paper's: the term that makes it conservative would enter
/// explicitly, as the factor cannot hold it, and measured, it diverges at 30 GPa, 1 ms, 50 rad/s.
/// So L is kept to 1e-3 only. One solve and one product with K. Supported components use their own
/// frame.
void step_implicit_euler(const ComponentStep& step);

}  // namespace sunder

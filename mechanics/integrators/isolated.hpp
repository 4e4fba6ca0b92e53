// SPDX-License-Identifier: MIT
// Isolated tetrahedra in the paper's two ways (section 3.2), to compare with a true rigid body.
#pragma once

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// Vertices fly alone, x* = x + h v, and are put on the rigid shape that fits them best;
/// v = (x - x_old) / h [van Overveld and Barenbrug 1995]. Momentum is exact; a turn of phi a step
/// becomes atan(sin phi / (2 - cos phi)), about phi - phi^3: spin decays as
/// w0 / sqrt(1 + 2 h w0^2 t), and with h w0 = 0.5 half of it is gone in five steps.
void step_projected(const ComponentStep& step);

/// An elastic tetrahedron in the frame of its edges [Nesme, Payan and Faure 2005]: e1 along the
/// first, e3 normal to the first face, always the same vertices; linearised implicit Euler in that
/// frame at x + h v. Well defined through inversion of the fourth vertex. Keeps momentum; spin
/// decays as implicit Euler's does, by the law above for stiff tetrahedra. A 12 x 12 solve.
void step_edge_framed(const ComponentStep& step);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Equilibrium of supported components under constant loads: the static limit of every integrator.
#pragma once

#include <span>
#include <vector>

#include "mechanics/integrators/scratch.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Puts every active component into equilibrium in its frame: K d = R^T (m g + f) with held
/// vertices where they are. Velocities become those of the frame, element stress follows. The limit
/// of a damped run with these loads.
/// Errors, and then nothing changes: "not_supported" for each component that its held vertices do
/// not fix (fewer than three, or on one line). "not_a_number" for loads that are not finite. Leaves
/// factors of K in the state; the next step factors again. Cost: one factor and one solve.
std::vector<Finding> solve_static(MechanicsState& state, MechanicsScratch& scratch,
                                  std::span<const Corners> corners, const Loads& loads);

/// K d - (m g + f) of every vertex in the world, N, |V| rows. At held vertices it is the force with
/// which the support pushes the body, at free ones the error of the equilibrium (rounding after
/// `solve_static`). `loads`: those of that call. O(|T|), plus the systems that are not built yet.
std::vector<Vec3> support_forces(MechanicsScratch& scratch, MechanicsState& state,
                                 std::span<const Corners> corners, const Loads& loads);

}  // namespace sunder

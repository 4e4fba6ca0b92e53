// SPDX-License-Identifier: MIT
// Explicit velocity Verlet on the conservative force: the independent twin, and small stiff pieces.
#pragma once

#include <cstdint>
#include <span>

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// v += h a / 2, x += h v, v += h a(x) / 2: second order, symplectic; `count` times with h / count.
/// Momenta are kept to rounding, as the conservative force has no net torque. Stable below
/// 2 / (highest angular frequency) only. One pass over the tetrahedra each and one more.
/// Of damping `stiffness_factor` alone, by `viscous_forces` at the velocities before each a: one
/// more pass, momenta kept too, stable below `damped_step_bound`.
void step_verlet(const ComponentStep& step, std::uint32_t count = 1);

/// `step_verlet` with the least count that keeps sub-steps below nine tenths of the component's
/// bound. Where that is more than `max_sub_steps` nothing moves, and the report has the count.
void step_sub_stepped(const ComponentStep& step);

/// Least count of equal parts of `length` (s) below nine tenths of `bound` (s). At most some four
/// thousand million.
std::uint32_t sub_step_count(double length, double bound);

/// The longest stable step, s, with damping of b (`stiffness_factor`, s) where it is B (`bound`)
/// without: sqrt(B^2 + b^2) - b, as the damping acts by the velocity of half a step before.
double damped_step_bound(double bound, double stiffness_factor);

/// The least value of `explicit_step_bound` over the elements of a component, with the damping of
/// the settings; elements are measured once and kept in `scratch`.
double component_step_bound(MechanicsScratch& scratch, const MechanicsState& state,
                            const Component& component, const RayleighDamping& damping);

/// A step that is surely stable without damping, s: the least over elements of
/// 2 / sqrt(lambda_max(M_e^-1 K_e)), M_e = a quarter of the element's mass at each corner (of
/// second order `node_share`); 0.7 to 0.8 of the true limit. Infinite for no elements. O(|T|) with
/// an eigenvalue of 12 x 12 (30 x 30) each.
double explicit_step_bound(const MechanicsState& state);

}  // namespace sunder

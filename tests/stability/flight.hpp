// SPDX-License-Identifier: MIT
// A free block in flight, judged by its vertices: the one measure behind matrix and sweep.
#pragma once

#include "mechanics/state/mechanics_state.hpp"
#include "tests/stability/cell.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/second_order.hpp"

namespace sunder::stability {

/// The flying body and its time of flight.
struct Flight {
  Material material;
  double time_step = 1e-3;
  int steps = 200;
  Vec3 spin = Vec3(1, 2, 1);  ///< rad/s
  double deformation = 1e-4;  ///< of its radius, a smooth field; 0: begins in its equilibrium
  double sliver_angle = 90;   ///< degrees, the least dihedral angle of one tetrahedron
  bool weight = true;
};

/// The block of 1 x 0.5 x 0.5 m in 3 x 2 x 2 cells; one vertex moved so that a tetrahedron at it
/// has that dihedral angle (degrees).
test::Body flight_body(double sliver_angle = 90);

/// Angular frequency of the stiffest mode, rad/s, from the dense K of the elements: an explicit
/// scheme is stable up to a step of 2 over this, exactly.
double highest_frequency(const MechanicsState& state, const test::Body& body);

/// Flies it. Figure: the gain of energy over its start's (gains), the rest of the spin (loses), the
/// largest element stress over the largest by spin and deformation (false stress), or how far the
/// mass centre is from its parabola, relative (holds).
Cell fly(const Flight& flight, const Method& method);

/// The rigid part of a body's motion, recomputed from its vertices.
struct Rigid {
  double mass = 0;
  Vec3 centre = Vec3::Zero(), momentum = Vec3::Zero(), spin = Vec3::Zero();  ///< spin: L about it
  double energy = 0;  ///< J, of a rigid body with these momenta
};

Rigid rigid_of(const MechanicsState& state);

/// Largest eigenvalue of any element stress, Pa.
double largest_stress(const MechanicsState& state);

}  // namespace sunder::stability

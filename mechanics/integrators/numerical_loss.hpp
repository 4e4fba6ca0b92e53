// SPDX-License-Identifier: MIT
// Energy that the time schemes take from a component in one step, in closed form.
#pragma once

#include <span>

#include "mechanics/solver/component_system.hpp"
#include "mechanics/state/settings/settings.hpp"

namespace sunder {

/// Displacements (m), their rates (m/s) and accelerations (m/s^2) of all vertices in the body
/// frame, |V| rows.
struct DeformationRows {
  std::span<const Vec3> displacement, rate, acceleration;
};

/// A step of a component's deformation: rows before and after it, and Dd . K Dd (J,
/// `StrainChange::difference`), D: after - before.
struct DeformationStep {
  DeformationRows before, after;
  double stiffness_difference = 0;
  /// m, body frame: the part of the displacements that the frame took over, where a body slides
  /// far.
  Vec3 shift = Vec3::Zero();
};

/// J lost in one step of `settings.time_step` with `settings.rho_infinity` (as the component took
/// it). With M a + K d = F balanced at alpha_m, alpha_f and Newmark's relations,
///   dT + dU = F . Dd - loss,
///   loss = (1/2 - alpha_f) (Dd.K Dd + Dd.M Da)
///          + h^2 (beta - gamma/2) (D(a.M a)/2 + (gamma - 1/2) Da.M Da).
/// May be negative in one step: the scheme lends energy to a . M a and takes it back. Exact for the
/// linear part; spin leaves terms of second order. O(vertices).
double numerical_loss(const ComponentSystem& system, const IntegratorSettings& settings,
                      const DeformationStep& step);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// What generalised-alpha takes from the energy of a deformation in one step, in closed form.
#pragma once

#include <span>
#include <vector>

#include "mechanics/component_system.hpp"
#include "mechanics/integrators/settings.hpp"

namespace sunder {

/// Displacements (m) and their accelerations (m/s^2) of all vertices in the body frame, |V| rows.
struct DeformationRows {
  std::span<const Vec3> displacement, acceleration;
};

/// J lost in one step of `settings.time_step` with `settings.rho_infinity` (as the component took
/// it), from the rows before and after it. With M a + K d = F balanced at alpha_m, alpha_f and
/// Newmark's relations,
///   dT + dU = F . Dd - loss,
///   loss = (1/2 - alpha_f) (Dd.K Dd + Dd.M Da)
///          + h^2 (beta - gamma/2) (D(a.M a)/2 + (gamma - 1/2) Da.M Da),   D: after - before.
/// May be negative in one step: the scheme lends energy to a . M a and takes it back. Exact for the
/// linear part without Rayleigh damping; spin and damping leave terms of second order.
/// `work`: anything; grows to 3 n. O(tetrahedra): one x . K x.
double numerical_loss(std::vector<double>& work, const ComponentSystem& system,
                      const IntegratorSettings& settings, const DeformationRows& before,
                      const DeformationRows& after);

}  // namespace sunder

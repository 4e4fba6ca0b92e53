// SPDX-License-Identifier: MIT
// The numbers of the time schemes: generalised-alpha, the system matrix, the response to an
// impulse.
#pragma once

#include "mechanics/solver/component_system.hpp"
#include "mechanics/state/settings/settings.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Chung and Hulbert 1993, second order, unconditionally stable:
/// alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1), gamma = 1/2 - alpha_m + alpha_f,
/// beta = (1 - alpha_m + alpha_f)^2 / 4. The balance of forces holds at (1 - alpha) new + alpha
/// old.
struct GeneralisedAlpha {
  double alpha_m, alpha_f, beta, gamma;
};
constexpr GeneralisedAlpha generalised_alpha(double rho_infinity) {
  const double alpha_m = (2 * rho_infinity - 1) / (rho_infinity + 1);
  const double alpha_f = rho_infinity / (rho_infinity + 1);
  const double width = 1 - alpha_m + alpha_f;
  return {alpha_m, alpha_f, width * width / 4, 0.5 - alpha_m + alpha_f};
}

/// The rho_infinity with which a component takes a step of `time_step`. It is the user's where the
/// step resolves its slowest axial mode (w h <= 0.3, w = pi c / L). It is 0 where it does not (w h
/// >= 3), and in between goes by the logarithm of w h. A load that comes suddenly then settles at
/// the static solution in long steps, for any value of the user: 0.5 would ring for five.
/// `extent_travel`: L/c, s.
double followed_rho(double rho_infinity, double time_step, double extent_travel);

/// A = mass M + stiffness K of the integrator, Rayleigh damping C = a M + b K included:
/// (1-alpha_m) M + (1-alpha_f) (gamma h C + beta h^2 K) for the unknown acceleration, or
/// M + h C + h^2 K for the change of velocity of implicit_euler. Verlet has none: M.
SystemMatrix system_matrix(const IntegratorSettings& settings);

/// Displacement at the end of a step for a unit change of momentum at its start, elastic part:
/// inverse A^-1 + mass M^-1 on deformations. From A da = -C dv - h (1-alpha_f) K dv and
/// dd = h dv + beta h^2 da, dv = M^-1 j, with K M^-1 written through A.
struct ImpulseCoefficients {
  double inverse = 0;  ///< s
  double mass = 0;     ///< s
};
ImpulseCoefficients impulse_coefficients(const IntegratorSettings& settings);

}  // namespace sunder

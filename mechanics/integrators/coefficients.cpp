// SPDX-License-Identifier: MIT
// The coefficients that follow from the settings.
#include "mechanics/integrators/coefficients.hpp"
#include "topology/base/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace sunder {

double followed_rho(double rho_infinity, double time_step, double extent_travel) {
  constexpr double resolved = 0.3, unresolved = 3;
  const double turn = M_PI * time_step / extent_travel;
  const double part = logarithm(unresolved / turn) / logarithm(unresolved / resolved);
  return rho_infinity * std::clamp(part, 0.0, 1.0);
}

SystemMatrix system_matrix(const IntegratorSettings& settings) {
  const double h = settings.time_step;
  const auto [a, b] = settings.damping;
  switch (equation_of(settings.integrator)) {
    case StepEquation::generalised_alpha: {
      const GeneralisedAlpha g = generalised_alpha(settings.rho_infinity);
      const double rate = (1 - g.alpha_f) * g.gamma * h;
      return {1 - g.alpha_m + rate * a, rate * b + (1 - g.alpha_f) * g.beta * h * h};
    }
    case StepEquation::implicit_euler:
      return {1 + h * a, h * b + h * h};
    case StepEquation::explicit_steps:
      break;
  }
  return {1, 0};
}

ImpulseCoefficients impulse_coefficients(const IntegratorSettings& settings) {
  const double h = settings.time_step;
  const auto [a, b] = settings.damping;
  switch (equation_of(settings.integrator)) {
    case StepEquation::generalised_alpha: {
      const GeneralisedAlpha g = generalised_alpha(settings.rho_infinity);
      const SystemMatrix A = system_matrix(settings);
      // A dd = h (1-alpha_m) j + excess C M^-1 j
      const double excess = h * h * ((1 - g.alpha_f) * g.gamma - g.beta);
      const double mass = excess * b / A.stiffness;
      return {h * (1 - g.alpha_m) + excess * a - mass * A.mass, mass};
    }
    case StepEquation::implicit_euler:
      return {h, 0};
    case StepEquation::explicit_steps:
      break;
  }
  return {0, h};
}

}  // namespace sunder

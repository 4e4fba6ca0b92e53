// SPDX-License-Identifier: MIT
// What a user chooses about time integration.
#pragma once

#include <string_view>
#include <vector>

#include "topology/finding.hpp"

namespace sunder {

enum class Integrator {
  floating_frame,  ///< rigid motion apart, displacement in the body frame; the default
  implicit_euler,  ///< the paper's baseline, linearised; damps, and kills spin
  verlet,          ///< explicit, symplectic; needs steps below `explicit_step_bound`
};

/// Which frame `implicit_euler` linearises in.
enum class EulerFrame {
  current,    ///< shape matching at x_n: false stress E (h w)^2 / (2 (1 - nu)) in a spinning body
  predicted,  ///< at x_n + h v_n: no false stress, but spin decays as w0 / sqrt(1 + 2 h w0^2 t)
};

/// Damping C = mass_factor M + stiffness_factor K, on the deformation only: rigid motion is free.
struct RayleighDamping {
  double mass_factor = 0;       ///< 1/s, >= 0
  double stiffness_factor = 0;  ///< s, >= 0
};

struct IntegratorSettings {
  double time_step =
      1e-3;  ///< h, s, > 0; may change from step to step at the price of a new factor
  Integrator integrator = Integrator::floating_frame;
  /// Of generalised-alpha, in [0, 0.5]: how much of an oscillation too fast for the step is left
  /// after one step. 0: a suddenly applied load gives the static answer at once, where 0.8 rings at
  /// 1.7 times of it for tens of steps and would break bodies that hold. Above 0.5 the Coriolis
  /// force, which is extrapolated, feeds what rings: measured, spinning bodies blow up from 0.8 on.
  /// A component takes it where the step resolves its slowest axial mode; towards longer steps it
  /// falls to 0 (`followed_rho`).
  double rho_infinity = 0;
  RayleighDamping damping = {};
  EulerFrame euler_frame = EulerFrame::current;
};

/// What is wrong with the settings: an error each, with value, range and remedy; `place` names
/// them.
std::vector<Finding> check(const IntegratorSettings& settings, std::string_view place);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// What a user chooses about time integration.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "topology/kernel/finding.hpp"

namespace sunder {

enum class Integrator {
  floating_frame,  ///< rigid motion apart, displacement in the body frame; the default
  implicit_euler,  ///< the paper's baseline, linearised; damps, and kills spin
  verlet,          ///< explicit, symplectic; needs steps below `explicit_step_bound`
  broyden,         ///< implicit Euler by Broyden's method, as the paper solves it
  newton_cg,       ///< implicit Euler by Newton's method with conjugate gradients
  sub_stepped,     ///< verlet, as many times a step as `explicit_step_bound` asks for
  modal,           ///< floating_frame with every mode exact, for small bodies
};

/// Those whose step is bounded by `explicit_step_bound`.
constexpr bool is_explicit(Integrator integrator) {
  return integrator == Integrator::verlet || integrator == Integrator::sub_stepped;
}

/// Those in a floating frame: rigid motion apart, with momenta of its own.
constexpr bool is_floating(Integrator integrator) {
  return integrator == Integrator::floating_frame || integrator == Integrator::modal;
}

/// What resists deformation.
enum class ElasticModel {
  rigid_reference,  ///< linear in the frame of the component (the paper's; algorithm 1)
  corotational,     ///< linear in a frame of each tetrahedron's own (what the paper compares with)
};

enum class ElasticForce {
  /// -dE/dx of E = d^T K d / 2 with the rotation's own change: net force and torque are zero.
  conservative,
  /// The paper's -R K d: leaves a net torque sum d x K d, second order in the displacement.
  paper,
};

/// Where Broyden's method begins: its first guess of the Jacobian.
enum class BroydenStart {
  mass,    ///< M (the paper's): no factor, but diverges beyond some three explicit steps
  factor,  ///< the factor of M + h^2 K
};

/// What a free single tetrahedron is (section 3.2 of the paper).
enum class IsolatedTetrahedra {
  rigid,       ///< a true rigid body, which keeps its spin
  projection,  ///< four points put back on the rigid shape every step: loses spin
  qr,          ///< elastic, in the frame of its edges, by implicit Euler: loses spin
};

/// How `implicit_euler` solves with corotational forces.
enum class CorotationalSolve {
  reassembled,  ///< M + h^2 sum R K R^T assembled and factored every step
  prefactored,  ///< M + h^2 K at rest, factored once; what differs from it is iterated
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
  ElasticModel model = ElasticModel::rigid_reference;
  /// Of the model rigid_reference in broyden, newton_cg, verlet and sub_stepped.
  ElasticForce elastic_force = ElasticForce::conservative;
  BroydenStart broyden_start = BroydenStart::mass;
  CorotationalSolve corotational_solve = CorotationalSolve::reassembled;
  /// Of iterations (broyden, newton_cg, prefactored): the residual of the step's equation that is
  /// good enough, over the one they begin with; in (0, 0.1].
  double tolerance = 1e-6;
  /// At so many iterations a component's step is given up and taken by the factor instead, which
  /// the report says; of newton_cg those of conjugate gradients.
  std::uint32_t max_iterations = 1000;
  /// Updates that Broyden's method keeps before it begins anew, >= 1.
  std::uint32_t broyden_memory = 200;
  /// Of sub_stepped: sub-steps that a step may take.
  std::uint32_t max_sub_steps = 10000;
  IsolatedTetrahedra isolated = IsolatedTetrahedra::rigid;
};

/// What is wrong with the settings: an error each, with value, range and remedy; `place` names
/// them.
std::vector<Finding> check(const IntegratorSettings& settings, std::string_view place);

}  // namespace sunder

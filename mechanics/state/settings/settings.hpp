// SPDX-License-Identifier: MIT
// Settings of time integration.
#pragma once

#include <cstdint>

namespace sunder {

enum class Integrator {
  floating_frame,  ///< rigid motion and displacement in the body frame, separately; the default
  implicit_euler,  ///< the paper's baseline, linearised; damps, and loses spin
  verlet,          ///< explicit, symplectic; needs steps below `explicit_step_bound`
  broyden,         ///< implicit Euler by Broyden's method, as the paper solves it
  newton_cg,       ///< implicit Euler by Newton's method with conjugate gradients
  sub_stepped,     ///< verlet, with the sub-steps that `explicit_step_bound` needs
  modal,           ///< floating_frame with every mode exact, for small bodies
};

/// The equation of motion that an integrator solves; its coefficients follow (coefficients.hpp).
enum class StepEquation {
  generalised_alpha,  ///< of the deformation in the body frame
  implicit_euler,     ///< of positions and velocities
  explicit_steps,     ///< none: forces at known positions
};

/// The equation of each integrator.
constexpr StepEquation equation_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::floating_frame:
    case Integrator::modal:
      return StepEquation::generalised_alpha;
    case Integrator::implicit_euler:
    case Integrator::broyden:
    case Integrator::newton_cg:
      return StepEquation::implicit_euler;
    case Integrator::verlet:
    case Integrator::sub_stepped:
      break;
  }
  return StepEquation::explicit_steps;
}

/// True if `explicit_step_bound` limits the step.
constexpr bool is_explicit(Integrator integrator) {
  return equation_of(integrator) == StepEquation::explicit_steps;
}

/// True if rigid motion is integrated separately, with momenta of its own.
constexpr bool is_floating(Integrator integrator) {
  return equation_of(integrator) == StepEquation::generalised_alpha;
}

/// The elastic model.
enum class ElasticModel {
  rigid_reference,  ///< linear in the frame of the component (the paper's; algorithm 1)
  corotational,     ///< linear in a frame per tetrahedron (the paper's comparison)
};

enum class ElasticForce {
  /// -dE/dx of E = d^T K d / 2, the rotation included: net force and torque are zero.
  conservative,
  /// The paper's -R K d: leaves a net torque sum d x K d, second order in the displacement.
  paper,
};

/// The first guess of the Jacobian in Broyden's method.
enum class BroydenStart {
  mass,    ///< M (the paper's): no factor, but diverges beyond about three explicit steps
  factor,  ///< the factor of M + h^2 K
};

/// Model of a free single tetrahedron (section 3.2 of the paper).
enum class IsolatedTetrahedra {
  rigid,       ///< a true rigid body, which keeps its spin
  projection,  ///< four points moved back to the rigid shape every step: loses spin
  qr,          ///< elastic, in the frame of its edges, by implicit Euler: loses spin
};

/// Method by which `implicit_euler` solves with corotational forces.
enum class CorotationalSolve {
  reassembled,  ///< M + h^2 sum R K R^T assembled and factored every step
  prefactored,  ///< M + h^2 K at rest, factored once; iterates on the difference
};

/// Frame in which `implicit_euler` linearises.
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
  /// Time step h, s, > 0. It may change between steps, at the cost of a new factor.
  double time_step = 1e-3;
  Integrator integrator = Integrator::floating_frame;
  /// Spectral radius of generalised-alpha, in [0, 0.5]: the share of an unresolved oscillation that
  /// remains after one step. With 0 a sudden load gives the static solution at once. With 0.8 the
  /// solution rings at 1.7 times that value for tens of steps, which breaks bodies that should
  /// hold. Above 0.5 the extrapolated Coriolis force drives oscillations, and spinning bodies
  /// diverge from 0.8 on. The value applies if the step resolves the slowest axial mode of a
  /// component. For longer steps it falls to 0 (`followed_rho`).
  double rho_infinity = 0;
  RayleighDamping damping = {};
  EulerFrame euler_frame = EulerFrame::current;
  ElasticModel model = ElasticModel::rigid_reference;
  /// Used by broyden, newton_cg, verlet and sub_stepped with the model rigid_reference.
  ElasticForce elastic_force = ElasticForce::conservative;
  BroydenStart broyden_start = BroydenStart::mass;
  CorotationalSolve corotational_solve = CorotationalSolve::reassembled;
  /// Residual of the step's equation over the first residual at which iterations (broyden,
  /// newton_cg, prefactored) end, in (0, 0.1].
  double tolerance = 1e-6;
  /// Most iterations; for newton_cg those of conjugate gradients. Afterwards the step is solved
  /// with the factor instead, and the report counts it.
  std::uint32_t max_iterations = 1000;
  /// Number of updates that Broyden's method keeps before it restarts, >= 1.
  std::uint32_t broyden_memory = 200;
  /// Most sub-steps of sub_stepped per step.
  std::uint32_t max_sub_steps = 10000;
  IsolatedTetrahedra isolated = IsolatedTetrahedra::rigid;
};

}  // namespace sunder

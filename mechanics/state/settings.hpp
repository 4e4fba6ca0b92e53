// SPDX-License-Identifier: MIT
// What a user chooses about time integration.
#pragma once

#include <cstdint>

namespace sunder {

enum class Integrator {
  floating_frame,  ///< rigid motion and displacement in the body frame, separately; the default
  implicit_euler,  ///< the paper's baseline, linearised; damps, and loses spin
  verlet,          ///< explicit, symplectic; needs steps below `explicit_step_bound`
  broyden,         ///< implicit Euler by Broyden's method, as the paper solves it
  newton_cg,       ///< implicit Euler by Newton's method with conjugate gradients
  sub_stepped,     ///< verlet, as many times a step as `explicit_step_bound` asks for
  modal,           ///< floating_frame with every mode exact, for small bodies
};

/// Whether the step is bounded by `explicit_step_bound`.
constexpr bool is_explicit(Integrator integrator) {
  return integrator == Integrator::verlet || integrator == Integrator::sub_stepped;
}

/// Whether rigid motion is integrated by itself, with momenta of its own.
constexpr bool is_floating(Integrator integrator) {
  return integrator == Integrator::floating_frame || integrator == Integrator::modal;
}

/// The elastic model.
enum class ElasticModel {
  rigid_reference,  ///< linear in the frame of the component (the paper's; algorithm 1)
  corotational,     ///< linear in a frame of each tetrahedron's own (what the paper compares with)
};

enum class ElasticForce {
  /// -dE/dx of E = d^T K d / 2, the rotation included: net force and torque are zero.
  conservative,
  /// The paper's -R K d: leaves a net torque sum d x K d, second order in the displacement.
  paper,
};

/// The first guess of the Jacobian in Broyden's method.
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
  prefactored,  ///< M + h^2 K at rest, factored once; the difference to it is iterated
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
  /// h, s, > 0; may change from step to step, at the cost of a new factor.
  double time_step = 1e-3;
  Integrator integrator = Integrator::floating_frame;
  /// Spectral radius of generalised-alpha, in [0, 0.5]: the part of an oscillation too fast for the
  /// step that is left after one step. With 0 a suddenly applied load gives the static solution at
  /// once, where 0.8 rings at 1.7 times of it for tens of steps and would break bodies that hold.
  /// Above 0.5 the extrapolated Coriolis force drives oscillations: measured, spinning bodies
  /// diverge from 0.8 on. Used where the step resolves the slowest axial mode of a component; for
  /// longer steps it falls to 0 (`followed_rho`).
  double rho_infinity = 0;
  RayleighDamping damping = {};
  EulerFrame euler_frame = EulerFrame::current;
  ElasticModel model = ElasticModel::rigid_reference;
  /// Used by broyden, newton_cg, verlet and sub_stepped with the model rigid_reference.
  ElasticForce elastic_force = ElasticForce::conservative;
  BroydenStart broyden_start = BroydenStart::mass;
  CorotationalSolve corotational_solve = CorotationalSolve::reassembled;
  /// Where iterations (broyden, newton_cg, prefactored) end: residual of the step's equation over
  /// the first residual, in (0, 0.1].
  double tolerance = 1e-6;
  /// Iterations after which they are given up and the step is solved with the factor instead, which
  /// the report says; for newton_cg those of conjugate gradients.
  std::uint32_t max_iterations = 1000;
  /// Updates that Broyden's method keeps before it restarts, >= 1.
  std::uint32_t broyden_memory = 200;
  /// Sub-steps that sub_stepped may take in a step.
  std::uint32_t max_sub_steps = 10000;
  IsolatedTetrahedra isolated = IsolatedTetrahedra::rigid;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Impulses at vertices and how the step responds to them: the one way contact couples to mechanics.
#pragma once

#include <span>

#include "mechanics/integrators/scratch.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// A blow at the start of a step.
struct VertexImpulse {
  VertexId vertex;
  Vec3 impulse = Vec3::Zero();  ///< j, N s, world
};

/// Vertices of one component that contact acts on.
struct StruckVertices {
  ComponentId component;
  std::span<const VertexId> vertices;  ///< k, none twice
};

/// Adds j / m to the velocity of every vertex struck: P += j, L += (x - c) x j. The rest goes into
/// the displacement rate, mean-axis free, so that x stays and P, L are exact. Impulses at held
/// vertices go into the support and change nothing. An isolated tetrahedron turns rigidly. Several
/// impulses at one vertex add up. O(vertices of the components struck).
void apply_impulses(MechanicsState& state, std::span<const VertexImpulse> impulses);

/// Inertia of a component about its mass centre as it is deformed now, kg m^2, world.
Mat3 world_inertia(const MechanicsState& state, const Component& component);

/// Gives a free rigid component (`Component::rigid`) an impulse (N s) through its mass centre.
/// O(vertices of the component).
void apply_push(MechanicsState& state, ComponentId id, const Vec3& impulse);

/// Adds an angular impulse (N m s) to a free component as a change of its spin: L += twist, and the
/// velocities that are rigid. Held components take none. O(vertices of the component).
void apply_twist(MechanicsState& state, ComponentId id, const Vec3& twist);

/// World displacement at the END of the next step of `struck.vertices` (3 k rows) for unit impulses
/// at them at its START (3 k columns), m/(N s), at the present state:
///   h (I/M - [x_k - c] I(q)^-1 [x_l - c])  +  R (c1 A^-1 + c2 M^-1, mean-axis projected) R^T
/// with c1 = (1 - alpha_m) h, c2 = 0 for floating_frame without damping, c1 = h for implicit_euler;
/// verlet: h / m on the diagonal. Exact for the linear part; a spinning body's Coriolis terms are
/// left out, so with spin w it is good to O(h w). Symmetric, positive semi-definite; zero rows and
/// columns for held vertices.
/// Needs: every vertex in `struck.component`. The first touch of a vertex costs three back-solves,
/// cached until the component is rebuilt or the step changes: the cache holds 72 k^2 bytes, no
/// more.
Eigen::MatrixXd end_of_step_response(MechanicsState& state, const StepInput& input,
                                     const StruckVertices& struck);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Elastic forces of a component from its positions alone (algorithm 1), with and without torque.
#pragma once

#include <span>

#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/state/settings/settings.hpp"

namespace sunder {

/// The input of algorithm 1.
struct ElasticInput {
  const MechanicsState& state;
  std::span<const Corners> corners;  ///< |T|
  std::span<const Vec3> positions;   ///< |V|, m
  ElasticForce form = ElasticForce::conservative;
};

/// Where algorithm 1 writes: rows of the component's vertices, set, not added to. |V| each.
struct ElasticOutput {
  std::span<Vec3> displacement;  ///< m, body frame
  std::span<Vec3> force;         ///< N, world, on the vertices
};

/// Algorithm 1 for one component at `positions`: its state by algorithm 2 (returned), the
/// displacement d = R^T (x - c) - (x0 - c0) of every vertex, then the force of every tetrahedron on
/// its vertices, -R K_e d_e. The conservative form subtracts the torque that leaves:
///   g = K d, S = R^T A, tau = sum d x g, y = (tr(S) I - S)^-1 tau, f = -R (g - m y x r0).
/// Where that matrix is singular (collinear positions) the paper's form is left as it is.
/// O(tetrahedra of the component), 40 ns each.
Pose deformation_forces(const ElasticOutput& output, const ElasticInput& input,
                        const Component& component);

/// The paper's form in a frame that is given and does not follow the positions: that of a supported
/// component. It is a gradient as it stands.
void deformation_forces_in(const Pose& frame, const ElasticOutput& output,
                           const ElasticInput& input, const Component& component);

/// d^T K d / 2 of a component, J, from displacements in its body frame (|V| rows).
double elastic_energy(const ElasticInput& input, const Component& component,
                      std::span<const Vec3> displacement);

}  // namespace sunder

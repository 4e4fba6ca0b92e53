// SPDX-License-Identifier: MIT
// Corotational tetrahedra: linear in a frame of each one's own, which turns with it; those of
// second order have a frame at each of Gauss' four points, as they turn by a little more along
// themselves.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "mechanics/element/elastic_force.hpp"
#include "mechanics/element/strain_displacement.hpp"

namespace sunder {

/// F = sum_a x_a G_a^T of a tetrahedron, from the positions of its corners; by differences, as the
/// gradients add up to nothing: exact far from the origin too.
inline Mat3 deformation_gradient(const ShapeGradient& gradient, const CornerVectors& x) {
  return (x.rightCols<3>().colwise() - x.col(0)) * gradient.rightCols<3>().transpose();
}

/// The turn R of an element: the proper rotation nearest to its F, by Newton's method from `near`,
/// with `refine_rotation` where that is not quick. Exact for inverted elements too.
Mat3 element_rotation(const Mat3& F, const Mat3& near);

/// Stress (eq. 5) of the strain R^T F - I that is left when the element's own turn R is taken out;
/// in the element's rest directions, Pa.
inline Mat3 corotational_stress(const Mat3& R, const Mat3& F, const Lame& lame) {
  Mat3 strain = R.transpose() * F;
  strain.diagonal().array() -= 1;
  return stress_of(strain, lame);
}

/// Forces of every tetrahedron of a component on its vertices, N, world: -V R sigma G_a, which is
/// -R K_e (R^T x - X) [Mueller and Gross 2004]. As R is the polar factor this is the gradient of
/// the energy V sigma : eps / 2, so that net force and torque are zero to rounding, for any turn.
/// Of second order: the sum over Gauss' points of the same, a quarter of V each, with gradients of
/// the nodes there; without turns that is K_e d.
/// `force`: |V|, rows of the component's nodes are set. `input.form` has no say.
/// O(tetrahedra), 150 ns each.
void corotational_forces(std::span<Vec3> force, const ElasticInput& input,
                         const Component& component);

/// Forces of a viscosity of `factor` (s) times the stiffness, N, world: -V F S grad N_a with S =
/// factor (lambda tr(E') I + 2 mu E') and the rate of Green's strain E' = (F^T F' + F'^T F) / 2, at
/// Gauss' points as above. Without strain that is -factor R K_e R^T v. A rigid motion has E' = 0 in
/// any state of strain. Net force and torque are zero to rounding, and the power taken, -sum v .
/// force = V S : E', is never negative. `force`: |V|, rows of the component's nodes are set.
void viscous_forces(std::span<Vec3> force, const ElasticInput& input,
                    std::span<const Vec3> velocities, const Component& component, double factor);

/// R of every tetrahedron of the component at `input.positions`, in its order, four of one of
/// second order, world.
void element_rotations(std::vector<Mat3>& rotation, const ElasticInput& input,
                       const Component& component);

/// Elements with their turns held fixed.
struct TurnedElements {
  const ElasticInput& input;
  const Component& component;
  std::span<const Mat3> rotation;  ///< as `element_rotations` gives them
};

/// sum R K_e R^T u over the component: the derivative of minus its forces as far as turns do not
/// change. `product`, `u`: |V|, world.
void corotational_product(std::span<Vec3> product, const TurnedElements& elements,
                          std::span<const Vec3> u);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Linear tetrahedra: shape gradients, strain-displacement and stiffness matrices (eqs. 1, 2),
// stress.
#pragma once

#include <array>
#include <span>

#include <Eigen/Dense>

#include "mechanics/state/columns.hpp"
#include "mechanics/state/settings/material.hpp"

namespace sunder {

/// 6 x 12: strain (xx, yy, zz, 2 yz, 2 xz, 2 xy) from the four corners' displacements. 1/m.
using StrainDisplacement = Eigen::Matrix<double, 6, 12>;
/// 12 x 12, N/m.
using ElementStiffness = Eigen::Matrix<double, 12, 12>;
/// Displacements of the four corners, one a column, m.
using CornerVectors = Eigen::Matrix<double, 3, 4>;

/// Signed volume of a tetrahedron, m^3: positive for positive orientation.
double tetrahedron_volume(const std::array<Vec3, 4>& points);

/// Gradients of the shape functions in the configuration `points` (m). Their sum is zero.
/// Needs: a volume that is not zero.
ShapeGradient shape_gradients(const std::array<Vec3, 4>& points);

/// C, 6 x 6, Pa: stress (xx, yy, zz, yz, xz, xy) = C strain, of the isotropic material.
Eigen::Matrix<double, 6, 6> elasticity_matrix(const Lame& lame);

/// B_e of section 3.1, from the shape gradients.
StrainDisplacement strain_displacement(const ShapeGradient& gradient);

/// K_e = V_e B_e^T C B_e: equation (1) with the rest volume that it drops. This is the reference;
/// loops over elements use `element_force`, four times faster.
ElementStiffness element_stiffness(const ShapeGradient& gradient, double rest_volume,
                                   const Lame& lame);

/// The 3 x 3 block of K_e between corners a and b:
/// V (lambda G_a G_b^T + mu G_b G_a^T + mu (G_a . G_b) I), N/m.
Mat3 stiffness_block(const Vec3& gradient_a, const Vec3& gradient_b, double rest_volume,
                     const Lame& lame);

/// Adds that block, column by column, at `to`. `scaled`: the constants times the rest volume, N m.
inline void add_stiffness_block(double* to, const Vec3& gradient_a, const Vec3& gradient_b,
                                const Lame& scaled) {
  const double* a = gradient_a.data();
  const double* b = gradient_b.data();
  const double shear = scaled.mu * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  for (int c = 0; c < 3; ++c) {
    const double along = scaled.lambda * b[c], across = scaled.mu * a[c];
    for (int r = 0; r < 3; ++r) to[3 * c + r] += along * a[r] + across * b[r];
    to[4 * c] += shear;
  }
}

/// H = sum_a d_a G_a^T, 3 x 3, no unit: its symmetric part is the strain, its skew part the turn.
inline Mat3 displacement_gradient(const ShapeGradient& gradient, const CornerVectors& d) {
  return d * gradient.transpose();
}

/// sigma = lambda tr(eps) I + 2 mu eps, eps = (H + H^T) / 2 (eq. 5), Pa, tension positive.
inline Mat3 stress_of(const Mat3& H, const Lame& lame) {
  Mat3 sigma = lame.mu * (H + H.transpose());
  sigma.diagonal().array() += lame.lambda * H.trace();
  return sigma;
}

/// theta, rad: the length of the rotation vector in the skew part of H.
inline double turn_of(const Mat3& H) {
  return 0.5 * Vec3(H(2, 1) - H(1, 2), H(0, 2) - H(2, 0), H(1, 0) - H(0, 1)).norm();
}

/// K_e d_e (eq. 2) in shape-gradient form: column a is V sigma G_a, N. The force ON the vertices is
/// its negative. Same numbers as `element_stiffness` times d, to rounding.
inline CornerVectors element_force(const ShapeGradient& gradient, double rest_volume,
                                   const Mat3& sigma) {
  return rest_volume * sigma * gradient;
}

/// The four values of `column` at the corners of a tetrahedron, one a column.
inline CornerVectors at_corners(std::span<const Vec3> column, const Corners& corners) {
  CornerVectors values;
  for (int a = 0; a < 4; ++a) values.col(a) = column[corners[a].index()];
  return values;
}

}  // namespace sunder

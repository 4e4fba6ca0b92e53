// SPDX-License-Identifier: MIT
// Element matrices of linear tetrahedra.
#include "mechanics/element/strain_displacement.hpp"

namespace sunder {

double tetrahedron_volume(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6;
}

ShapeGradient shape_gradients(const std::array<Vec3, 4>& p) {
  // Rows of the inverse of the edge matrix, written as cross products: no pivoting, and every
  // gradient comes out of its own opposite face.
  const Vec3 e1 = p[1] - p[0];
  const Vec3 e2 = p[2] - p[0];
  const Vec3 e3 = p[3] - p[0];
  const double det = e1.cross(e2).dot(e3);
  ShapeGradient gradient;
  gradient.col(1) = e2.cross(e3) / det;
  gradient.col(2) = e3.cross(e1) / det;
  gradient.col(3) = e1.cross(e2) / det;
  gradient.col(0) = -(gradient.col(1) + gradient.col(2) + gradient.col(3));
  return gradient;
}

Eigen::Matrix<double, 6, 6> elasticity_matrix(const Lame& lame) {
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  C.topLeftCorner<3, 3>().setConstant(lame.lambda);
  C.diagonal().head<3>().array() += 2 * lame.mu;
  C.diagonal().tail<3>().setConstant(lame.mu);
  return C;
}

StrainDisplacement strain_displacement(const ShapeGradient& gradient) {
  StrainDisplacement B = StrainDisplacement::Zero();
  for (int a = 0; a < 4; ++a) {
    const Vec3 g = gradient.col(a);
    B.block<6, 3>(0, 3 * a) << g.x(), 0, 0,  //
        0, g.y(), 0,                         //
        0, 0, g.z(),                         //
        0, g.z(), g.y(),                     //
        g.z(), 0, g.x(),                     //
        g.y(), g.x(), 0;
  }
  return B;
}

ElementStiffness element_stiffness(const ShapeGradient& gradient, double rest_volume,
                                   const Lame& lame) {
  const StrainDisplacement B = strain_displacement(gradient);
  return rest_volume * B.transpose() * elasticity_matrix(lame) * B;
}

Mat3 stiffness_block(const Vec3& gradient_a, const Vec3& gradient_b, double rest_volume,
                     const Lame& lame) {
  Mat3 block = lame.lambda * gradient_a * gradient_b.transpose() +
               lame.mu * gradient_b * gradient_a.transpose();
  block.diagonal().array() += lame.mu * gradient_a.dot(gradient_b);
  return rest_volume * block;
}

}  // namespace sunder

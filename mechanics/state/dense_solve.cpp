// SPDX-License-Identifier: MIT
// Instances of Eigen's factorisations.
#include "mechanics/state/dense_solve.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace sunder {

Vec3 solve3(const Mat3& S, const Vec3& y) { return S.ldlt().solve(y); }

Vec3 solve3_by_lu(const Mat3& A, const Vec3& y) { return A.partialPivLu().solve(y); }

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& A,
                                                               int options) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, options);
}

}  // namespace sunder

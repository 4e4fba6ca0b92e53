// SPDX-License-Identifier: MIT
// Eigen's dense solvers that several sources need, compiled once: each takes seconds to compile.
#pragma once

#include <Eigen/Eigenvalues>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// x of S x = y for a symmetric positive definite S, by L D L^T; in the unit of y over that of S.
Vec3 solve3(const Mat3& S, const Vec3& y);

/// x of A x = y for any A that has an inverse, by L U with rows exchanged.
Vec3 solve3_by_lu(const Mat3& A, const Vec3& y);

/// Eigenvalues in rising order, and eigenvectors unless `options` is Eigen::EigenvaluesOnly, of a
/// symmetric matrix; its lower triangle is read.
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetric_eigen(
    const Eigen::MatrixXd& A, int options = Eigen::ComputeEigenvectors);

}  // namespace sunder

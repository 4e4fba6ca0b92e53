// SPDX-License-Identifier: MIT
// SuiteSparse's CHOLMOD on the same matrix, for comparison, where the program was built with it.
#pragma once

#include <Eigen/Sparse>
#include <optional>

namespace sunder {

struct CholmodTimes {
  double analyse = 0, factor = 0, solve = 0;  ///< ms, medians
  double error = 0;                           ///< |x - expected| / |expected|
};

/// A (lower triangle, positive definite) factored and solved `runs` times by CHOLMOD's supernodal
/// method with the order it finds best, on one thread. Nothing where the program was built without
/// it (`-DSUNDER_CHOLMOD=ON`), or where it fails. `expected`: A^-1 b.
std::optional<CholmodTimes> time_cholmod(const Eigen::SparseMatrix<double>& A,
                                         const Eigen::VectorXd& b, const Eigen::VectorXd& expected,
                                         int runs);

}  // namespace sunder

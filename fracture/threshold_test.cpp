// SPDX-License-Identifier: MIT
// Gershgorin's bound and the exact test by leading minors.
#include "fracture/threshold_test.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sunder {

double gershgorin_bound(const Eigen::Matrix3d& sigma) {
  const double xy = std::abs(sigma(0, 1)), yz = std::abs(sigma(1, 2)), xz = std::abs(sigma(0, 2));
  const double b0 = sigma(0, 0) + (xy + xz);
  const double b1 = sigma(1, 1) + (xy + yz);
  const double b2 = sigma(2, 2) + (xz + yz);
  // std::max would drop a NaN in its second argument; the sum keeps it.
  if (std::isnan(b0 + b1 + b2)) return std::numeric_limits<double>::quiet_NaN();
  return std::max({b0, b1, b2});
}

ThresholdAnswer test_threshold(const Eigen::Matrix3d& sigma, double xi) {
  const double sxy = sigma(0, 1), syz = sigma(1, 2), sxz = sigma(0, 2);
  const double p = xi - sigma(0, 0), q = xi - sigma(1, 1), r = xi - sigma(2, 2);
  const double m2 = p * q - sxy * sxy;
  const double m3 = r * m2 - p * syz * syz - q * sxz * sxz - 2 * sxy * syz * sxz;
  if (p > 0 && m2 > 0 && m3 > 0) return ThresholdAnswer::below;
  // Infinite entries make a NaN of the minors too: no stress is infinite, so both are failures.
  if (!std::isfinite(m3) || !std::isfinite(m2)) return ThresholdAnswer::not_a_number;
  return ThresholdAnswer::reached;
}

double largest_principal_stress(const Eigen::Matrix3d& sigma) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sigma, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2);
}

}  // namespace sunder

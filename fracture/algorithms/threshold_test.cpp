// SPDX-License-Identifier: MIT
// Gershgorin's bound and the exact test by leading minors.
#include "fracture/algorithms/threshold_test.hpp"

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
  if (!std::isfinite(m3) || !std::isfinite(m2)) {
    // An infinite threshold leaves no minors, and nothing finite reaches it.
    const bool unreachable = xi == std::numeric_limits<double>::infinity() && sigma.allFinite();
    return unreachable ? ThresholdAnswer::below : ThresholdAnswer::not_a_number;
  }
  return ThresholdAnswer::reached;
}

ThresholdAnswer test_eigenvalues(const Eigen::Matrix3d& sigma, double xi) {
  if (!sigma.allFinite() || std::isnan(xi)) return ThresholdAnswer::not_a_number;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sigma, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2) >= xi ? ThresholdAnswer::reached : ThresholdAnswer::below;
}

ThresholdAnswer test_threshold(const Eigen::Matrix3d& sigma, double xi, ThresholdTest way,
                               std::size_t& suspects) {
  if (way == ThresholdTest::chain || way == ThresholdTest::gershgorin) {
    // A bound that is not a number is not below: the second test decides.
    if (gershgorin_bound(sigma) < xi) return ThresholdAnswer::below;
    ++suspects;
  }
  const bool minors = way == ThresholdTest::chain || way == ThresholdTest::exact;
  return minors ? test_threshold(sigma, xi) : test_eigenvalues(sigma, xi);
}

double largest_principal_stress(const Eigen::Matrix3d& sigma) {
  // compute(), not computeDirect(): that one's functions of angles differ from machine to machine.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sigma, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Does the largest principal stress of a vertex reach the tensile threshold? Bound, exact test,
// value.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "fracture/algorithms/fracture_settings.hpp"

namespace sunder {

/// The result of a test of one stress tensor against a threshold.
enum class ThresholdAnswer { below, reached, not_a_number };

/// Upper bound of the eigenvalues of a symmetric tensor, max_i M_ii + sum_{j != i} |M_ji|
/// (Gershgorin; eq. 7). `sigma`: Pa. Returns Pa; not a number when an entry is not.
double gershgorin_bound(const Eigen::Matrix3d& sigma);

/// Whether the largest eigenvalue of `sigma` is at least `xi`: exactly when `xi I - sigma` is not
/// positive definite, by its three leading minors; ten multiplications, no eigenvalue.
/// `sigma`: symmetric, Pa; `xi`: Pa. Exact to about 1e-9 relative to the threshold. A tensor or a
/// threshold that is not a number answers `not_a_number`, which callers must treat as a failure of
/// the simulation and never as a fracture.
ThresholdAnswer test_threshold(const Eigen::Matrix3d& sigma, double xi);

/// The same by the eigenvalues themselves (QR iterations; some 300 ns): not a number where a tensor
/// is, for an infinite one too.
ThresholdAnswer test_eigenvalues(const Eigen::Matrix3d& sigma, double xi);

/// Whether the largest eigenvalue of `sigma` reaches `xi`, in one of the ways above. `suspects`
/// counts the tensors that Gershgorin's bound lets through, where it is used.
ThresholdAnswer test_threshold(const Eigen::Matrix3d& sigma, double xi, ThresholdTest way,
                               std::size_t& suspects);

/// Largest eigenvalue of a symmetric tensor, Pa, by the trigonometric formula; about 1e-7 relative
/// to the largest entry where two eigenvalues nearly coincide. For display, never for decisions.
double largest_principal_stress(const Eigen::Matrix3d& sigma);

}  // namespace sunder

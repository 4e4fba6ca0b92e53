// SPDX-License-Identifier: MIT
// The proper rotation nearest to a 3 x 3 matrix, for every matrix there is; and small rotation
// maps.
#pragma once

#include <Eigen/Geometry>

#include "mechanics/state/columns.hpp"

namespace sunder {

/// [v]x: the matrix of the cross product, [v]x w = v x w.
inline Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The least rotation that takes unit vector `from` to unit vector `to`.
Eigen::Quaterniond least_rotation(const Vec3& from, const Vec3& to);

/// The rotation by the vector `turn` (rad times axis); exact for turns of any size.
Eigen::Quaterniond rotation_of(const Vec3& turn);

/// The rotation R in SO(3) that maximises tr(R^T A), the polar factor of A where det A > 0; of any
/// scale, as A is divided by its norm first. Reflections (det A < 0) and flat shapes (rank 2) have
/// one answer and get it; collinear shapes (rank 1) get the one nearest to `last`; where A is zero
/// or not finite, `last` comes back. Never a NaN for a finite `last` of unit length.
/// From the singular value decomposition: about 1 us, no warm start, right for half turns.
Eigen::Quaterniond extract_rotation(const Mat3& A, const Eigen::Quaterniond& last);

/// The same rotation by Newton's method on SO(3) from `last`: R <- R exp(w), with S = sym(R^T A)
/// and (tr(S) I - S) w = 2 axl(skew(R^T A)). Quadratic, about 0.2 us per turn of the loop. Falls
/// back on `extract_rotation` where that matrix is not clearly positive definite, or where six
/// iterations are not enough. Definiteness distinguishes the maximum from other stationary points,
/// half turns among them. Error a few units of rounding.
Eigen::Quaterniond refine_rotation(const Mat3& A, const Eigen::Quaterniond& last);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Rotation extraction: singular values for any matrix, Newton's method from a good start.
#include "mechanics/frame/rotation.hpp"

#include <cmath>
#include <limits>

#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

/// Below this ratio of singular values the second direction is noise: a thousand roundings.
constexpr double rank_tolerance = 1e3 * std::numeric_limits<double>::epsilon();

/// Twice the axial vector of the skew part.
Vec3 twice_axial(const Mat3& P) {
  return {P(2, 1) - P(1, 2), P(0, 2) - P(2, 0), P(1, 0) - P(0, 1)};
}

}  // namespace

Eigen::Quaterniond least_rotation(const Vec3& from, const Vec3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Eigen::Quaterniond rotation_of(const Vec3& turn) {
  const double angle = turn.norm();
  // sin(x)/x by its series where the division would lose it: the next term is below rounding.
  const double half_sinc = angle > 1e-4 ? sine(angle / 2) / angle : 0.5 - angle * angle / 48;
  Eigen::Quaterniond q;
  q.w() = cosine(angle / 2);
  q.vec() = half_sinc * turn;
  return q.normalized();
}

Eigen::Quaterniond extract_rotation(const Mat3& A, const Eigen::Quaterniond& last) {
  // Scaled by the largest entry first: squares of 1e-200 would vanish in the norm.
  const double scale = A.cwiseAbs().maxCoeff();
  if (!A.allFinite() || !(scale > 0)) return last;
  const Eigen::JacobiSVD<Mat3> svd(A / scale, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3& U = svd.matrixU();
  const Mat3& V = svd.matrixV();
  const double sign = (U * V.transpose()).determinant() < 0 ? -1 : 1;
  const Vec3 sigma = svd.singularValues();
  if (sigma(1) + sign * sigma(2) <= rank_tolerance * sigma(0)) {
    // One direction only is known (or the two smaller ones may be exchanged freely, in a
    // reflection): turn `last` as little as it takes to put that direction right.
    const Vec3 now = last * Vec3(V.col(0));
    return (least_rotation(now, U.col(0)) * last).normalized();
  }
  return Eigen::Quaterniond(Mat3(U * Vec3(1, 1, sign).asDiagonal() * V.transpose())).normalized();
}

Eigen::Quaterniond refine_rotation(const Mat3& A, const Eigen::Quaterniond& last) {
  const double scale = A.cwiseAbs().maxCoeff();
  if (!A.allFinite() || !(scale > 0)) return last;
  const Mat3 unit = A / scale;
  Eigen::Quaterniond R = last;
  constexpr int most_iterations = 6;
  // Quadratic: after a turn of 1e-9 the rest is below rounding.
  constexpr double converged = 1e-9;
  for (int i = 0; i < most_iterations; ++i) {
    const Mat3 P = R.toRotationMatrix().transpose() * unit;
    const Mat3 S = 0.5 * (P + P.transpose());
    Mat3 G = -S;
    G.diagonal().array() += S.trace();
    // Positive definite by its leading minors, with a margin that keeps the solve well posed.
    const double minor2 = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0);
    const double size = G.cwiseAbs().maxCoeff();
    if (!(G(0, 0) > 1e-6 * size && minor2 > 1e-6 * size * size &&
          G.determinant() > 1e-6 * size * size * size)) {
      return extract_rotation(A, last);
    }
    const Vec3 turn = G.inverse() * twice_axial(P);
    R = (R * rotation_of(turn)).normalized();
    if (turn.norm() <= converged) return R;
  }
  return extract_rotation(A, last);
}

}  // namespace sunder

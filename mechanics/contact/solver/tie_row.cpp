// SPDX-License-Identifier: MIT
// Projections and gives of ties.
#include "mechanics/contact/solver/tie_row.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sunder {
namespace {

double pull_of(const ContactRow& row, const Vec3& impulse) { return -row.normal.dot(impulse); }

Vec3 across(const ContactRow& row, const Vec3& v) { return v - row.normal.dot(v) * row.normal; }

/// Squared length in the metric of `tie_kept`, without what presses.
double squared_pull(const ContactRow& row, const Vec3& impulse) {
  const double pull = std::max(0.0, pull_of(row, impulse));
  return pull * pull + across(row, impulse).squaredNorm() / row.sliding_stiffness;
}

}  // namespace

Mat3 tie_give(const ContactRow& row) {
  const Mat3 along = row.normal * row.normal.transpose();
  const double normal = pull_of(row, row.impulse) > 0 ? row.compliance : 0;
  return normal * along + row.compliance / row.sliding_stiffness * (Mat3::Identity() - along);
}

Vec3 tie_kept(const ContactRow& row, const Vec3& impulse) {
  const double most = row.tie_most;
  const double squared = squared_pull(row, impulse);
  if (squared <= most * most) return impulse;
  const double share = most / std::sqrt(squared);
  const double pressed = std::max(0.0, -pull_of(row, impulse));
  return share * (impulse - pressed * row.normal) + pressed * row.normal;
}

bool tie_is_free(const ContactRow& row) {
  constexpr double short_of = 1 - 1e-9;
  const double most = short_of * row.tie_most;
  return squared_pull(row, row.impulse) < most * most;
}

double tie_way(const ContactRow& row, const Vec3& change) {
  double way = 1;
  const double pull = pull_of(row, row.impulse), by = pull_of(row, change);
  if (row.compliance > 0 && pull * (pull + by) < 0) way = std::min(way, -pull / by);
  const Vec3 scaled = row.impulse + way * change;
  if (squared_pull(row, scaled) <= row.tie_most * row.tie_most) return way;
  // A convex set: by halves, which is exact enough for a search that goes on from there.
  double low = 0, high = way;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    const bool inside =
        squared_pull(row, row.impulse + middle * change) <= row.tie_most * row.tie_most;
    (inside ? low : high) = middle;
  }
  return low;
}

double tie_response_of(const ContactRow& row) {
  const Vec3& n = row.normal;
  const double root = std::sqrt(row.sliding_stiffness);
  const Mat3 along = n * n.transpose();
  const Mat3 scale = along + root * (Mat3::Identity() - along);
  const Mat3 scaled = scale * row.response * scale;
  // compute(), not computeDirect(): that one's functions of angles differ from machine to machine.
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(scaled, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2] + row.compliance;
}

Vec3 tie_wanted(const ContactRow& row, const Vec3& opening) {
  if (!(row.tie_response > 0)) return row.impulse;
  const Vec3 left = opening + tie_give(row) * row.impulse;
  const double along = row.normal.dot(left);
  const Vec3 step = along * row.normal + row.sliding_stiffness * (left - along * row.normal);
  return tie_kept(row, row.impulse - step / row.tie_response);
}

}  // namespace sunder

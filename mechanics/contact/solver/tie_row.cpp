// SPDX-License-Identifier: MIT
// Projections and gives of cohesive bonds.
#include "mechanics/contact/solver/tie_row.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sunder {
namespace {

double pull_of(const Constraint& row, const Vec3& impulse) { return -row.normal.dot(impulse); }

Vec3 across(const Constraint& row, const Vec3& v) { return v - row.normal.dot(v) * row.normal; }

/// Squared length in the metric of `bond_kept`, without pressure.
double squared_pull(const Constraint& row, const Vec3& impulse) {
  const double pull = std::max(0.0, pull_of(row, impulse));
  return pull * pull + across(row, impulse).squaredNorm() / row.bond().sliding_stiffness;
}

}  // namespace

Mat3 bond_give(const Constraint& row) {
  const Mat3 along = row.normal * row.normal.transpose();
  const double normal = pull_of(row, row.impulse) > 0 ? row.compliance : 0;
  const double sliding = row.compliance / row.bond().sliding_stiffness;
  return normal * along + sliding * (Mat3::Identity() - along);
}

Vec3 bond_kept(const Constraint& row, const Vec3& impulse) {
  const double most = row.bond().most;
  const double squared = squared_pull(row, impulse);
  if (squared <= most * most) return impulse;
  const double share = most / std::sqrt(squared);
  const double pressed = std::max(0.0, -pull_of(row, impulse));
  return share * (impulse - pressed * row.normal) + pressed * row.normal;
}

bool bond_is_free(const Constraint& row) {
  constexpr double short_of = 1 - 1e-9;
  const double most = short_of * row.bond().most;
  return squared_pull(row, row.impulse) < most * most;
}

double bond_way(const Constraint& row, const Vec3& change) {
  const double most = row.bond().most;
  double way = 1;
  const double pull = pull_of(row, row.impulse), by = pull_of(row, change);
  if (row.compliance > 0 && pull * (pull + by) < 0) way = std::min(way, -pull / by);
  const Vec3 scaled = row.impulse + way * change;
  if (squared_pull(row, scaled) <= most * most) return way;
  // A convex set: by halves, which is exact enough for a search that goes on from there.
  double low = 0, high = way;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    const bool inside = squared_pull(row, row.impulse + middle * change) <= most * most;
    (inside ? low : high) = middle;
  }
  return low;
}

double bond_response(const Constraint& row, const Mat3& response) {
  const Vec3& n = row.normal;
  const double root = std::sqrt(row.bond().sliding_stiffness);
  const Mat3 along = n * n.transpose();
  const Mat3 scale = along + root * (Mat3::Identity() - along);
  const Mat3 scaled = scale * response * scale;
  // compute(), not computeDirect(): that one's functions of angles differ from machine to machine.
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(scaled, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2] + row.compliance;
}

Vec3 bond_wanted(const Constraint& row, const Vec3& opening) {
  const CohesiveBond& bond = row.bond();
  if (!(bond.response > 0)) return row.impulse;
  const Vec3 left = opening + bond_give(row) * row.impulse;
  const double along = row.normal.dot(left);
  const Vec3 step = along * row.normal + bond.sliding_stiffness * (left - along * row.normal);
  return bond_kept(row, row.impulse - step / bond.response);
}

}  // namespace sunder

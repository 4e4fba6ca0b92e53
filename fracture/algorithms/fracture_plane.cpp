// SPDX-License-Identifier: MIT
// Eigenvectors of a node stress, and the choice between equally tense directions.
#include "fracture/algorithms/fracture_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sunder {
namespace {

Eigen::Vector3d canonical(const Eigen::Vector3d& n, const Eigen::Vector3d& octant) {
  const Point c = canonical_direction({n(0), n(1), n(2)}, {octant(0), octant(1), octant(2)});
  return {c[0], c[1], c[2]};
}

}  // namespace

PrincipalTension principal_tension(const Eigen::Matrix3d& sigma) {
  // compute(), not computeDirect(): the closed form's vectors are only 8e-8 accurate on near-equal
  // eigenvalues (docs/explanation/paper.md), and this runs for breaking vertices only.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sigma);
  const Eigen::Vector3d values = solver.eigenvalues();
  const double equal = equal_directions * sigma.cwiseAbs().maxCoeff();
  int first = 2;
  while (first > 0 && values(2) - values(first - 1) <= equal) --first;
  return {values(2), solver.eigenvectors().rightCols(3 - first)};
}

Eigen::Vector3d octant_of(const Eigen::Vector3d& point, const Eigen::Vector3d& centre) {
  Eigen::Vector3d signs;
  for (int i = 0; i < 3; ++i) {
    const double rounding = 1e-9 * std::max(std::abs(point(i)), std::abs(centre(i)));
    signs(i) = point(i) - centre(i) < -rounding ? -1 : 1;
  }
  return signs;
}

std::vector<Eigen::Vector3d> candidate_normals(const PrincipalTension& tension,
                                               const std::vector<Eigen::Vector3d>& face_normals,
                                               const Eigen::Vector3d& octant) {
  if (tension.directions.cols() == 1) {
    return {canonical(tension.directions.col(0), octant)};
  }
  std::vector<Eigen::Vector3d> candidates;
  const auto add_projection = [&](const Eigen::Vector3d& direction) {
    const Eigen::Vector3d inside =
        tension.directions * (tension.directions.transpose() * direction);
    // A direction at right angles to the eigenspace says nothing about it.
    if (inside.norm() > 1e-3) candidates.push_back(canonical(inside.normalized(), octant));
  };
  for (const Eigen::Vector3d& normal : face_normals) add_projection(normal);
  for (int axis = 0; axis < 3; ++axis) add_projection(Eigen::Vector3d::Unit(axis));
  return candidates;
}

}  // namespace sunder

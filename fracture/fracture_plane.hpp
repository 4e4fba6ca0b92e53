// SPDX-License-Identifier: MIT
// The plane of a crack at a vertex: normals that the stress allows. Which one wins is the fan's
// affair.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sunder {

/// The largest principal stress of a vertex and the directions it acts in.
struct PrincipalTension {
  /// Largest eigenvalue, Pa.
  double value = 0;
  /// Orthonormal basis of its eigenspace, one to three columns, unit length, rest frame.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> directions;
};

/// Largest eigenvalue of `sigma` (symmetric, Pa, rest frame) and its whole eigenspace: eigenvalues
/// within `1e-9` of the largest entry count as equal, well above the solver's 3e-15 and far below
/// anything a mesh resolves. Needs finite entries.
PrincipalTension principal_tension(const Eigen::Matrix3d& sigma);

/// The canonical one of the two directions `n` and `-n`: the component of largest magnitude is
/// positive, the lowest axis on ties (decisions.md, Splitting).
Eigen::Vector3d canonical_direction(const Eigen::Vector3d& n);

/// Candidate normals for a fracture plane, canonical, in the order in which ties are decided: the
/// eigenvector itself when it is single, otherwise the projections into the eigenspace of
/// `face_normals` (the interior faces at the vertex, so that the least misaligned fan is among
/// them) and last those of the axes x, y, z. Never the solver's own arbitrary basis.
std::vector<Eigen::Vector3d> candidate_normals(const PrincipalTension& tension,
                                               const std::vector<Eigen::Vector3d>& face_normals);

}  // namespace sunder

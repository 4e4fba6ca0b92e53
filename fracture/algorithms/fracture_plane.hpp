// SPDX-License-Identifier: MIT
// The plane of a crack at a vertex: normals that the stress allows. Which one wins is the fan's
// affair.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "topology/kernel/plane_side.hpp"

namespace sunder {

/// The largest principal stress of a vertex and the directions it acts in.
struct PrincipalTension {
  /// Largest eigenvalue, Pa.
  double value = 0;
  /// Orthonormal basis of its eigenspace, one to three columns, unit length, rest frame.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> directions;
};

/// Largest eigenvalue of `sigma` (symmetric, Pa, rest frame) and its whole eigenspace: eigenvalues
/// within `equal_directions` of the largest entry count as equal. Needs finite entries.
PrincipalTension principal_tension(const Eigen::Matrix3d& sigma);

/// Signs (+-1) of the octant about `centre` in which a point lies; + on its boundaries, to 1e-9. A
/// direction multiplied with them, by components, is folded: mirror images across the coordinate
/// planes through `centre` are then one. So decisions on folded directions keep a mirror symmetry
/// of the body.
Eigen::Vector3d octant_of(const Eigen::Vector3d& point, const Eigen::Vector3d& centre);

/// Candidate normals for a fracture plane, each the canonical direction seen in `octant`
/// (docs/explanation/paper.md): the eigenvector itself when
/// it is single, otherwise the projections into the eigenspace of `face_normals` (the interior
/// faces at the vertex, so that the least misaligned fan is among them) and of the axes x, y, z.
/// Never the solver's own arbitrary basis.
std::vector<Eigen::Vector3d> candidate_normals(
    const PrincipalTension& tension, const std::vector<Eigen::Vector3d>& face_normals,
    const Eigen::Vector3d& octant = Eigen::Vector3d::Ones());

}  // namespace sunder

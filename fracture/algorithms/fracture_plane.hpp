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

/// Directions closer than this, eigenvalues whose difference is less of the largest entry, and fans
/// whose qualities differ by less, count as equal: far above what solvers leave in a stress (1e-9,
/// mirror images differ by as much), far below anything a mesh resolves.
inline constexpr double equal_directions = 1e-6;

/// Largest eigenvalue of `sigma` (symmetric, Pa, rest frame) and its whole eigenspace: eigenvalues
/// within `equal_directions` of the largest entry count as equal. Needs finite entries.
PrincipalTension principal_tension(const Eigen::Matrix3d& sigma);

/// Signs (+-1) of the octant about `centre` in which a point lies; + on its boundaries, to 1e-9. A
/// direction multiplied with them, by components, is folded: mirror images across the coordinate
/// planes through `centre` are then one, so that what is decided on folded directions keeps a
/// mirror symmetry of the body.
Eigen::Vector3d octant_of(const Eigen::Vector3d& point, const Eigen::Vector3d& centre);

/// The canonical one of the two directions `n` and `-n`: folded into the octant `octant`, the
/// component of largest magnitude is positive, the lowest axis on ties to `equal_directions`
/// (docs/decisions.md, Splitting).
Eigen::Vector3d canonical_direction(const Eigen::Vector3d& n,
                                    const Eigen::Vector3d& octant = Eigen::Vector3d::Ones());

/// Candidate normals for a fracture plane, each canonical in `octant`: the eigenvector itself when
/// it is single, otherwise the projections into the eigenspace of `face_normals` (the interior
/// faces at the vertex, so that the least misaligned fan is among them) and of the axes x, y, z.
/// Never the solver's own arbitrary basis.
std::vector<Eigen::Vector3d> candidate_normals(
    const PrincipalTension& tension, const std::vector<Eigen::Vector3d>& face_normals,
    const Eigen::Vector3d& octant = Eigen::Vector3d::Ones());

}  // namespace sunder

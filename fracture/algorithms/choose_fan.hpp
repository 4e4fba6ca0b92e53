// SPDX-License-Identifier: MIT
// Where a vertex over its threshold is cut: the plane of its fan and the faces.
#pragma once

#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_plane.hpp"

namespace sunder {

/// A plane through a vertex and its fan: the faces between the tetrahedra whose rest centres lie on
/// the side of the normal or, to `equal_directions`, on the plane, and the others.
struct FanPlane {
  /// Rest frame, unit length.
  Vec3 normal = Vec3::Zero();
  /// In rising order.
  std::vector<HalfFaceId> faces;
};

/// Among the normals the stress allows, the one whose faces are least misaligned with it
/// (area-weighted mean of |n . n_f|), then the one that continues an existing crack. Where
/// tetrahedra have their centres on the plane, n and -n give different fans and both are judged.
/// Where fans are equally good, to 1e-6, the folded normals decide (`octant_of`): larger |x|, |y|,
/// |z|, then x, y, z.
///
/// So mirror images of a vertex across the coordinate planes through `centre` choose mirror images
/// of a fan, whatever the numbers of vertices and tetrahedra. Only a vertex ON such a plane whose
/// best fan is not its own mirror image can choose but one of two images: the one that the rule
/// above gives with the axis' positive direction.
///
/// Gives no faces when every candidate has the whole star on one side. Faces that touch an
/// unbreakable vertex are left out: a vertex splits by faces at it alone, so it never does.
/// `centre`: rest mass centre of the vertex' component, m. O(star x candidates).
FanPlane choose_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension,
                    const Vec3& centre = Vec3::Zero());

/// A fan decided on: several can be decided on the same state and split one after the other, since
/// half-faces keep their names.
struct PlannedFan {
  VertexId vertex;
  FanPlane plane;
  double stress = 0, strength = 0;  ///< Pa, when it was decided
  double choose_us = 0;             ///< wall time of deciding, for reports only
};

/// The fan of `vertex` for its stress (`choose_fan`); no faces where it is empty.
PlannedFan plan_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension,
                    const Vec3& centre = Vec3::Zero());

/// The fan of `vertex` along a plane that is known already; `stress` (Pa) is only noted.
/// Needs: a living vertex, a normal that is not zero.
PlannedFan plan_known_fan(const Cells& cells, VertexId vertex, const Vec3& normal, double stress);

}  // namespace sunder

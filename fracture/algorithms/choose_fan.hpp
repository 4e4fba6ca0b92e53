// SPDX-License-Identifier: MIT
// Where a vertex over its threshold is cut: the plane of its fan and the faces.
#pragma once

#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_plane.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {

/// A plane through a vertex and its fan.
struct FanPlane {
  /// Rest frame, unit length. Tetrahedra with their centres on the plane count as positive.
  Vec3 normal = Vec3::Zero();
  /// In rising order.
  std::vector<HalfFaceId> faces;
  /// For each tetrahedron of the star: on the positive side.
  std::vector<char> positive = {};
};

/// Among the normals that the stress allows, chooses the one with the least misaligned faces
/// (area-weighted mean of |n . n_f|), then the one that continues an existing crack. Where
/// tetrahedra have their centres on the plane, n and -n give different fans and both are judged.
/// Where fans are equally good, to 1e-6, the folded normals decide (`octant_of`): larger |x|, |y|,
/// |z|, then x, y, z.
///
/// So mirror images of a vertex across the coordinate planes through `centre` choose mirror images
/// of a fan, for any numbers of vertices and tetrahedra. The exception is a vertex ON such a plane
/// with a best fan that is not its own mirror image. It has to choose one of two images: the one
/// that the rule above gives with the axis' positive direction.
///
/// Gives no faces when every candidate has the whole star on one side.
/// `v`: the star as it is. `centre`: rest mass centre of the vertex' component, m.
/// O(star x candidates).
FanPlane choose_fan(const Cells& cells, const VertexStar& v, const PrincipalTension& tension,
                    const Vec3& centre = Vec3::Zero());

}  // namespace sunder

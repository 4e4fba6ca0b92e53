// SPDX-License-Identifier: MIT
// Cells cut exactly by a plane.
#pragma once

#include <vector>

#include "topology/base/finding.hpp"
#include "topology/cells/subdivide.hpp"
#include "topology/kernel/plane_side.hpp"

namespace sunder {

/// What a plane did to cells.
struct PlaneCut {
  CellEdit edit;
  /// The interior faces that lie in the plane now, seen from the side of the normal, in rising
  /// order.
  std::vector<HalfFaceId> faces;
  /// Vertices of before that count as lying in the plane.
  std::size_t on_plane = 0;
};

/// Divides every edge that crosses the plane where it does: no tetrahedron has corners on both
/// sides afterwards, and the section is made of whole faces. They stay sewn: `split_face` parts
/// them.
///
/// A vertex lies in the plane when it is within rounding of it (8 units in the last place of the
/// terms of its distance) or not farther than `tolerance` times an edge that would be divided;
/// 1e-12 is what hardly a number could tell from its end. The volume of the whole is kept to
/// rounding at any tolerance, that of each side as far as the section goes through points beside
/// the plane. Needs: `tolerance` from 0 to below a half. Errors: `not_a_direction`, also for an
/// offset that is not finite. O(|T|).
template <CellKernel K>
Result<PlaneCut> cut_cells(K& map, const CuttingPlane& plane, double tolerance = 1e-12);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Cells cut exactly by a plane.
#pragma once

#include <vector>

#include "topology/base/finding.hpp"
#include "topology/cells/subdivide.hpp"
#include "topology/kernel/plane_side.hpp"

namespace sunder {

/// Result of a cut of cells by a plane.
struct PlaneCut {
  CellEdit edit;
  /// The interior faces in the plane after the cut, seen from the side of the normal, in rising
  /// order.
  std::vector<HalfFaceId> faces;
  /// Number of earlier vertices that count as lying in the plane.
  std::size_t on_plane = 0;
};

/// Divides every edge at its intersection with the plane. Afterwards no tetrahedron has corners on
/// both sides, and the section consists of whole faces. The faces stay sewn; `split_face` separates
/// them.
///
/// A vertex lies in the plane if its distance is within rounding (8 units in the last place of the
/// terms of the distance), or at most `tolerance` times the length of an edge that would be
/// divided. At 1e-12 such a point can hardly be distinguished from the edge's end. The total volume
/// is kept to rounding at any tolerance. The volume of each side changes if the section passes
/// through vertices near the plane. Requires: `tolerance` from 0 to below 0.5. Errors:
/// `not_a_direction`, also for an offset that is not finite. O(|T|).
template <CellKernel K>
Result<PlaneCut> cut_cells(K& map, const CuttingPlane& plane, double tolerance = 1e-12);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Which crack a vertex over its threshold belongs to, and where that crack passes.
#pragma once

#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_plane.hpp"

namespace sunder {

/// The decision about a vertex over its threshold (`CrackMode::object`).
enum class CrackStep {
  starts,  ///< a new crack, with the fan of `choose_fan`
  grows,   ///< the front of a crack passes through it, and goes on
  waits,   ///< next to a crack: its stress is the one from before that crack
};

struct CrackChoice {
  CrackStep step = CrackStep::starts;
  CrackId crack;     ///< that grows, or next to which it is
  CrackPlane plane;  ///< of `grows`; `at` is where the vertex lies on it, its anchor
};

/// A crack goes on at a vertex if the tension there is turned from it by less, else it branches. A
/// flank holds back vertices that are turned less. cos 50 degrees (measured:
/// docs/lab/crack_objects.md).
inline constexpr double cos_branch_angle = 0.643;

/// Place and time of the test of a vertex.
struct CrackPlace {
  double h = 0;                ///< m, mean edge of the star
  Vec3 centre = Vec3::Zero();  ///< m, rest mass centre of the vertex' component
  double time = 0;             ///< s, of the stresses
  std::size_t under_way = 0;   ///< row of the first anchor with a wave (`first_under_way`)
};

/// On the front of a crack (`CrackAtVertex::is_front`) with a normal within the branch angle of the
/// tension, the crack goes on. Its normal there is the mean of the vertex' own normal, which
/// follows the tension (weight 1), and those of the crack's anchors within 3 h (`anchors_near`).
/// Its plane passes through the mean of their points and the vertex. Of several fronts it takes the
/// one that the tension is turned from least. Where these are equal to 1e-6, it takes the one with
/// the first normal, folded as in `choose_fan`.
/// Else a vertex on one side of a crack waits if the crack's normal lies within that angle. It also
/// waits where the wave of an anchor with such a normal has not come yet (`holds_back`). Else a
/// crack starts, as a branch where there are fronts.
/// O(star + anchors of the cracks there + those under way).
CrackChoice choose_crack(const Cells& cells, const VertexStar& v, const PrincipalTension& tension,
                         const CrackPlace& place);

/// Signed distances of the centres of a star's tetrahedra from a plane, m, each with the tolerance
/// within which it counts as on the plane.
struct CentreDistance {
  double distance = 0, tolerance = 0;
};
std::vector<CentreDistance> distances_of(const Cells& cells, const VertexStar& v,
                                         const CrackPlane& plane);

}  // namespace sunder

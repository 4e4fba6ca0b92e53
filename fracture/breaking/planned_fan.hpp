// SPDX-License-Identifier: MIT
// A fan between decision and split.
#pragma once

#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fan_event.hpp"

namespace sunder {

/// A fan decided on one state, to be split on a later one. Half-faces and corners keep their names,
/// so several can be decided on the same state and split one after the other.
struct PlannedFan {
  VertexStar v;  ///< as it was when the fan was decided on
  Vec3 normal = Vec3::Zero();
  double stress = 0, strength = 0;  ///< Pa, when it was decided
  /// A flag for each tetrahedron of the star: on the positive side.
  std::vector<char> positive;
  /// With `CrackMode::object`: its crack, and a point of the plane, m, rest frame.
  CrackId crack;
  Vec3 at = Vec3::Zero();
  double untested = 0;  ///< s, since fractures were looked for before
};

}  // namespace sunder

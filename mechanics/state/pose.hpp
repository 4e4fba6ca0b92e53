// SPDX-License-Identifier: MIT
// Position and orientation of a component as a rigid body.
#pragma once

#include <Eigen/Geometry>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// Placement of a component's rest configuration, simulated or drawn: x = centre + orientation
/// (rest_position - rest_centre).
struct Pose {
  Vec3 centre = Vec3::Zero();                                       ///< m, of the rest centre
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit; body to world
};

}  // namespace sunder

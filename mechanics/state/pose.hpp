// SPDX-License-Identifier: MIT
// Where a component is, as a rigid body.
#pragma once

#include <Eigen/Geometry>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// Where a component's rest configuration is put, simulated or drawn:
/// x = centre + orientation (rest_position - rest_centre).
struct Pose {
  Vec3 centre = Vec3::Zero();                                       ///< m, where its rest centre is
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit; body to world
};

}  // namespace sunder

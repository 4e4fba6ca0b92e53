// SPDX-License-Identifier: MIT
// The vectors and matrices of three dimensions, in double precision.
#pragma once

#include <Eigen/Core>

namespace sunder {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace sunder

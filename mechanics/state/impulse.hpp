// SPDX-License-Identifier: MIT
// Impulses with their moments.
#pragma once

#include <Eigen/Core>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// An impulse, N s, followed by its moment about the origin of coordinates, N m s; also momentum
/// and angular momentum.
using Impulse = Eigen::Matrix<double, 6, 1>;

/// The impulse `linear` (N s) at `point` (m), with its moment.
inline Impulse impulse_at(const Vec3& point, const Vec3& linear) {
  Impulse sum;
  sum << linear, point.cross(linear);
  return sum;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Impulses with their moments.
#pragma once

#include <Eigen/Core>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// An impulse, N s, and below it its moment about the origin of coordinates, N m s; or momentum and
/// angular momentum.
using Impulse = Eigen::Matrix<double, 6, 1>;

/// An impulse (N s) that acts at `point` (m).
inline Impulse impulse_at(const Vec3& point, const Vec3& linear) {
  Impulse sum;
  sum << linear, point.cross(linear);
  return sum;
}

}  // namespace sunder

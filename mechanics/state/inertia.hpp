// SPDX-License-Identifier: MIT
// Inertia of points.
#pragma once

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// Adds m (|x|^2 I - x x^T), kg m^2, of a point of mass m (kg) at x (m) from the centre.
inline void add_inertia(Mat3& inertia, double mass, const Vec3& arm) {
  inertia -= mass * arm * arm.transpose();
  inertia.diagonal().array() += mass * arm.squaredNorm();
}

}  // namespace sunder

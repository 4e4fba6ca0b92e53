// SPDX-License-Identifier: MIT
// Gravity and the number of steps of a scene.
#include "fracture/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "topology/base/whole_number.hpp"

namespace sunder {

Vec3 gravity_at(const GravitySettings& gravity, double time) {
  if (gravity.ramp_time <= 0) return gravity.acceleration;
  return gravity.acceleration * std::min(1.0, time / gravity.ramp_time);
}

std::uint64_t step_count(const Scene& scene) {
  // 1 s of 1 ms steps is 1000 steps, although 1 / 1e-3 may come out a little above.
  return whole_number<std::uint64_t>(std::ceil(scene.duration / scene.integrator.time_step - 1e-6));
}

}  // namespace sunder

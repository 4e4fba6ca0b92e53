// SPDX-License-Identifier: MIT
// How many steps a scene takes.
#include "fracture/simulation/scene.hpp"

#include <cmath>

namespace sunder {

std::uint64_t step_count(const Scene& scene) {
  // 1 s of 1 ms steps is 1000 steps, although 1 / 1e-3 may come out a little above.
  return static_cast<std::uint64_t>(std::ceil(scene.duration / scene.integrator.time_step - 1e-6));
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// A scene that falls and breaks, at steps of h, h/4, h/16: whether the outcome is that of the step.
#pragma once

#include "fracture/scene/scene.hpp"

namespace sunder::accuracy {

/// The outcome of a run of a scene.
struct FallOutcome {
  double first_fan = 0;  ///< s; 0: none
  std::size_t fans = 0;
  std::size_t pieces = 0;
  double largest_share = 1;  ///< mass of the largest piece over all
  double deepest = 0;        ///< m, deepest overlap of a contact
  std::size_t sub_steps = 0;
};

/// A cube of 0.2 m of concrete in 6 x 6 x 6 cells, tilted, spinning, falls at 3 m/s on a plane 1 mm
/// below: it comes with an edge ahead, breaks there, and rolls on.
Scene falling_cube(int cells = 6);

/// Runs the scene for its duration.
FallOutcome run_fall(const Scene& scene);

}  // namespace sunder::accuracy

// SPDX-License-Identifier: MIT
// A scene in one line, for the start of a run.
#pragma once

#include <string>

#include "fracture/scene/scene.hpp"

namespace sunder {

/// Name, bodies and tetrahedra, stiffness and strength, motion and loads; duration, steps and kind
/// of cracks: "bunny: 1 body of 6 145 tetrahedra, E 1 GPa, strength 600 kPa, falls at 5 m/s; 0.12 s
/// in 600 steps, cracks: paper". No line break. Needs: a scene without errors.
std::string scene_line(const Scene& scene);

}  // namespace sunder

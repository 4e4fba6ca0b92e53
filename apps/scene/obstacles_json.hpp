// SPDX-License-Identifier: MIT
// Obstacles in report.json, for programs that draw a finished run.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "mechanics/contact/shapes/obstacle.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// One object each, in SI units: "plane" (normal, offset), "sphere" (center, radius), "box"
/// (center, half_extent, orientation) or "mesh" (points, triangles, translation, orientation);
/// velocity, and mass of a free one. Orientations are quaternions w, x, y, z.
nlohmann::ordered_json obstacles_json(std::span<const Obstacle> obstacles);

/// The obstacles of such an array. Errors: bad_obstacles (not as `obstacles_json` writes them),
/// those of `make_solid_surface`.
Result<std::vector<Obstacle>> read_obstacles(const nlohmann::json& array);

}  // namespace sunder

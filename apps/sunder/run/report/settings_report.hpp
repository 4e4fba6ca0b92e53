// SPDX-License-Identifier: MIT
// What a scene's accuracy chose and how long a run may take, for people and for report.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/scene/scene_json.hpp"

namespace sunder {

/// `settings` of report.json: `accuracy`; `chosen`, each with key, value and reason; `expected`,
/// the time in flight, with tetrahedra, steps, `step_ms` and `seconds`.
nlohmann::ordered_json settings_json(const SceneFile& file);

/// The same, a line each, as a run tells it before its first step.
std::string settings_lines(const SceneFile& file);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Settings chosen by a scene's accuracy and the expected time of its run, as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/scene/scene_json.hpp"

namespace sunder {

/// `settings` of report.json: `accuracy`; `chosen`, each with key, value and reason; `expected`,
/// the time in flight, with tetrahedra, steps, `step_ms` and `seconds`.
nlohmann::ordered_json settings_json(const SceneFile& file);

/// The same as text, one line each: printed by `sunder run --verbose` before its first step.
std::string settings_lines(const SceneFile& file);

}  // namespace sunder

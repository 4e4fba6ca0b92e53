// SPDX-License-Identifier: MIT
// Settings chosen by a scene's accuracy and the expected time of its run, as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/scene/scene_json.hpp"
#include "fracture/scene/expected_time.hpp"

namespace sunder {

/// `settings` of report.json: `accuracy`; `chosen`, each with key, value and reason; `expected`,
/// with tetrahedra, steps, `step_ms` (of a step in flight), `seconds` of computing and their
/// `phases` (`ExpectedTime`).
nlohmann::ordered_json settings_json(const SceneFile& file, const ExpectedTime& time);

/// The same as text, one line each: printed by `sunder run --verbose` before its first step.
std::string settings_lines(const SceneFile& file, const ExpectedTime& time);

/// The expected time of a run in words: "about 40 s", "about 3 min", "at most a few seconds".
std::string time_words(double seconds);

}  // namespace sunder

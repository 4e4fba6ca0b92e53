// SPDX-License-Identifier: MIT
// The schema of scene files, which tells editors what the reader checks.
#pragma once

#include <nlohmann/json.hpp>

namespace sunder {

/// The JSON schema (draft 2020-12) of scene files with every default, unit and range: what stands
/// in meshes/scenes/scene.schema.json.
nlohmann::ordered_json scene_schema();

}  // namespace sunder

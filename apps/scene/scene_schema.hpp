// SPDX-License-Identifier: MIT
// The schema of scene files, which gives editors the checks of the reader.
#pragma once

#include <nlohmann/json.hpp>

namespace sunder {

/// The JSON schema (draft 2020-12) of scene files with every default, unit and range: the content
/// of meshes/scenes/scene.schema.json.
nlohmann::ordered_json scene_schema();

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Scenes with everything that they name in memory.
#pragma once

#include "apps/host/sunder.h"
#include "apps/scene/scene_json.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Reads the scene of a host. Structs of older versions are accepted by their sizes. Errors: those
/// of `read_scene`, bad_size (a struct smaller than its first version), repeated_name.
Result<SceneFile> read_scene_in_memory(const sunder_scene& scene);

/// The same for one body (`read_body`).
Result<BodySettings> read_body_in_memory(const sunder_scene& body);

}  // namespace sunder

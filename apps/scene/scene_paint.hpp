// SPDX-License-Identifier: MIT
// Strengths painted on the meshes of a scene.
#pragma once

#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_text.hpp"
#include "fracture/scene/scene.hpp"

namespace sunder {

/// Fills `strength.painted` of every body with a `strength.field` from its mesh's file. `text`: the
/// scene as it was read; `files`: the readers of its meshes. Errors: those of `read_point_field`,
/// at the scene's line that names the field. Bodies without a mesh are left alone.
std::vector<Finding> paint_strengths(Scene& scene, const SceneText& text, const SceneFiles& files);

}  // namespace sunder

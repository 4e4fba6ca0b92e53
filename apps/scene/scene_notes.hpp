// SPDX-License-Identifier: MIT
// Requests of a scene that will have no effect, though nothing in it is wrong.
#pragma once

#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_text.hpp"

namespace sunder {

/// Notes on a scene that was read without errors: impact windows asked for (`impact.window` given
/// as true) with a method that has none.
std::vector<Finding> scene_notes(const SceneText& text, const SceneFile& file);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Materials of scene files that have a name: "material": "glass", or {"name": "glass", ...}.
#pragma once

#include <string>

#include "apps/scene/reading/scene_values.hpp"
#include "mechanics/state/settings/material.hpp"

namespace sunder::reading {

/// Writes each material of a body that is a text as an object with the key `name`, on the same
/// line. Leaves a scene without such materials alone.
void write_names_out(SceneText& text);

/// Sets `material` to the material of this name. `given`: the material's object, at `pointer`. If
/// it gives a fracture energy and no toughness, the toughness follows from that energy. Error:
/// unknown_name with the nearest name.
void start_from_name(const Context& c, const std::string& name, const json& given,
                     const std::string& pointer, Material& material);

}  // namespace sunder::reading

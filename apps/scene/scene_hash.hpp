// SPDX-License-Identifier: MIT
// Numbers that tell scenes and texts apart, for logs that must not be replayed on another scene.
#pragma once

#include <cstdint>
#include <string>

#include "apps/scene/scene_json.hpp"
#include "topology/base/fnv1a.hpp"

namespace sunder {

/// Sixteen hexadecimal digits.
std::string hex_digits(std::uint64_t value);

/// Sixteen hexadecimal digits (FNV-1a) of everything a run's outcome depends on: every key with its
/// value, given or default, and the content of meshes and face lists, wherever they lie. Names,
/// description and output are left out. O(meshes).
std::string scene_hash(SceneFile file);

}  // namespace sunder

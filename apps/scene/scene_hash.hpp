// SPDX-License-Identifier: MIT
// Numbers that tell scenes and texts apart, for logs that must not be replayed on another scene.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/scene/scene_json.hpp"

namespace sunder {

/// FNV-1a, 64 bits: against mistakes, not against forgery.
struct Fnv1a {
  std::uint64_t value = 0xcbf29ce484222325ULL;
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
  }
};

/// Sixteen hexadecimal digits.
std::string hex_digits(std::uint64_t value);

/// Sixteen hexadecimal digits (FNV-1a) of everything a run's outcome depends on: every key with its
/// value, said or default, and what the meshes and face lists hold, wherever they lie. Names,
/// description and output are left out. O(meshes).
std::string scene_hash(SceneFile file);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Scenes given as JSON, for tests of the reader of scenes.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"

namespace sunder::test {

/// Reads a scene given as JSON, with its meshes in the repository's meshes/.
inline Result<SceneFile> read(const nlohmann::json& scene,
                              const std::vector<std::string>& settings = {}) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("sunder_scene_" + std::to_string(getpid()) + ".json");
  std::ofstream(path) << scene.dump(1);
  Result<SceneFile> file = read_scene(path, settings);
  std::filesystem::remove(path);
  return file;
}

inline nlohmann::json cube_scene() { return {{"bodies", {{{"mesh", SUNDER_MESHES "/cube.msh"}}}}}; }

inline std::multiset<std::string> codes(const std::vector<Finding>& findings) {
  std::multiset<std::string> all;
  for (const Finding& f : findings) all.insert(f.code);
  return all;
}

}  // namespace sunder::test

// SPDX-License-Identifier: MIT
// Scenes from Python: the path of a file, or text with meshes in memory.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/python/bindings.hpp"
#include "apps/scene/scene_json.hpp"

namespace sunder::python {

/// A scene as `_api.py` hands it over.
struct SceneInput {
  /// Path of a scene file; empty with `text`.
  std::string path;
  /// JSON, and the folder of the files that it names.
  std::string text, folder;
  /// Meshes by the names that the scene has for them.
  std::map<std::string, std::shared_ptr<Mesh>> meshes;
  /// Each "dotted.path=value".
  std::vector<std::string> settings;
};

/// Reads it. `findings` gets warnings and notes. Throws Refused.
SceneFile read_input(const SceneInput& input, std::vector<Finding>& findings);

/// Reads one body, given as the text of a scene's entry. Throws Refused.
BodySettings read_body_input(const SceneInput& input);

}  // namespace sunder::python

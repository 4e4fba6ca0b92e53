// SPDX-License-Identifier: MIT
#include "apps/python/scene_input.hpp"

#include <iterator>

#include "apps/python/findings.hpp"

namespace sunder::python {

SceneFile read_input(const SceneInput& input, std::vector<Finding>& findings) {
  Result<SceneFile> file;
  if (input.text.empty()) {
    file = read_scene(input.path, input.settings);
  } else {
    SceneFiles files = files_in(input.folder);
    const auto read_mesh_file = files.mesh;
    const auto read_surface = files.surface;
    files.mesh = [&](const std::string& name) {
      const auto found = input.meshes.find(name);
      if (found == input.meshes.end()) return read_mesh_file(name);
      return Result<TetMesh>(tet_mesh_of(FileMesh(found->second->mesh)));
    };
    files.surface = [&](const std::string& name) {
      const auto found = input.meshes.find(name);
      if (found == input.meshes.end()) return read_surface(name);
      return Result<FileMesh>(found->second->mesh);
    };
    file = read_scene({input.text, "scene"}, files, input.settings);
  }
  findings.insert(findings.end(), file.findings.begin(), file.findings.end());
  return value_of(std::move(file));
}

}  // namespace sunder::python

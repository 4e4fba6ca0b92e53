// SPDX-License-Identifier: MIT
#include "apps/python/scene_input.hpp"

#include <iterator>

#include "apps/python/findings.hpp"

namespace sunder::python {

namespace {

SceneFiles files_of(const SceneInput& input) {
  SceneFiles files = files_in(input.folder);
  const auto read_mesh_file = files.mesh;
  const auto read_surface = files.surface;
  files.mesh = [&input, read_mesh_file](const std::string& name) {
    const auto found = input.meshes.find(name);
    if (found == input.meshes.end()) return read_mesh_file(name);
    return Result<TetMesh>(tet_mesh_of(FileMesh(found->second->mesh)));
  };
  files.surface = [&input, read_surface](const std::string& name) {
    const auto found = input.meshes.find(name);
    if (found == input.meshes.end()) return read_surface(name);
    return Result<FileMesh>(found->second->mesh);
  };
  return files;
}

}  // namespace

SceneFile read_input(const SceneInput& input, std::vector<Finding>& findings) {
  Result<SceneFile> file = input.text.empty()
                               ? read_scene(input.path, input.settings)
                               : read_scene({input.text, "scene"}, files_of(input), input.settings);
  findings.insert(findings.end(), file.findings.begin(), file.findings.end());
  return value_of(std::move(file));
}

BodySettings read_body_input(const SceneInput& input) {
  return value_of(read_body({input.text, "body"}, files_of(input), input.settings));
}

}  // namespace sunder::python

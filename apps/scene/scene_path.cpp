// SPDX-License-Identifier: MIT
// Scenes by their paths, with the files that they name.
#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "apps/scene/scene_json.hpp"
#include "topology/io/face_list.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {

Result<SceneFile> read_scene(const std::filesystem::path& path,
                             std::span<const std::string> settings) {
  std::ifstream in(path, std::ios::binary);
  std::error_code not_a_folder;
  if (!in || std::filesystem::is_directory(path, not_a_folder)) {
    return Finding{.code = "cannot_open",
                   .ids = {},
                   .text = fmt::format("cannot open the scene file {}", path.string()),
                   .remedy =
                       "give the path of a scene's JSON file, such as "
                       "meshes/scenes/bunny.json",
                   .file = path.string()};
  }
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  const std::filesystem::path folder = path.parent_path();
  const SceneFiles files{
      .mesh = [&](const std::string& name) { return read_mesh(folder / name); },
      .surface =
          [&](const std::string& name) {
            return read_file_mesh(folder / name, {.simplices = true});
          },
      .faces = [&](const std::string& name) { return read_face_list(folder / name); },
      .point_field =
          [&](const std::string& name, const std::string& field) {
            return read_point_field(folder / name, field);
          }};
  return read_scene({bytes, path.string()}, files, settings);
}

}  // namespace sunder

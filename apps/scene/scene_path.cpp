// SPDX-License-Identifier: MIT
// Scenes by their paths, with the files that they name.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "apps/scene/scene_json.hpp"
#include "topology/io/face_list.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {

namespace {

/// Bodies of both orders have straight edges: a mesh with curved cells is another body than the one
/// that would break.
Result<TetMesh> refuse_curved(Result<TetMesh> mesh) {
  for (Finding& f : mesh.findings) {
    if (f.code != "curved_cells") continue;
    f.severity = Severity::error;
    mesh.value.reset();
  }
  return mesh;
}

/// Why a file that a scene names is not read where it may only name its own.
std::optional<Finding> refusal(const std::filesystem::path& folder, const std::string& name) {
  if (name == "-") {
    return Finding{.code = "not_a_file",
                   .text = "it is standard input, which is not read with --confined",
                   .remedy = "name a file in the scene's folder"};
  }
  std::error_code none, unknown;
  const std::filesystem::path root =
      std::filesystem::canonical(folder.empty() ? "." : folder, unknown);
  const std::filesystem::path path = std::filesystem::weakly_canonical(root / name, unknown);
  const auto parted = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  if (unknown || parted.first != root.end()) {
    return Finding{.code = "outside_folder",
                   .text =
                       "it lies outside the folder of the scene, and nothing outside it is read "
                       "with --confined",
                   .remedy =
                       "put the file into the scene's folder, or leave out --confined if you "
                       "trust the scene"};
  }
  // Reading a FIFO or a device would wait; a missing file has an error of its own.
  const auto status = std::filesystem::status(path, none);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) return {};
  return Finding{.code = "not_a_file",
                 .text = "it is no ordinary file, and nothing else is read with --confined",
                 .remedy = "name an ordinary file"};
}

}  // namespace

Result<SceneFile> read_scene(const std::filesystem::path& path,
                             std::span<const std::string> settings, SceneReach reach) {
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
  return read_scene({bytes, path.string()}, files_in(path.parent_path(), reach), settings);
}

SceneFiles files_in(const std::filesystem::path& folder, SceneReach reach) {
  // The result of `read` for a file of this name, if the scene may name it.
  const auto within = [=]<class Read>(const std::string& name, const Read& read) {
    if (reach == SceneReach::own_folder) {
      if (auto finding = refusal(folder, name)) {
        return decltype(read(folder))(std::move(*finding));
      }
    }
    return read(folder / name);
  };
  using Path = std::filesystem::path;
  return {
      .mesh =
          [=](const std::string& name) {
            return within(name, [](const Path& file) { return refuse_curved(read_mesh(file)); });
          },
      .surface =
          [=](const std::string& name) {
            return within(
                name, [](const Path& file) { return read_file_mesh(file, {.simplices = true}); });
          },
      .faces =
          [=](const std::string& name) {
            return within(name, [](const Path& file) { return read_face_list(file); });
          },
      .point_field =
          [=](const std::string& name, const std::string& field) {
            return within(name, [&](const Path& file) { return read_point_field(file, field); });
          }};
}

}  // namespace sunder

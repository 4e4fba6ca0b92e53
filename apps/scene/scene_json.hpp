// SPDX-License-Identifier: MIT
// Scene files: JSON, SI units, every key checked.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/output_settings.hpp"
#include "fracture/scene/choose_settings.hpp"
#include "fracture/scene/scene.hpp"
#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// What a scene file says: the scene, and what a run shall write of it.
struct SceneFile {
  /// For editors only.
  std::string schema;
  std::string description;
  Accuracy accuracy = Accuracy::good;
  /// What `accuracy` chose of the scene below (`choose_settings`).
  std::vector<Choice> choices;
  Scene scene;
  OutputSettings output;
};

/// Which files a scene may name: any, or, of a scene that somebody else made, only ordinary files
/// in its own folder and below, once links are followed.
enum class SceneReach : bool { anywhere, own_folder };

/// The scene in the JSON file `path` with its meshes, after `settings` (each `dotted.path=value`,
/// such as "bodies.0.material.density=2000"). Mesh files are relative to the scene's folder.
/// Rotations are
/// `{"axis": [x, y, z], "angle": degrees}`. What is not said `choose_settings`
/// chooses, or is the C++ structs' default.
/// Errors, all of them at once, with file, line, place, value, what is allowed and a remedy:
/// cannot_open, syntax_error, repeated_key, nested_too_deeply, bad_setting, unknown_key (naming the
/// nearest known one), missing_key, wrong_type, unknown_name, zero_direction, the findings of
/// `read_mesh` and `check_mesh`, and those of `check_scene` and `check_output`, outside_folder and
/// not_a_file (`SceneReach::own_folder`).
Result<SceneFile> read_scene(const std::filesystem::path& path,
                             std::span<const std::string> settings = {},
                             SceneReach reach = SceneReach::anywhere);

/// What reads the files that a scene names, each by its name as it stands in the scene.
struct SceneFiles {
  std::function<Result<TetMesh>(const std::string& name)> mesh;
  std::function<Result<FileMesh>(const std::string& name)> surface;
  std::function<Result<std::vector<std::array<std::uint32_t, 3>>>(const std::string& name)> faces;
  std::function<Result<std::vector<double>>(const std::string& name, const std::string& field)>
      point_field;
};

/// The bytes of a scene in memory; `name` stands in the findings.
struct SceneBytes {
  std::string_view text;
  std::string name;
};

/// The same for a scene in memory, whose other files `files` reads.
Result<SceneFile> read_scene(const SceneBytes& scene, const SceneFiles& files,
                             std::span<const std::string> settings = {});

}  // namespace sunder

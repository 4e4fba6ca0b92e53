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

/// Content of a scene file: the scene, and the output of a run.
struct SceneFile {
  /// For editors only.
  std::string schema;
  std::string description;
  Accuracy accuracy = Accuracy::good;
  /// Settings of `scene` that `accuracy` chose (`choose_settings`).
  std::vector<Choice> choices;
  Scene scene;
  OutputSettings output;
};

/// Files that a scene may name: any, or (for untrusted scenes) only ordinary files in its own
/// folder and below, after following links.
enum class SceneReach : bool { anywhere, own_folder };

/// Reads the scene in the JSON file `path` with its meshes, after applying `settings` (each
/// `dotted.path=value`, such as "bodies.0.material.density=2000"). Mesh files are relative to the
/// scene's folder. Rotations are `{"axis": [x, y, z], "angle": degrees}`. Keys that are left out
/// are set by `choose_settings`, or have the defaults of the C++ structs. Errors, all at once, with
/// file, line, place, value, allowed values and a remedy: cannot_open, syntax_error, repeated_key,
/// nested_too_deeply, bad_setting, unknown_key (naming the nearest known one), missing_key,
/// wrong_type, unknown_name, zero_direction, the findings of `read_mesh` and `check_mesh`, and
/// those of `check_scene` and `check_output`, outside_folder and not_a_file
/// (`SceneReach::own_folder`).
Result<SceneFile> read_scene(const std::filesystem::path& path,
                             std::span<const std::string> settings = {},
                             SceneReach reach = SceneReach::anywhere);

/// Readers of the files that a scene names. Each gets the name as it stands in the scene.
struct SceneFiles {
  std::function<Result<TetMesh>(const std::string& name)> mesh;
  std::function<Result<FileMesh>(const std::string& name)> surface;
  std::function<Result<std::vector<std::array<std::uint32_t, 3>>>(const std::string& name)> faces;
  std::function<Result<std::vector<double>>(const std::string& name, const std::string& field)>
      point_field;
};

/// Readers of files by their paths from a folder. Errors: as `read_scene` of a path.
SceneFiles files_in(const std::filesystem::path& folder, SceneReach reach = SceneReach::anywhere);

/// The bytes of a scene in memory; `name` stands in the findings.
struct SceneBytes {
  std::string_view text;
  std::string name;
};

/// The same for a scene in memory. `files` reads its other files.
Result<SceneFile> read_scene(const SceneBytes& scene, const SceneFiles& files,
                             std::span<const std::string> settings = {});

/// Reads one body for `add_body`, an object as in "bodies" of a scene; `name` stands in the
/// findings. `settings` begin with "bodies.0.". Errors: those of `read_scene` about a body, except
/// those of `check_scene`, which `add_body` finds; not_one_body.
Result<BodySettings> read_body(const SceneBytes& body, const SceneFiles& files,
                               std::span<const std::string> settings = {});

}  // namespace sunder

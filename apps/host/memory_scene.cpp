// SPDX-License-Identifier: MIT
#include "apps/host/memory_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "topology/io/face_list.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/check.hpp"

namespace sunder {
namespace {

/// What a name of the scene leads to: bytes of a file, or a mesh of arrays.
using Named = std::variant<std::string_view, TetMesh>;

/// The files and meshes of a scene by name.
struct MemoryFiles {
  std::map<std::string, Named, std::less<>> named;
  std::vector<Finding> findings;

  void add(const char* name, Named content) {
    if (named.emplace(name, std::move(content)).second) return;
    findings.push_back({.code = "repeated_name",
                        .text = std::string("two files or meshes are called ") + name,
                        .remedy = "give each a name of its own",
                        .file = name});
  }

  Result<const Named*> find(const std::string& name) const {
    if (const auto file = named.find(name); file != named.end()) return &file->second;
    std::string known;
    for (const auto& [other, content] : named) known += (known.empty() ? "" : ", ") + other;
    return Finding{.code = "cannot_open",
                   .text = "there is no file " + name,
                   .remedy = known.empty() ? "give it with the scene" : "there are: " + known,
                   .file = name};
  }
};

/// A struct of the caller, whose version may be older: fields that it does not have are 0.
template <class T>
bool take(T& result, const T* source, std::size_t first_size, MemoryFiles& files,
          const char* type) {
  result = {};
  if (source->size >= first_size) {
    std::memcpy(&result, source, std::min<std::size_t>(source->size, sizeof(T)));
    return true;
  }
  files.findings.push_back({.code = "bad_size",
                            .text = std::string("the size of a ") + type + " is too small",
                            .remedy = std::string("set its field size to sizeof(") + type + ")"});
  return false;
}

TetMesh mesh_of(const sunder_mesh& arrays) {
  TetMesh mesh;
  mesh.points.resize(arrays.point_count);
  mesh.tetrahedra.resize(arrays.tetrahedron_count);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    std::copy_n(arrays.points + 3 * i, 3, mesh.points[i].begin());
  }
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    std::copy_n(arrays.tetrahedra + 4 * t, 4, mesh.tetrahedra[t].begin());
  }
  if (arrays.regions != nullptr) {
    mesh.region.assign(arrays.regions, arrays.regions + arrays.tetrahedron_count);
  }
  return mesh;
}

MemoryFiles files_of(const sunder_scene& scene) {
  MemoryFiles files;
  for (std::uint32_t i = 0; i < scene.file_count; ++i) {
    const sunder_file& file = scene.files[i];
    files.add(file.name, std::string_view(static_cast<const char*>(file.bytes), file.size));
  }
  for (std::uint32_t i = 0; i < scene.mesh_count; ++i) {
    sunder_mesh mesh;
    if (take(mesh, scene.meshes[i], sizeof(sunder_mesh), files, "sunder_mesh")) {
      files.add(mesh.name, mesh_of(mesh));
    }
  }
  return files;
}

/// What a reader makes of a file. `of_mesh` makes the same of a mesh in memory.
template <class T, class Read, class OfMesh>
Result<T> read_found(const MemoryFiles& files, const std::string& name, const Read& read,
                     const OfMesh& of_mesh) {
  const Result<const Named*> found = files.find(name);
  if (found) {
    if (const auto* bytes = std::get_if<std::string_view>(*found)) return read(*bytes);
    return of_mesh(std::get<TetMesh>(**found));
  }
  Result<T> missing;
  missing.findings = found.findings;
  return missing;
}

Finding not_in_arrays(const std::string& name) {
  return {.code = "not_a_file",
          .text = "a mesh of arrays has no such content",
          .remedy = "give a file in memory under this name",
          .file = name};
}

/// Arrays as an obstacle. Rows are used unchecked behind this.
Result<FileMesh> checked_surface(const TetMesh& mesh) {
  Result<FileMesh> surface;
  surface.findings = check_mesh(mesh, Severity::warning);
  if (!has_error(surface.findings)) surface.value = file_mesh_of(mesh);
  return surface;
}

SceneFiles readers_of(const MemoryFiles& files) {
  using Faces = std::vector<std::array<std::uint32_t, 3>>;
  return {
      .mesh =
          [&](const std::string& name) {
            return read_found<TetMesh>(
                files, name, [&](std::string_view b) { return read_mesh(b, name); },
                [](const TetMesh& mesh) { return Result<TetMesh>(mesh); });
          },
      .surface =
          [&](const std::string& name) {
            return read_found<FileMesh>(
                files, name,
                [&](std::string_view b) { return read_file_mesh(b, name, {.simplices = true}); },
                [](const TetMesh& mesh) { return checked_surface(mesh); });
          },
      .faces =
          [&](const std::string& name) {
            return read_found<Faces>(
                files, name, [&](std::string_view b) { return read_face_list(b, name); },
                [&](const TetMesh&) { return Result<Faces>(not_in_arrays(name)); });
          },
      .point_field =
          [&](const std::string& name, const std::string& field) {
            using Values = std::vector<double>;
            return read_found<Values>(
                files, name, [&](std::string_view b) { return read_point_field(b, name, field); },
                [&](const TetMesh&) { return Result<Values>(not_in_arrays(name)); });
          }};
}

/// Reads `given` by `read(bytes, files, settings)`.
template <class T, class Read>
Result<T> read_in_memory(const sunder_scene& given, const Read& read) {
  MemoryFiles files;
  sunder_scene scene;
  if (take(scene, &given, offsetof(sunder_scene, reserved), files, "sunder_scene")) {
    files = files_of(scene);
  }
  if (!files.findings.empty()) {
    Result<T> refused;
    refused.findings = std::move(files.findings);
    return refused;
  }
  const std::vector<std::string> settings(scene.settings, scene.settings + scene.setting_count);
  return read(SceneBytes{{scene.text, scene.text_size}, scene.name}, readers_of(files), settings);
}

}  // namespace

Result<SceneFile> read_scene_in_memory(const sunder_scene& given) {
  return read_in_memory<SceneFile>(given, [](const SceneBytes& scene, const SceneFiles& files,
                                             std::span<const std::string> settings) {
    return read_scene(scene, files, settings);
  });
}

Result<BodySettings> read_body_in_memory(const sunder_scene& given) {
  return read_in_memory<BodySettings>(given, [](const SceneBytes& body, const SceneFiles& files,
                                                std::span<const std::string> settings) {
    return read_body(body, files, settings);
  });
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Internal to topology/io: what reading a mesh from memory and from its path share.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {

/// Takes what a ReadFailure ends into the findings.
template <class Work>
void guarded(std::vector<Finding>& findings, Work work) {
  try {
    work();
  } catch (ReadFailure& failure) {
    findings.push_back(std::move(failure.finding));
  }
}

/// A mesh and the format that it was read as.
struct ReadBytes {
  Result<FileMesh> mesh;
  std::optional<MeshFormat> format;
};

/// What read_file_mesh does once bytes are there, packed or not.
ReadBytes read_bytes(FileSource source, const std::filesystem::path& path,
                     const ReadOptions& options);

/// What read_mesh makes of a file.
Result<TetMesh> tetrahedra_of(Result<FileMesh>&& file, std::string_view name);

/// What read_point_field makes of a file.
Result<std::vector<double>> point_field_of(Result<FileMesh>&& mesh, std::string_view name,
                                           std::string_view field);

}  // namespace sunder::io

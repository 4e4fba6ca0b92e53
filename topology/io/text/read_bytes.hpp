// SPDX-License-Identifier: MIT
// Internal to topology/io: code shared by reading a mesh from memory and from its path.
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

/// Does the work; a ReadFailure that ends it becomes a finding.
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

/// The work of read_file_mesh once bytes are there, packed or not.
ReadBytes read_bytes(FileSource source, const std::filesystem::path& path,
                     const ReadOptions& options);

/// The result of read_mesh for a file.
Result<TetMesh> tetrahedra_of(Result<FileMesh>&& file, std::string_view name);

/// The result of read_point_field for a file.
Result<std::vector<double>> point_field_of(Result<FileMesh>&& mesh, std::string_view name,
                                           std::string_view field);

}  // namespace sunder::io

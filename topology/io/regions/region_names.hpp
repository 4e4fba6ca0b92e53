// SPDX-License-Identifier: MIT
// Internal to topology/io: names of regions in a file next to a mesh, if its format has none.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// `PATH.regions`; for TetGen's files, whichever is named, `STEM.node.regions`.
std::filesystem::path names_beside(const std::filesystem::path& path, MeshFormat format);

/// Writes the names, a line each: dimension, region, name in double quotes. Errors: cannot_write.
std::optional<Finding> write_region_names(const std::filesystem::path& path, const FileMesh& mesh);

/// The names in such a file's text, by dimension. Throws ReadFailure (bad_number, bad_name).
std::array<std::map<std::int32_t, std::string>, 4> read_region_names(std::string_view text);

}  // namespace sunder::io

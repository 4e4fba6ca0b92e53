// SPDX-License-Identifier: MIT
// Internal to topology/io: names of regions in a file beside a mesh whose format cannot hold them.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "topology/file_mesh.hpp"
#include "topology/finding.hpp"

namespace sunder::io {

/// `PATH.regions`.
std::filesystem::path names_beside(const std::filesystem::path& path);

/// Writes the names, a line each: dimension, region, name in double quotes. Errors: cannot_write.
std::optional<Finding> write_region_names(const std::filesystem::path& path, const FileMesh& mesh);

/// Puts the names of such a file's text into `mesh`. Throws ReadFailure (bad_number, bad_name,
/// unknown_section).
void read_region_names(std::string_view text, FileMesh& mesh);

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// Internal to topology/io: VTU (VTK XML unstructured grids) with all its cells and columns.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Reads the simplices and columns of every piece. Throws ReadFailure.
Draft read_vtu(std::string_view text);

/// Writes all cells and columns as one VTU file with raw appended data, each column in its type.
/// Errors: cannot_write.
std::vector<Finding> write_vtu(const std::filesystem::path& path, const FileMesh& mesh);

}  // namespace sunder::io

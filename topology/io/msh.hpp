// SPDX-License-Identifier: MIT
// Internal to topology/io: Gmsh's MSH format.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "topology/finding.hpp"
#include "topology/io/draft.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder::io {

/// Reads MSH 2.x or 4.1 ASCII. Throws ReadFailure.
Draft read_msh(std::string_view text);

/// Writes MSH 4.1 ASCII: one block of nodes, one block of elements for each run of one region.
std::vector<Finding> write_msh(const std::filesystem::path& path, const TetMesh& mesh);

/// True when the numbers can stand in an MSH file: positive and each only once.
bool are_msh_numbers(const std::vector<std::int64_t>& numbers);

}  // namespace sunder::io

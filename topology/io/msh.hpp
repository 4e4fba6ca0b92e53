// SPDX-License-Identifier: MIT
// Internal to topology/io: Gmsh's MSH format.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Reads MSH 1, 2.x, 4.0 or 4.1, text or binary. Throws ReadFailure.
Draft read_msh(std::string_view text);

/// The bytes of an MSH file: `version` 10, 22, 40 or 41. In versions 4 one block of nodes, and one
/// of elements for each run of one entity. Needs: version 1 is text.
std::string write_msh(const FileMesh& mesh, int version, bool is_binary);

/// The numbers of the cells of each dimension.
std::vector<std::span<const std::int64_t>> cell_numbers(const FileMesh& mesh);

/// True when the numbers can stand in an MSH file: positive and each only once among all lists.
bool are_msh_numbers(std::span<const std::span<const std::int64_t>> lists);

}  // namespace sunder::io

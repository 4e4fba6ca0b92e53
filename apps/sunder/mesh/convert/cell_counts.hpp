// SPDX-License-Identifier: MIT
// Counts of a mesh by kinds of cells, as `sunder convert` prints them.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// "12 hexahedra, 4 prisms": kinds with at least one cell, in the order of `all_cell_kinds`.
std::string counts_text(const std::array<std::size_t, cell_kinds>& counts);

/// "8 points, 12 triangles": the same of a mesh with its points, kinds in the opposite order.
std::string counts_text(const FileMesh& mesh);

/// Keys: "points" and plurals of kinds. Simplices of first order always have one, other kinds if
/// there are cells of them.
nlohmann::ordered_json counts_json(const FileMesh& mesh);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Internal to the writer of MSH: which entity each cell is written under.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// The entity of each cell, by kind.
struct MshEntities {
  std::array<std::vector<std::int32_t>, cell_kinds> of;
  /// How many cells' own entities gave way to regions.
  std::size_t lost = 0;
};

/// The cells' own entities; where there are none their regions; where no cell of the dimension has
/// either, 1. In versions 4 (40 and above) an entity belongs to one group: where that is not so the
/// regions of all cells of the dimension are its entities.
MshEntities msh_entities(const FileMesh& mesh, int version);

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// One order of the data columns of all kinds of cells, for formats that hold them together.
#pragma once

#include <vector>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// The first column of each name among the cells, so that those of every kind stand in the kind's
/// own order. Where kinds contradict each other, or no kind has both columns, the one that comes
/// first in the kinds' order is first. O(n log n) for n columns.
std::vector<const DataColumn*> ordered_cell_columns(const FileMesh& mesh);

}  // namespace sunder

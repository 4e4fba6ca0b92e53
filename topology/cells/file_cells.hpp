// SPDX-License-Identifier: MIT
// A file's mesh goes along with operations on the cells of its map.
#pragma once

#include <set>
#include <span>
#include <string>

#include "topology/cells/subdivide.hpp"
#include "topology/kernel/volume_map.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Counts of the changes to a file when cells were divided.
struct DividedFile {
  /// Cells of each dimension that became several.
  std::array<std::size_t, 4> divided = {0, 0, 0, 0};
  /// New points, or parts of cells, that were given numbers behind the highest of the file.
  std::size_t numbers_added = 0;
};

/// Divides the cells of `mesh` as operations on its map have divided them.
///
/// Points of edges are appended. Numbers between ends are interpolated, whole numbers are those of
/// the nearer end; the region of a point is that of its edge's ends where they have one, else 0.
/// Parts of a tetrahedron have its region, entity and data; data columns named in `shared` are
/// divided by volume. Triangles and edges with a divided edge between their points are divided as
/// the faces and edges of tetrahedra are; their parts have their region, entity and data. The first
/// part keeps its parent's row and number. Tetrahedra stand as the map has them: inverted ones are
/// turned.
///
/// Needs: `map` built of `mesh`, and all operations on it since, in their order; in each of them
/// edges of the same two points divided alike.
DividedFile divide_file(FileMesh& mesh, const VolumeMap& map, std::span<const CellEdit> edits,
                        const std::set<std::string>& shared = {});

}  // namespace sunder

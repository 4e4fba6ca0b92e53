// SPDX-License-Identifier: MIT
// The cells that findings name, as a mesh to look at.
#pragma once

#include "topology/mesh/check.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Every place of `check.places` as a cell: points as vertices, pairs as edges, faces and triangles
/// as triangles, tetrahedra. A cell has its finding's number as region, named by the finding's code
/// (1, 2, ... in the order of `check.findings`), and two columns of integers: `finding`, the same
/// number, and `row`, its row in `mesh` (-1 for edges and faces, which have none). A cell of
/// several findings is there several times. Points are those used, in the order of `mesh`; their
/// column `row` gives the rows there. Places with missing points are left out. Empty without
/// places. Needs: `check` is of `mesh`, with places kept. O(places).
FileMesh cells_of_findings(const FileMesh& mesh, const MeshCheck& check);

}  // namespace sunder

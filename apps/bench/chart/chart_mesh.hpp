// SPDX-License-Identifier: MIT
// Meshes of one body in several finenesses, for charts.
#pragma once

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Every tetrahedron into eight of an eighth of its volume: one at each corner, and the octahedron
/// between them cut along its shortest diagonal (of equals the first), so that shapes do not
/// degenerate when refined again (Bey 1995 names the diagonals; here they are measured).
/// Points keep their rows and new ones, the edges' middles, follow; children keep region and
/// orientation and take rows 8 t to 8 t + 7 of their parent t. The files' own numbers are dropped.
/// O(|T| log |T|). Needs: rows of points in range.
TetMesh refined(const TetMesh& mesh);

/// The point of the mesh that is farthest from its origin; the first of equals.
Point farthest_point(const TetMesh& mesh);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Meshes of the simple solids that a scene file may give in place of a mesh file.
#pragma once

#include <string>

#include "apps/scene/reading/body_source.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// The mesh of a solid. Its cells come near to `cell`, or its tetrahedra to their number, and every
/// length has one cell at least. `place`: the solid's in the scene, for findings. Errors:
/// no_wall (a tube whose radii are not in order), too_many_cells.
/// Needs: settings in their ranges.
Result<TetMesh> shape_mesh(const ShapeSettings& shape, const std::string& place);

}  // namespace sunder

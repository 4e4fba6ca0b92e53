// SPDX-License-Identifier: MIT
// The mesh files that a scene names: tetrahedra of bodies, surfaces of obstacles.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "mechanics/contact/shapes/solid_surface.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Reads a body's mesh and looks at it; what was found, also where there is a value. Errors: those of
/// `read_mesh` and `check_mesh`.
std::vector<Finding> read_body_mesh(TetMesh& mesh, const std::filesystem::path& path);

/// Reads an obstacle's surface: the triangles of the file, or, where it has tetrahedra, their
/// boundary. Points at the same place are one. Errors: those of `read_file_mesh` and
/// `make_solid_surface`.
std::vector<Finding> read_solid(std::shared_ptr<const SolidSurface>& surface,
                                const std::filesystem::path& path);

}  // namespace sunder

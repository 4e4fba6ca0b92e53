// SPDX-License-Identifier: MIT
// The mesh files that a scene names: tetrahedra of bodies, surfaces of obstacles.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Reads a body's mesh and checks it. Gives all findings, also where there is a mesh. Errors: those
/// of `read_mesh` and `check_mesh`.
std::vector<Finding> read_body_mesh(TetMesh& mesh, const SceneFiles& files,
                                    const std::string& name);

/// Reads an obstacle's surface: the triangles of the file, or, where it has tetrahedra, their
/// boundary. Points at the same place are one. Errors: those of `read_file_mesh` and
/// `make_solid_surface`.
std::vector<Finding> read_solid(std::shared_ptr<const SolidSurface>& surface,
                                const SceneFiles& files, const std::string& name);

}  // namespace sunder

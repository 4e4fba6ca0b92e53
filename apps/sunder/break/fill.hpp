// SPDX-License-Identifier: MIT
// Closed surfaces filled with tetrahedra by a mesher that is installed, in a process of its own.
#pragma once

#include <string>
#include <vector>

#include "apps/sunder/break/thing.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/surface/surface_gap.hpp"

namespace sunder {

/// The meshers that can fill a surface, by the names of their programs: tetgen keeps the triangles
/// of the surface and divides them, gmsh and sunder-mesh make triangles of their own.
std::vector<std::string> known_meshers();

/// A filled surface, in the surface's unit. All tetrahedra are positive.
struct Filled {
  TetMesh mesh;
  std::string mesher;
  /// Volume of the mesh less that of the surface, as a share; 0 where that of the surface is not
  /// known.
  double volume_error = 0;
  /// How far the skin of the mesh and the surface lie apart, by samples.
  SurfaceGap gap;
};

/// Fills a surface with about `tetrahedra` of them. `mesher`: one of `known_meshers`, or empty for
/// those that are installed, until one comes near to the number; else the nearest. Where the
/// surface has so many triangles that these alone need more tetrahedra, those that make triangles
/// of their own come first. Cavities are left out. Errors: no_mesher with the packages to install,
/// not_filled with the reason of each, wrong_volume. Note: many_cells, where the surface needs more
/// tetrahedra than asked for.
Result<Filled> fill(const Thing& thing, double tetrahedra, const std::string& mesher);

}  // namespace sunder

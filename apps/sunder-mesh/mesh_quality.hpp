// SPDX-License-Identifier: GPL-3.0-or-later
// The quality of a tetrahedral mesh, and its rows put in order. No CGAL.
#pragma once

#include <cstddef>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// The figures that tell a good mesh from a bad one.
struct MeshQuality {
  /// Over all six dihedral angles of all tetrahedra, degrees.
  double least_dihedral_angle = 0;
  double largest_dihedral_angle = 0;
  /// Of one tetrahedron, m^3; negative when it is inverted.
  double least_volume = 0;
  double largest_volume = 0;
  /// Of all, m^3.
  double volume = 0;
  /// Sets of tetrahedra joined by faces.
  std::size_t components = 0;
};

/// The figures of `mesh`; all zero for one without tetrahedra. O(T log T).
MeshQuality quality_of(const TetMesh& mesh);

/// Points put in order of (z, y, x); each tetrahedron's lowest row first, its orientation kept;
/// tetrahedra in order of their rows. Unused points go. The mesh is then the same whatever order
/// a mesher made it in.
/// Needs: no two points at the same place; no regions and no source ids yet.
void sort_rows(TetMesh& mesh);

/// Keeps the component with the most tetrahedra (on a tie, the one with the lowest row) and the
/// points it uses. Gives the number of tetrahedra left out.
/// Needs: no regions and no source ids yet.
std::size_t keep_largest_component(TetMesh& mesh);

}  // namespace sunder

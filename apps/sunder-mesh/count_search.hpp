// SPDX-License-Identifier: GPL-3.0-or-later
// The size at which a mesher gives the wanted number of tetrahedra. No CGAL.
#pragma once

#include <cstddef>
#include <functional>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// The wanted number of tetrahedra, and the limit of the search.
struct CountGoal {
  std::size_t tetrahedra = 0;
  /// How many meshes may be made.
  int tries = 24;
};

/// One try of the search.
struct CountTry {
  /// 1 for the first.
  int number = 0;
  /// All sizes were multiplied by this.
  double scale = 1;
  /// Counts of the mesh; both 0 when none was made.
  std::size_t tetrahedra = 0;
  std::size_t vertices = 0;
};

/// The mesh, among those tried, with the count nearest to the goal (on a tie, the earlier one).
/// `mesh_at(scale)` makes the mesh with all sizes multiplied by `scale`; it is called with scales
/// that follow the cube root of the count's ratio until the goal is bracketed, and interpolate in
/// logarithms from then on. Counts jump with the size, so the goal is rarely met exactly.
/// `report` hears of every try. A try without a tetrahedron counts as too coarse.
/// Needs: goal.tetrahedra > 0, goal.tries > 0. Errors: those of the tries when none gave a mesh.
Result<TetMesh> mesh_with_count(const std::function<Result<TetMesh>(double scale)>& mesh_at,
                                const CountGoal& goal,
                                const std::function<void(const CountTry&)>& report);

}  // namespace sunder

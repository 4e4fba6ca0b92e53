// SPDX-License-Identifier: MIT
// Repairs of a mesh that a user asks for by name; each tells what it did.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// What is to be done, in this order.
struct Repairs {
  /// Points closer than this become one, m; 0: those that coincide.
  std::optional<double> merge_points;
  bool drop_duplicates = false;
  bool split_nonmanifold = false;
  bool largest_component = false;
  bool fix_orientation = false;
  bool drop_unused = false;
};

/// Points within `distance` (m) of one that is kept give way to it, in the order of rows; cells
/// that lose a corner so are dropped. Needs: distance >= 0. Cost: O(points), as long as few lie
/// within `distance` of each other.
Finding merge_points(FileMesh& mesh, double distance);

/// Of tetrahedra with the same four points the first stays. O(n log n).
Finding drop_duplicate_tetrahedra(FileMesh& mesh);

/// Vertices whose star falls apart get a copy of their point for each part but the first, with its
/// number, region and data; cells of lower dimension stay with the first.
/// Leaves the mesh as it is, with an error, where no map can be built (see build_map).
Finding split_nonmanifold(FileMesh& mesh);

/// Tetrahedra of the largest part that hangs together by faces stay (on a tie that with the lowest
/// row), and cells of lower dimension whose points all belong to it. O(tetrahedra).
Finding keep_largest_component(FileMesh& mesh);

/// Tetrahedra of negative volume have two points swapped.
Finding fix_orientation(FileMesh& mesh);

/// Points that no cell uses are dropped.
Finding drop_unused_points(FileMesh& mesh);

/// That volume cells are there which are no tetrahedra of first order, and that `who` needs those.
std::optional<Finding> needs_tetrahedra(const FileMesh& mesh, std::string_view who);

/// The repairs asked for, one finding each: notes with the count of what was changed, 0 too. Where
/// one needs tetrahedra and there are other volume cells that is an error, and nothing is changed.
std::vector<Finding> repair(FileMesh& mesh, const Repairs& repairs);

}  // namespace sunder

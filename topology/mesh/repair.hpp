// SPDX-License-Identifier: MIT
// Repairs of a mesh that a user requests by name; each gives a finding about its changes.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// The repairs to be done, in this order.
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

/// Vertices with a star of several parts get a copy of their point for each part but the first,
/// with its number, region and data; cells of lower dimension stay with the first.
/// Leaves the mesh as it is, with an error, where no map can be built (see build_map).
Finding split_nonmanifold(FileMesh& mesh);

/// Keeps the tetrahedra of the largest part connected by faces (on a tie that with the lowest row),
/// and cells of lower dimension with all points in it. O(tetrahedra).
Finding keep_largest_component(FileMesh& mesh);

/// Tetrahedra of negative volume have two points swapped.
Finding fix_orientation(FileMesh& mesh);

/// Points that no cell uses are dropped.
Finding drop_unused_points(FileMesh& mesh);

/// An error if there are volume cells other than tetrahedra of first order, which `who` needs.
std::optional<Finding> needs_tetrahedra(const FileMesh& mesh, std::string_view who);

/// The requested repairs, one finding each: notes with the count of changes, 0 too. If one needs
/// tetrahedra and there are other volume cells, that is an error and nothing is changed.
std::vector<Finding> repair(FileMesh& mesh, const Repairs& repairs);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// A tetrahedral mesh as files hold it, in plain data. No adjacency here.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sunder {

/// A point in space, m.
using Point = std::array<double, 3>;

/// Points and tetrahedra, with the regions and numbers that a file gives them.
struct TetMesh {
  /// Coordinates, m.
  std::vector<Point> points;
  /// Four rows of `points` each. Positive orientation: det(p1-p0, p2-p0, p3-p0) > 0.
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  /// Region (material, physical group) of each tetrahedron; empty when the file has none.
  std::vector<std::int32_t> region;
  /// Names of regions, if the file has any.
  std::map<std::int32_t, std::string> region_name;
  /// The file's own number of each point; empty if it equals the row, or the row + 1 by convention.
  std::vector<std::int64_t> source_point_id;
  /// The file's own number of each tetrahedron; empty under the same condition.
  std::vector<std::int64_t> source_tetrahedron_id;
};

}  // namespace sunder

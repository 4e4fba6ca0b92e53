// SPDX-License-Identifier: MIT
// A tetrahedral mesh as files hold it: the plain data everyone exchanges. No adjacency here.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sunder {

/// A point in space, m.
using Point = std::array<double, 3>;

/// Points and tetrahedra, with what a file said about them.
struct TetMesh {
  /// Coordinates, m.
  std::vector<Point> points;
  /// Four rows of `points` each. Positive orientation: det(p1-p0, p2-p0, p3-p0) > 0.
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  /// Region (material, physical group) of each tetrahedron; empty when the file has none.
  std::vector<std::int32_t> region;
  /// Names of regions, where the file gives any.
  std::map<std::int32_t, std::string> region_name;
  /// The file's own number of each point; empty when it is the row (or the row + 1 by convention).
  std::vector<std::int64_t> source_point_id;
  /// The file's own number of each tetrahedron; empty likewise.
  std::vector<std::int64_t> source_tetrahedron_id;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Points inside and outside of a closed surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/box_tree.hpp"

namespace sunder {

/// A closed surface of triangles that answers whether it encloses a point: a ray from there meets
/// it an odd number of times. Cavities are outside, whichever way their triangles run.
class Enclosure {
 public:
  /// Needs: finite points. O(n log n).
  Enclosure(std::vector<Point> points, std::vector<std::array<std::uint32_t, 3>> triangles);

  /// Points that lie on the surface to rounding get either answer. About log n.
  bool holds(const Point& p) const;

 private:
  std::vector<Point> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace sunder

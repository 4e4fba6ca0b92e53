// SPDX-License-Identifier: MIT
// Edges of a surface of triangles with the triangles on them.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace sunder {

/// Rows of the points at the corners of a triangle.
using Triangle = std::array<std::uint32_t, 3>;

/// A side of a face, its lower end first.
struct FaceSide {
  std::array<std::uint32_t, 2> ends;
  std::uint32_t face;  ///< its row
  /// Whether the face runs from the lower end to the higher.
  bool is_forward;
  friend auto operator<=>(const FaceSide&, const FaceSide&) = default;
};

/// All sides in the order of their ends and triangles, so that those of an edge stand together.
/// Sides of no length are left out. O(n log n).
std::vector<FaceSide> sides_of(const std::vector<Triangle>& triangles);

/// Calls `work(span of FaceSide)` for each edge, in the order of the sides.
template <class Work>
void for_each_edge(std::span<const FaceSide> sides, Work work) {
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    for (end = i; end < sides.size() && sides[end].ends == sides[i].ends;) ++end;
    work(sides.subspan(i, end - i));
  }
}

/// How the edges of a surface hang together.
struct EdgeCounts {
  std::size_t open = 0;   ///< of one triangle
  std::size_t thick = 0;  ///< of three or more
};
EdgeCounts count_edges(const std::vector<Triangle>& triangles);

/// The sides of edges with one triangle.
std::vector<FaceSide> open_sides(const std::vector<Triangle>& triangles);

}  // namespace sunder

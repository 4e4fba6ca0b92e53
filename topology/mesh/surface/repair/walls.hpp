// SPDX-License-Identifier: MIT
// Triangles of a surface on the same three points.
#pragma once

#include <cstddef>
#include <vector>

#include "topology/mesh/surface/edges.hpp"

namespace sunder {

struct Walls {
  std::size_t doubled = 0;  ///< triangles that repeated another one
  std::size_t inner = 0;    ///< triangles of walls between two parts of a body
};

/// Of triangles on the same points one stays, where its edges need it: an edge with one other
/// triangle does, an edge with two others is whole without it. O(n log n).
Walls drop_walls(std::vector<Triangle>& triangles);

}  // namespace sunder

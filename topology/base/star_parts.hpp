// SPDX-License-Identifier: MIT
// The parts of a vertex's star when some of its faces are cut.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "topology/base/union_find.hpp"

namespace sunder {

/// The parts of a star: for each of its tetrahedra the place, in `star`, of the first of its part.
/// Two tetrahedra belong together when a chain of faces joins them within the star. `star`: rows of
/// tetrahedra, ascending. `across(t, p)`: the tetrahedron on the other side of face p (opposite to
/// corner p) of t, nothing where the face is cut or on the boundary. O(n log n).
template <class Star, class Across>
std::vector<std::uint32_t> star_parts(const Star& star, Across across) {
  UnionFind parts(star.size());
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    for (int p = 0; p < 4; ++p) {
      const auto other = across(star[i], p);
      // Each face once; the one opposite to the vertex leads out of the star.
      if (!other || *other < star[i]) continue;
      const auto at = std::ranges::lower_bound(star, *other);
      if (at == star.end() || *at != *other) continue;
      parts.join(i, static_cast<std::uint32_t>(at - star.begin()));
    }
  }
  return std::move(parts).roots();
}

}  // namespace sunder

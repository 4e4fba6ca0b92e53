// SPDX-License-Identifier: MIT
// Which boxes along the axes overlap: a uniform grid.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// A box along the axes, m.
struct Bounds {
  Vec3 low{0, 0, 0}, high{0, 0, 0};
  bool overlaps(const Bounds& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }
};

/// Two rows, the lower first.
using RowPair = std::pair<std::uint32_t, std::uint32_t>;

/// What `find_box_pairs` looks at.
struct BoxQuery {
  std::span<const Bounds> boxes;
  std::span<const std::uint32_t> body;  ///< of each box; boxes of one body never pair
  std::span<const char> moves;          ///< row = body: two that keep still never pair
};

/// Room that `find_box_pairs` reuses.
struct BoxScratch {
  std::vector<std::uint32_t> first, entries;
};

/// All pairs of boxes that overlap, sorted, each once. Boxes that are not finite pair with nothing.
/// O(boxes + pairs) while they are of similar size; one that covers more than 4 096 cells of the
/// grid is compared with all.
void find_box_pairs(std::vector<RowPair>& pairs, BoxScratch& scratch, const BoxQuery& query);

/// The same by comparing each with each: the slow twin for tests.
void find_box_pairs_brute_force(std::vector<RowPair>& pairs, const BoxQuery& query);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Which boxes along the axes overlap: a uniform grid of bodies.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "topology/base/union_find.hpp"

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

/// The input of `find_box_pairs`.
struct BoxQuery {
  std::span<const Bounds> boxes;
  std::span<const std::uint32_t> body;  ///< of each box; boxes of one body never pair
  std::span<const char> moves;          ///< row = body: two that keep still never pair
  std::span<const Vec3> ways = {};      ///< m, row = box: how far it moves; empty: not at all
  bool sorts = true;                    ///< false: the pairs may come in any order
};

/// Whether two boxes overlap at some time while the first moves by `way` (m) against the second.
bool meet(const Bounds& a, const Bounds& b, const Vec3& way);

/// Room that `find_box_pairs` reuses.
struct BoxScratch {
  std::vector<Bounds> covered;              ///< along their ways
  std::vector<Bounds> hull;                 ///< row = body
  std::vector<std::uint32_t> first_of, of;  ///< boxes by bodies
  std::vector<Bounds> group;                ///< hulls of some boxes in a row of `of`
  std::vector<RowPair> bodies;
  std::vector<std::uint32_t> near_a, near_b;
  std::vector<std::uint32_t> first, entries;  ///< of the grid
};

/// All pairs of boxes that meet on their ways, all at constant speeds over one time; sorted, each
/// once. Boxes that are not finite pair with nothing. Bodies are found by a grid: O(bodies + pairs)
/// while they are of similar size (one that covers more than 4 096 cells is compared with all); of
/// two that are near, the boxes near the other are swept.
void find_box_pairs(std::vector<RowPair>& pairs, BoxScratch& scratch, const BoxQuery& query);

/// Joins the bodies of which any boxes pair; `joined` has a row for each body. O(bodies + pairs of
/// near bodies), less than all pairs of their boxes.
void join_bodies(UnionFind& joined, BoxScratch& scratch, const BoxQuery& query);

/// The pairs by comparing each with each: the slow twin for tests.
void find_box_pairs_brute_force(std::vector<RowPair>& pairs, const BoxQuery& query);

}  // namespace sunder

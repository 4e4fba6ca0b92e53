// SPDX-License-Identifier: MIT
// Laws of counts and of face splits, in the suite's own words.
#include "topology/suite/random/random_run_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace sunder::suite {
namespace {

/// Changes of b0, b1, b2, b3.
using Change = std::array<int, 4>;

std::vector<Change> possible_changes(std::size_t vertices, std::size_t edges) {
  switch (4 * vertices + edges) {
    case 0:
      return {{0, 0, 1, 0}, {0, 0, 0, -1}};
    case 1:
      return {{0, 0, 0, 0}};
    case 2:
      return {{0, 0, -1, 0}, {0, 1, 0, 0}};
    case 3:
      return {{0, 2, 0, 0}, {0, 1, -1, 0}, {0, 0, -2, 0}};
    case 4 + 2:
      return {{0, 0, 0, 0}};
    case 4 + 3:
      return {{0, 0, -1, 0}, {0, 1, 0, 0}};
    case 8 + 3:
      return {{0, 0, 0, 0}};
    case 12 + 3:
      return {{1, 0, 0, 0}, {0, -1, 0, 0}};
    default:
      return {};
  }
}

}  // namespace

BettiNumbers betti_from_sheets(const CellCounts& counts, std::size_t closed) {
  const std::size_t b2 = counts.boundary_sheets + closed - counts.components;
  const auto chi = static_cast<std::size_t>(euler_characteristic(counts));
  // Unsigned arithmetic wraps: a negative number shows as a huge one, and is unequal all the same.
  return {counts.components, counts.components + b2 - closed - chi, b2, closed};
}

CellCounts counts_after(const CellCounts& before, const SplitAnswer& answer) {
  CellCounts after = before;
  if (!answer.did) return after;
  after.vertices += answer.vertices.size();
  after.edges += answer.edges.size();
  after.faces += 1;
  after.boundary_faces += 2;
  after.components += answer.separated ? 1 : 0;
  return after;
}

CellCounts counts_before(const CellCounts& after, const SplitAnswer& answer) {
  CellCounts before = after;
  before.vertices -= answer.vertices.size();
  before.edges -= answer.edges.size();
  before.faces -= 1;
  before.boundary_faces -= 2;
  before.components -= answer.separated ? 1 : 0;
  return before;
}

void judge_answer(Checks& checks, const SplitAnswer& answer) {
  if (!answer.did) return;
  const std::size_t v = answer.vertices.size(), e = answer.edges.size();
  const std::size_t least = least_split_edges(v);
  if (!same(checks, true, v <= 3 && e <= 3 && e >= least)) {
    differ(checks, fmt::format("law: edges apart with {} vertices", v),
           fmt::format("{} to 3", least), std::to_string(e));
  }
  if (!same(checks, true, !answer.separated || oracle_says_new(answer))) {
    differ(checks, "oracle at a separation", "yes", "no");
  }
}

void judge_change(Checks& checks, const BettiNumbers& before, const BettiNumbers& after,
                  const SplitAnswer& answer) {
  Change change;
  for (std::size_t d = 0; d < 4; ++d) change[d] = static_cast<int>(after[d] - before[d]);
  const std::size_t v = answer.vertices.size(), e = answer.edges.size();
  const std::vector<Change> possible = possible_changes(v, e);
  const bool found = std::find(possible.begin(), possible.end(), change) != possible.end();
  if (same(checks, true, found)) return;
  differ(checks, "law: change of b0, b1, b2, b3",
         fmt::format("one that {} vertices and {} edges apart can make", v, e),
         fmt::format("{} to {}", fmt::join(before, " "), fmt::join(after, " ")));
}

}  // namespace sunder::suite

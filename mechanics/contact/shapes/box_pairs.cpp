// SPDX-License-Identifier: MIT
// A hashed grid of bodies, and sweeps between two of them.
#include "mechanics/contact/shapes/box_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

using GridCell = std::array<std::int64_t, 3>;
constexpr std::int64_t most_cells = 4096;
constexpr std::uint32_t group_size = 32;

bool may_pair(const BoxQuery& query, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t p = query.body[a], q = query.body[b];
  if (p == q || (!query.moves[p] && !query.moves[q])) return false;
  if (query.ways.empty()) return query.boxes[a].overlaps(query.boxes[b]);
  return meet(query.boxes[a], query.boxes[b], query.ways[a] - query.ways[b]);
}

/// All that a box covers on its way.
Bounds swept(const BoxQuery& query, std::uint32_t k) {
  Bounds box = query.boxes[k];
  if (query.ways.empty()) return box;
  const Vec3& way = query.ways[k];
  box.low += way.cwiseMin(0);
  box.high += way.cwiseMax(0);
  return box;
}

/// Far cells are one: sums of their numbers stay whole numbers.
std::int64_t cell_index(double coordinate) {
  constexpr double farthest = 1e18;
  return whole_number<std::int64_t>(std::clamp(std::floor(coordinate), -farthest, farthest));
}

/// Of the grid in units of its cells.
struct BoxGrid {
  Vec3 origin = Vec3::Zero();
  double over_cell = 1;
  std::size_t mask = 0;

  GridCell cell_of(const Vec3& p) const {
    const Vec3 q = (p - origin) * over_cell;
    return {cell_index(q[0]), cell_index(q[1]), cell_index(q[2])};
  }
  std::size_t bucket_of(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const auto bits = [](std::int64_t i) { return static_cast<std::uint64_t>(i); };
    return static_cast<std::size_t>(bits(x) * 73856093 ^ bits(y) * 19349663 ^ bits(z) * 83492791) &
           mask;
  }
};

bool is_finite(const Bounds& b) { return b.low.allFinite() && b.high.allFinite(); }

struct CellRange {
  GridCell low, high;
  std::int64_t count() const {
    std::int64_t n = 1;
    for (std::size_t i = 0; i < 3; ++i) n *= high[i] - low[i] + 1;
    return n;
  }
};

CellRange range_of(const BoxGrid& grid, const Bounds& b) {
  return {grid.cell_of(b.low), grid.cell_of(b.high)};
}

template <class Visit>
void for_cells(const CellRange& r, const Visit& visit) {
  for (std::int64_t x = r.low[0]; x <= r.high[0]; ++x) {
    for (std::int64_t y = r.low[1]; y <= r.high[1]; ++y) {
      for (std::int64_t z = r.low[2]; z <= r.high[2]; ++z) visit(x, y, z);
    }
  }
}

/// The bucket of the lowest cell that both boxes cover: the one in which they pair.
std::size_t first_common_bucket(const BoxGrid& grid, const Bounds& a, const Bounds& b) {
  const GridCell cell = grid.cell_of(a.low.cwiseMax(b.low));
  return grid.bucket_of(cell[0], cell[1], cell[2]);
}

/// Whether a box spans so much that cells do not help. Asked in reals: counts could overflow.
bool is_large(const BoxGrid& grid, const Bounds& b) {
  const Vec3 cells = (b.high - b.low) * grid.over_cell + Vec3::Ones();
  return cells.prod() > static_cast<double>(most_cells);
}

BoxGrid grid_of(std::span<const Bounds> boxes) {
  BoxGrid grid;
  // The middle of the sizes: a few large boxes must not widen the cells.
  std::vector<double> sizes;
  for (const Bounds& b : boxes) {
    if (is_finite(b)) sizes.push_back((b.high - b.low).maxCoeff());
  }
  if (sizes.empty()) return grid;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  if (*middle > 0) grid.over_cell = 1 / *middle;
  std::size_t buckets = 64;
  while (buckets < 4 * boxes.size()) buckets *= 2;
  grid.mask = buckets - 1;
  return grid;
}

/// All pairs of boxes that overlap, each once; none of boxes that are not finite.
void find_overlaps(std::vector<RowPair>& pairs, BoxScratch& scratch,
                   std::span<const Bounds> boxes) {
  pairs.clear();
  const BoxGrid grid = grid_of(boxes);
  std::vector<std::uint32_t> large, small;
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    if (!is_finite(boxes[k])) continue;
    (is_large(grid, boxes[k]) ? large : small).push_back(k);
  }
  for (std::size_t i = 0; i < large.size(); ++i) {
    const auto add = [&](std::uint32_t k) {
      if (boxes[large[i]].overlaps(boxes[k])) pairs.push_back(std::minmax(large[i], k));
    };
    for (const std::uint32_t k : small) add(k);
    for (std::size_t j = 0; j < i; ++j) add(large[j]);
  }
  scratch.first.assign(grid.mask + 2, 0);
  for (const std::uint32_t k : small) {
    for_cells(range_of(grid, boxes[k]),
              [&](auto x, auto y, auto z) { ++scratch.first[grid.bucket_of(x, y, z) + 1]; });
  }
  for (std::size_t b = 0; b <= grid.mask; ++b) scratch.first[b + 1] += scratch.first[b];
  scratch.entries.resize(scratch.first.back());
  std::vector<std::uint32_t> next(scratch.first.begin(), scratch.first.end() - 1);
  for (const std::uint32_t k : small) {
    for_cells(range_of(grid, boxes[k]), [&](auto x, auto y, auto z) {
      scratch.entries[next[grid.bucket_of(x, y, z)]++] = k;
    });
  }
  for (std::size_t b = 0; b <= grid.mask; ++b) {
    const std::uint32_t begin = scratch.first[b], end = scratch.first[b + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t p = scratch.entries[i];
      for (std::uint32_t j = begin; j < i; ++j) {
        const std::uint32_t q = scratch.entries[j];
        if (!boxes[p].overlaps(boxes[q])) continue;
        if (first_common_bucket(grid, boxes[p], boxes[q]) == b) pairs.push_back(std::minmax(p, q));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  // A box may have cells of one bucket more than once.
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Bodies as the hulls of their boxes, and which boxes each has.
void gather_bodies(BoxScratch& scratch, const BoxQuery& query) {
  const std::size_t bodies = query.moves.size();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  scratch.hull.assign(bodies, {Vec3::Constant(infinite), Vec3::Constant(-infinite)});
  scratch.first_of.assign(bodies + 1, 0);
  for (std::size_t k = 0; k < query.boxes.size(); ++k) {
    const Bounds& box = scratch.covered[k];
    if (!is_finite(box)) continue;
    Bounds& hull = scratch.hull[query.body[k]];
    hull.low = hull.low.cwiseMin(box.low);
    hull.high = hull.high.cwiseMax(box.high);
    ++scratch.first_of[query.body[k] + 1];
  }
  for (std::size_t b = 0; b < bodies; ++b) scratch.first_of[b + 1] += scratch.first_of[b];
  scratch.of.resize(scratch.first_of.back());
  std::vector<std::uint32_t> next(scratch.first_of.begin(), scratch.first_of.end() - 1);
  for (std::uint32_t k = 0; k < query.boxes.size(); ++k) {
    if (is_finite(scratch.covered[k])) scratch.of[next[query.body[k]]++] = k;
  }
  scratch.group.assign(scratch.of.size() / group_size + 1,
                       {Vec3::Constant(infinite), Vec3::Constant(-infinite)});
  for (std::size_t i = 0; i < scratch.of.size(); ++i) {
    Bounds& group = scratch.group[i / group_size];
    const Bounds& box = scratch.covered[scratch.of[i]];
    group.low = group.low.cwiseMin(box.low);
    group.high = group.high.cwiseMax(box.high);
  }
}

/// The boxes of one body that overlap another's hull, by where they begin along an axis.
void gather_near(std::vector<std::uint32_t>& near, const BoxScratch& scratch, std::uint32_t body,
                 const Bounds& hull, int axis) {
  near.clear();
  const std::uint32_t end = scratch.first_of[body + 1];
  for (std::uint32_t i = scratch.first_of[body]; i < end;) {
    const std::uint32_t next = std::min(end, (i / group_size + 1) * group_size);
    if (!scratch.group[i / group_size].overlaps(hull)) i = next;
    for (; i < next; ++i) {
      if (scratch.covered[scratch.of[i]].overlaps(hull)) near.push_back(scratch.of[i]);
    }
  }
  std::sort(near.begin(), near.end(), [&](std::uint32_t p, std::uint32_t q) {
    return scratch.covered[p].low[axis] < scratch.covered[q].low[axis];
  });
}

/// Calls `add` for the pairs of boxes of two bodies until it gives false: a sweep along the longest
/// side of their common box.
template <class Add>
void pair_bodies(BoxScratch& scratch, const BoxQuery& query, const RowPair& bodies,
                 const Add& add) {
  const Bounds &a = scratch.hull[bodies.first], &b = scratch.hull[bodies.second];
  int axis = 0;
  (a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low)).maxCoeff(&axis);
  std::vector<std::uint32_t>&p = scratch.near_a, &q = scratch.near_b;
  gather_near(p, scratch, bodies.first, b, axis);
  gather_near(q, scratch, bodies.second, a, axis);
  const std::vector<Bounds>& covered = scratch.covered;
  const auto sweep = [&](std::uint32_t one, const std::vector<std::uint32_t>& others,
                         std::size_t from) {
    for (; from < others.size() && covered[others[from]].low[axis] <= covered[one].high[axis];
         ++from) {
      const std::uint32_t other = others[from];
      if (covered[one].overlaps(covered[other]) && may_pair(query, one, other) &&
          !add(one, other)) {
        return false;
      }
    }
    return true;
  };
  std::size_t i = 0, j = 0;
  for (bool goes_on = true; goes_on && i < p.size() && j < q.size();) {
    const bool first = covered[p[i]].low[axis] <= covered[q[j]].low[axis];
    goes_on = first ? sweep(p[i], q, j) : sweep(q[j], p, i);
    ++(first ? i : j);
  }
}

/// Pairs of bodies whose boxes may meet, into `scratch.bodies`.
void find_near_bodies(BoxScratch& scratch, const BoxQuery& query) {
  scratch.covered.resize(query.boxes.size());
  for (std::uint32_t k = 0; k < query.boxes.size(); ++k) scratch.covered[k] = swept(query, k);
  gather_bodies(scratch, query);
  find_overlaps(scratch.bodies, scratch, scratch.hull);
  std::erase_if(scratch.bodies, [&](const RowPair& both) {
    return !query.moves[both.first] && !query.moves[both.second];
  });
}

}  // namespace

bool meet(const Bounds& a, const Bounds& b, const Vec3& way) {
  double from = 0, to = 1;  // shares of the way on which they overlap along all axes
  for (int i = 0; i < 3; ++i) {
    const double behind = b.low[i] - a.high[i], ahead = b.high[i] - a.low[i];
    if (way[i] == 0) {
      if (behind > 0 || ahead < 0) return false;
      continue;
    }
    const double over = 1 / way[i];
    from = std::max(from, std::min(over * behind, over * ahead));
    to = std::min(to, std::max(over * behind, over * ahead));
  }
  return from <= to;
}

void find_box_pairs(std::vector<RowPair>& pairs, BoxScratch& scratch, const BoxQuery& query) {
  pairs.clear();
  find_near_bodies(scratch, query);
  for (const RowPair& both : scratch.bodies) {
    pair_bodies(scratch, query, both, [&](std::uint32_t a, std::uint32_t b) {
      pairs.push_back(std::minmax(a, b));
      return true;
    });
  }
  if (query.sorts) std::sort(pairs.begin(), pairs.end());
}

void join_bodies(UnionFind& joined, BoxScratch& scratch, const BoxQuery& query) {
  find_near_bodies(scratch, query);
  for (const RowPair& both : scratch.bodies) {
    if (joined.root(both.first) == joined.root(both.second)) continue;
    pair_bodies(scratch, query, both, [&](std::uint32_t, std::uint32_t) {
      joined.join(both.first, both.second);
      return false;
    });
  }
}

void find_box_pairs_brute_force(std::vector<RowPair>& pairs, const BoxQuery& query) {
  pairs.clear();
  for (std::uint32_t a = 0; a < query.boxes.size(); ++a) {
    if (!is_finite(query.boxes[a])) continue;
    for (std::uint32_t b = a + 1; b < query.boxes.size(); ++b) {
      if (is_finite(query.boxes[b]) && may_pair(query, a, b)) pairs.emplace_back(a, b);
    }
  }
}

}  // namespace sunder

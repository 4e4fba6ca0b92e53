// SPDX-License-Identifier: MIT
// A hashed grid of boxes.
#include "mechanics/rubble/box_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sunder {
namespace {

using Cell = std::array<std::int64_t, 3>;
constexpr std::int64_t most_cells = 4096;

bool may_pair(const BoxQuery& query, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t p = query.body[a], q = query.body[b];
  return p != q && (query.moves[p] || query.moves[q]) && query.boxes[a].overlaps(query.boxes[b]);
}

/// Of the grid in units of its cells.
struct Grid {
  Vec3 origin = Vec3::Zero();
  double over_cell = 1;
  std::size_t mask = 0;

  Cell cell_of(const Vec3& p) const {
    const Vec3 q = (p - origin) * over_cell;
    return {static_cast<std::int64_t>(std::floor(q[0])), static_cast<std::int64_t>(std::floor(q[1])),
            static_cast<std::int64_t>(std::floor(q[2]))};
  }
  std::size_t bucket_of(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791) & mask;
  }
};

bool is_finite(const Bounds& b) { return b.low.allFinite() && b.high.allFinite(); }

struct Range {
  Cell low, high;
  std::int64_t count() const {
    std::int64_t n = 1;
    for (std::size_t i = 0; i < 3; ++i) n *= high[i] - low[i] + 1;
    return n;
  }
};

Range range_of(const Grid& grid, const Bounds& b) { return {grid.cell_of(b.low), grid.cell_of(b.high)}; }

template <class Visit>
void for_cells(const Range& r, const Visit& visit) {
  for (std::int64_t x = r.low[0]; x <= r.high[0]; ++x) {
    for (std::int64_t y = r.low[1]; y <= r.high[1]; ++y) {
      for (std::int64_t z = r.low[2]; z <= r.high[2]; ++z) visit(x, y, z);
    }
  }
}

/// The bucket of the lowest cell that both boxes cover: the one in which they pair.
std::size_t first_common_bucket(const Grid& grid, const Bounds& a, const Bounds& b) {
  const Cell cell = grid.cell_of(a.low.cwiseMax(b.low));
  return grid.bucket_of(cell[0], cell[1], cell[2]);
}

/// Whether a box spans so much that cells do not help. Asked in reals: counts could overflow.
bool is_large(const Grid& grid, const Bounds& b) {
  const Vec3 cells = (b.high - b.low) * grid.over_cell + Vec3::Ones();
  return cells.prod() > static_cast<double>(most_cells);
}

Grid grid_of(std::span<const Bounds> boxes) {
  Grid grid;
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

}  // namespace

void find_box_pairs(std::vector<RowPair>& pairs, BoxScratch& scratch, const BoxQuery& query) {
  pairs.clear();
  const Grid grid = grid_of(query.boxes);
  const auto boxes = static_cast<std::uint32_t>(query.boxes.size());
  std::vector<std::uint32_t> large, small;
  for (std::uint32_t k = 0; k < boxes; ++k) {
    if (!is_finite(query.boxes[k])) continue;
    (is_large(grid, query.boxes[k]) ? large : small).push_back(k);
  }
  for (std::size_t i = 0; i < large.size(); ++i) {
    for (const std::uint32_t k : small) {
      if (may_pair(query, large[i], k)) pairs.push_back(std::minmax(large[i], k));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (may_pair(query, large[i], large[j])) pairs.push_back(std::minmax(large[i], large[j]));
    }
  }
  scratch.first.assign(grid.mask + 2, 0);
  for (const std::uint32_t k : small) {
    for_cells(range_of(grid, query.boxes[k]), [&](auto x, auto y, auto z) {
      ++scratch.first[grid.bucket_of(x, y, z) + 1];
    });
  }
  for (std::size_t b = 0; b <= grid.mask; ++b) scratch.first[b + 1] += scratch.first[b];
  scratch.entries.resize(scratch.first.back());
  std::vector<std::uint32_t> next(scratch.first.begin(), scratch.first.end() - 1);
  for (const std::uint32_t k : small) {
    for_cells(range_of(grid, query.boxes[k]), [&](auto x, auto y, auto z) {
      scratch.entries[next[grid.bucket_of(x, y, z)]++] = k;
    });
  }
  for (std::size_t b = 0; b <= grid.mask; ++b) {
    const std::uint32_t begin = scratch.first[b], end = scratch.first[b + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t p = scratch.entries[i], body = query.body[p];
      const bool moves = query.moves[body] != 0;
      const Bounds& box = query.boxes[p];
      for (std::uint32_t j = begin; j < i; ++j) {
        const std::uint32_t q = scratch.entries[j], other = query.body[q];
        if (body == other || (!moves && !query.moves[other])) continue;
        if (!box.overlaps(query.boxes[q])) continue;
        if (first_common_bucket(grid, box, query.boxes[q]) != b) continue;
        pairs.push_back(std::minmax(p, q));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
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

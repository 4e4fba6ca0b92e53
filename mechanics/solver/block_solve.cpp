// SPDX-License-Identifier: MIT
// Triangular solves with panels, for one right-hand side and for twelve.
#include <algorithm>

#include "mechanics/solver/block_factor.hpp"
#include "mechanics/solver/block_lanes.hpp"
#include "mechanics/solver/block_panel.hpp"

namespace sunder {
namespace {

/// Twelve numbers that four vertices have in a tile.
struct alignas(32) TileNumbers {
  double value[12] = {};
};

/// Columns with sums that are kept at a time on the way back: their lanes stay in the first cache.
constexpr std::size_t backward_chunk = 48;

/// sum += tile's columns `begin` to `end` times x, in two interleaved sums of fixed order.
SUNDER_INLINE void multiply_tile(TileNumbers& sum, const double* tile, const double* x,
                                 std::size_t count) {
  Lanes even[3], odd[3];
  for (int v = 0; v < 3; ++v) {
    even[v] = load(sum.value + 4 * v);
    odd[v] = spread(0);
  }
  std::size_t k = 0;
  for (; k + 2 <= count; k += 2, tile += 24) {
    const Lanes a = spread(x[k]), b = spread(x[k + 1]);
    for (int v = 0; v < 3; ++v) {
      even[v] += load(tile + 4 * v) * a;
      odd[v] += load(tile + 12 + 4 * v) * b;
    }
  }
  if (k < count) {
    for (int v = 0; v < 3; ++v) even[v] += load(tile + 4 * v) * spread(x[k]);
  }
  for (int v = 0; v < 3; ++v) store(sum.value + 4 * v, even[v] + odd[v]);
}

/// sum of column k, four lanes each, += tile's column k . z.
SUNDER_INLINE void multiply_transposed(Lanes* sum, const double* tile, const TileNumbers& z,
                                       std::size_t count) {
  const Lanes z0 = load(z.value), z1 = load(z.value + 4), z2 = load(z.value + 8);
  for (std::size_t k = 0; k < count; ++k, tile += 12) {
    sum[k] += load(tile) * z0 + load(tile + 4) * z1 + load(tile + 8) * z2;
  }
}

SUNDER_INLINE double sum_of(const Lanes& v) { return (v[0] + v[1]) + (v[2] + v[3]); }

/// Columns of the supernode in tile `tile` of its own.
SUNDER_INLINE std::size_t own_columns(const Panel& panel, std::size_t tile) {
  return std::min<std::size_t>(12, panel.columns() - 12 * tile);
}

/// x <- L^-1 x in the corner of one tile.
SUNDER_INLINE void solve_corner(double* x, const double* L, std::size_t n) {
  TileNumbers y;
  std::copy(x, x + n, y.value);
  for (std::size_t j = 0; j < n; ++j, L += 12) {
    const double value = y.value[j] * L[j];
    // Whole columns: entries above the diagonal only spoil finished values.
    for (std::size_t i = 0; i < 12; ++i) y.value[i] -= L[i] * value;
    x[j] = value;
  }
}

/// x <- L^-T (x - sums) in the corner of one tile.
SUNDER_INLINE void solve_corner_back(double* x, const Lanes* sums, const double* L, std::size_t n) {
  for (std::size_t j = n; j-- > 0;) {
    double value = x[j] - sum_of(sums[j]);
    for (std::size_t i = j + 1; i < n; ++i) value -= L[12 * j + i] * x[i];
    x[j] = value * L[12 * j + j];
  }
}

/// The numbers of up to four vertices in a tile of the rows below.
struct TileRows {
  const std::uint32_t* row;
  std::size_t count;
};

SUNDER_INLINE TileRows rows_of(const Panel& panel, const PanelRows& rows, std::size_t tile) {
  return {rows.below + 4 * tile, std::min<std::size_t>(4, panel.height - 4 * tile)};
}

}  // namespace

SUNDER_LANES void solve_forward(double* x, const Panel& panel, const PanelRows& rows) {
  double* own = x + 3 * rows.first;
  for (std::size_t tile = 0; tile < tiles_of(panel.width); ++tile) {
    const double* L = panel.values + tile * panel.tile_doubles();
    const std::size_t n = own_columns(panel, tile);
    TileNumbers sum;
    multiply_tile(sum, L, own, 12 * tile);
    for (std::size_t i = 0; i < n; ++i) own[12 * tile + i] -= sum.value[i];
    solve_corner(own + 12 * tile, L + 144 * tile, n);
  }
  for (std::size_t tile = 0; tile < tiles_of(panel.height); ++tile) {
    TileNumbers sum;
    multiply_tile(sum, panel.below() + tile * panel.tile_doubles(), own, panel.columns());
    const TileRows to = rows_of(panel, rows, tile);
    for (std::size_t i = 0; i < to.count; ++i) {
      double* at = x + 3 * std::size_t{to.row[i]};
      for (std::size_t c = 0; c < 3; ++c) at[c] -= sum.value[3 * i + c];
    }
  }
}

SUNDER_LANES void solve_backward(double* x, const Panel& panel, const PanelRows& rows) {
  double* own = x + 3 * rows.first;
  // From the last columns to the first; a chunk is whole tiles.
  for (std::size_t end = panel.columns(); end > 0;) {
    const std::size_t begin = (end - 1) / backward_chunk * backward_chunk;
    Lanes sums[backward_chunk];
    for (std::size_t k = 0; k < end - begin; ++k) sums[k] = spread(0);
    for (std::size_t tile = 0; tile < tiles_of(panel.height); ++tile) {
      TileNumbers z;
      const TileRows from = rows_of(panel, rows, tile);
      for (std::size_t i = 0; i < from.count; ++i) {
        std::copy_n(x + 3 * std::size_t{from.row[i]}, 3, z.value + 3 * i);
      }
      multiply_transposed(sums, panel.below() + tile * panel.tile_doubles() + 12 * begin, z,
                          end - begin);
    }
    for (std::size_t tile = tiles_of(panel.width); 12 * tile > begin;) {
      --tile;
      const double* L = panel.values + tile * panel.tile_doubles();
      const std::size_t n = own_columns(panel, tile);
      if (12 * tile < end) {
        solve_corner_back(own + 12 * tile, sums + (12 * tile - begin), L + 144 * tile, n);
      }
      TileNumbers z;
      std::copy_n(own + 12 * tile, n, z.value);
      multiply_transposed(sums, L + 12 * begin, z, std::min(12 * tile, end) - begin);
    }
    end = begin;
  }
}

SUNDER_LANES void solve_forward_12(double* X, const Panel& panel, const PanelRows& rows,
                                   double* gathered) {
  double* own = X + 36 * rows.first;
  for (std::size_t tile = 0; tile < tiles_of(panel.width); ++tile) {
    const double* L = panel.values + tile * panel.tile_doubles();
    const std::size_t n = own_columns(panel, tile);
    double* to = own + 144 * tile;
    for (std::size_t i = 0; i < n; ++i) {
      subtract_product<3, 1, 1, 12>(to + 12 * i, 12, own, L + i, 12 * tile);
    }
    for (std::size_t i = 0; i < n; ++i) {
      subtract_product<3, 1, 1, 12>(to + 12 * i, 12, to, L + 144 * tile + i, i);
      for (std::size_t c = 0; c < 12; ++c) to[12 * i + c] *= L[12 * (12 * tile + i) + i];
    }
  }
  std::fill(gathered, gathered + 36 * panel.height, 0.0);
  for (std::size_t row = 0; row < panel.height; ++row) {
    const double* L = panel.vertex_row(panel.width + row);
    double* sum = gathered + 36 * row;
    subtract_product<3, 3, 1, 12>(sum, 12, own, L, panel.columns());
    double* to = X + 36 * std::size_t{rows.below[row]};
    for (std::size_t c = 0; c < 36; ++c) to[c] += sum[c];
  }
}

SUNDER_LANES void solve_backward_12(double* X, const Panel& panel, const PanelRows& rows,
                                    double* gathered) {
  double* own = X + 36 * rows.first;
  for (std::size_t row = 0; row < panel.height; ++row) {
    std::copy_n(X + 36 * std::size_t{rows.below[row]}, 36, gathered + 36 * row);
  }
  for (std::size_t tile = tiles_of(panel.width); tile-- > 0;) {
    const std::size_t n = own_columns(panel, tile);
    double* to = own + 144 * tile;
    for (std::size_t strip = 0; strip < n; strip += 3) {
      const std::size_t column = 12 * (12 * tile + strip);
      double* C = to + 12 * strip;
      for (std::size_t t = 0; t < tiles_of(panel.height); ++t) {
        subtract_product<3, 3, 12, 1>(C, 12, gathered + 144 * t,
                                      panel.below() + t * panel.tile_doubles() + column,
                                      std::min<std::size_t>(12, 3 * panel.height - 12 * t));
      }
      for (std::size_t t = tile + 1; t < tiles_of(panel.width); ++t) {
        subtract_product<3, 3, 12, 1>(C, 12, own + 144 * t,
                                      panel.values + t * panel.tile_doubles() + column,
                                      own_columns(panel, t));
      }
    }
    const double* L = panel.values + tile * panel.tile_doubles() + 144 * tile;
    for (std::size_t i = n; i-- > 0;) {
      subtract_product<3, 1, 12, 1>(to + 12 * i, 12, to + 12 * (i + 1), L + 12 * i + i + 1,
                                    n - i - 1);
      for (std::size_t c = 0; c < 12; ++c) to[12 * i + c] *= L[12 * i + i];
    }
  }
}

SUNDER_LANES void subtract_gram_12(double* C, const double* V, const double* W, std::size_t rows) {
  for (std::size_t strip = 0; strip < 12; strip += 4) {
    subtract_product<3, 4, 1, 12>(C + 12 * strip, 12, W, V + strip, rows);
  }
}

namespace {

Panel panel_of(const BlockFactor& factor, const Supernode& node) {
  // Solves only read.
  return {const_cast<double*>(factor.panels.data() + node.panel), node.width(), node.height()};
}

std::size_t highest(const BlockAnalysis& analysis) {
  std::size_t height = 0;
  for (const Supernode& node : analysis.supernodes) {
    height = std::max<std::size_t>(height, node.height());
  }
  return height;
}

}  // namespace

void solve_lower(double* x, const BlockFactor& factor, const BlockAnalysis& analysis) {
  for (const Supernode& node : analysis.supernodes) {
    solve_forward(x, panel_of(factor, node), {node.first, analysis.rows_below(node).data()});
  }
}

void solve_upper(double* x, const BlockFactor& factor, const BlockAnalysis& analysis) {
  for (std::size_t s = analysis.supernodes.size(); s-- > 0;) {
    const Supernode& node = analysis.supernodes[s];
    solve_backward(x, panel_of(factor, node), {node.first, analysis.rows_below(node).data()});
  }
}

void solve(double* x, const BlockFactor& factor, const BlockAnalysis& analysis) {
  solve_lower(x, factor, analysis);
  solve_upper(x, factor, analysis);
}

void solve_lower_12(double* X, const BlockFactor& factor, const BlockAnalysis& analysis,
                    std::span<const char> needed) {
  AlignedDoubles gathered(36 * highest(analysis));
  for (std::size_t s = 0; s < analysis.supernodes.size(); ++s) {
    if (!needed.empty() && !needed[s]) continue;
    const Supernode& node = analysis.supernodes[s];
    solve_forward_12(X, panel_of(factor, node), {node.first, analysis.rows_below(node).data()},
                     gathered.data());
  }
}

void solve_upper_12(double* X, const BlockFactor& factor, const BlockAnalysis& analysis,
                    std::span<const char> needed) {
  AlignedDoubles gathered(36 * highest(analysis));
  for (std::size_t s = analysis.supernodes.size(); s-- > 0;) {
    if (!needed.empty() && !needed[s]) continue;
    const Supernode& node = analysis.supernodes[s];
    solve_backward_12(X, panel_of(factor, node), {node.first, analysis.rows_below(node).data()},
                      gathered.data());
  }
}

void solve_12(double* X, const BlockFactor& factor, const BlockAnalysis& analysis,
              std::span<const char> needed) {
  solve_lower_12(X, factor, analysis, needed);
  solve_upper_12(X, factor, analysis, needed);
}

void mark_needed(std::vector<char>& needed, const BlockAnalysis& analysis, std::uint32_t row) {
  std::uint32_t s = analysis.supernode_of[row];
  for (; s != Supernode::none && !needed[s]; s = analysis.supernodes[s].parent) needed[s] = 1;
}

}  // namespace sunder

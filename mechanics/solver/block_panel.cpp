// SPDX-License-Identifier: MIT
// Factoring a panel, left-looking by tiles of twelve columns, and its outer product.
#include "mechanics/solver/block_panel.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/solver/block_lanes.hpp"

namespace sunder {
namespace {

/// Columns of one product at a time: two tiles of 96 columns are 18 KB of the first cache.
constexpr std::size_t column_chunk = 96;

/// A product that goes into one tile of rows: for `columns` (at most 12) columns of C, `leading`
/// apart, -= A B^T over `count` columns of two tiles.
struct TileProduct {
  double* C;
  std::ptrdiff_t leading;
  const double *A, *B;
  std::size_t columns;
};

template <int V>
SUNDER_INLINE void subtract_tile(const TileProduct& product, std::size_t count) {
  for (std::size_t k = 0; k < count; k += column_chunk) {
    const std::size_t now = std::min(column_chunk, count - k);
    for (std::size_t strip = 0; strip < product.columns; strip += 4) {
      double* C = product.C + static_cast<std::ptrdiff_t>(strip) * product.leading;
      const double* A = product.A + 12 * k;
      const double* B = product.B + 12 * k + strip;
      switch (product.columns - strip) {
        case 1:
          subtract_product<V, 1, 1, 12>(C, product.leading, A, B, now);
          break;
        case 2:
          subtract_product<V, 2, 1, 12>(C, product.leading, A, B, now);
          break;
        case 3:
          subtract_product<V, 3, 1, 12>(C, product.leading, A, B, now);
          break;
        default:
          subtract_product<V, 4, 1, 12>(C, product.leading, A, B, now);
      }
    }
  }
}

SUNDER_INLINE void subtract_groups(std::size_t groups, const TileProduct& product,
                                   std::size_t count) {
  switch (groups) {
    case 1:
      return subtract_tile<1>(product, count);
    case 2:
      return subtract_tile<2>(product, count);
    default:
      return subtract_tile<3>(product, count);
  }
}

/// Rows X of up to twelve columns <- X L^-T, L the factored tile of those columns.
template <int V>
SUNDER_INLINE void solve_tile(double* X, const double* L, std::size_t columns) {
  for (std::size_t j = 0; j < columns; ++j) {
    Lanes x[V];
    for (int v = 0; v < V; ++v) x[v] = load(X + 12 * j + 4 * v) * spread(L[12 * j + j]);
    for (int v = 0; v < V; ++v) store(X + 12 * j + 4 * v, x[v]);
    for (std::size_t i = j + 1; i < columns; ++i) {
      for (int v = 0; v < V; ++v) {
        double* to = X + 12 * i + 4 * v;
        store(to, load(to) - x[v] * spread(L[12 * j + i]));
      }
    }
  }
}

SUNDER_INLINE void solve_groups(std::size_t groups, double* X, const double* L,
                                std::size_t columns) {
  switch (groups) {
    case 1:
      return solve_tile<1>(X, L, columns);
    case 2:
      return solve_tile<2>(X, L, columns);
    default:
      return solve_tile<3>(X, L, columns);
  }
}

/// Cholesky of up to twelve columns at `L`; reciprocals on the diagonal.
SUNDER_INLINE bool factor_corner(double* L, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    const double pivot = L[12 * j + j];
    if (!(pivot > 0)) return false;
    const double inverse = 1 / std::sqrt(pivot);
    L[12 * j + j] = inverse;
    for (std::size_t i = j + 1; i < n; ++i) L[12 * j + i] *= inverse;
    for (std::size_t k = j + 1; k < n; ++k) {
      for (std::size_t i = k; i < n; ++i) L[12 * k + i] -= L[12 * j + i] * L[12 * j + k];
    }
  }
  return true;
}

}  // namespace

SUNDER_LANES bool factor_panel(const Panel& panel) {
  const std::size_t own = tiles_of(panel.width), all = own + tiles_of(panel.height);
  for (std::size_t tile = 0; tile < own; ++tile) {
    const std::size_t first = 12 * tile;
    const std::size_t columns = std::min<std::size_t>(12, panel.columns() - first);
    const double* diagonal = panel.values + tile * panel.tile_doubles();
    for (std::size_t row = tile; row < all; ++row) {
      double* A = panel.values + row * panel.tile_doubles();
      const std::size_t groups =
          row < own ? groups_in(row, panel.width) : groups_in(row - own, panel.height);
      subtract_groups(groups, {A + 12 * first, 12, A, diagonal, columns}, first);
      if (row > tile) {
        solve_groups(groups, A + 12 * first, diagonal + 12 * first, columns);
      } else if (!factor_corner(A + 12 * first, columns)) {
        return false;
      }
    }
  }
  return true;
}

SUNDER_LANES void subtract_outer(double* update, const Panel& panel) {
  const std::size_t tiles = tiles_of(panel.height), leading = update_leading(panel.height);
  for (std::size_t column = 0; column < tiles; ++column) {
    const std::size_t columns = std::min<std::size_t>(12, 3 * panel.height - 12 * column);
    const double* B = panel.below() + column * panel.tile_doubles();
    for (std::size_t row = column; row < tiles; ++row) {
      const double* A = panel.below() + row * panel.tile_doubles();
      subtract_groups(groups_in(row, panel.height),
                      {update + 12 * column * leading + 12 * row,
                       static_cast<std::ptrdiff_t>(leading), A, B, columns},
                      panel.columns());
    }
  }
}

}  // namespace sunder

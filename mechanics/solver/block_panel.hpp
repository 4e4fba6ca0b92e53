// SPDX-License-Identifier: MIT
// Dense work on one supernode: its panel of L in tiles of twelve rows, its update of later columns.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sunder {

/// Rows of a tile: four vertices, three AVX2 registers. A vertex never straddles two tiles.
inline constexpr std::size_t tile_rows = 12;

constexpr std::size_t tiles_of(std::size_t vertices) { return (vertices + 3) / 4; }

/// Doubles in the panel of a supernode of `width` columns and `height` rows below, of vertices:
/// tiles of its own rows, then tiles of the rows below. In a tile all 3 width columns follow each
/// other, twelve rows each; rows past the end are zero. The diagonal holds reciprocals, and the
/// part above it is left undefined.
constexpr std::size_t panel_doubles(std::size_t width, std::size_t height) {
  return (tiles_of(width) + tiles_of(height)) * tile_rows * 3 * width;
}

/// Leading dimension of an update matrix: column by column, lower triangle.
constexpr std::size_t update_leading(std::size_t height) { return 4 * ((3 * height + 3) / 4); }
constexpr std::size_t update_doubles(std::size_t height) {
  return update_leading(height) * 3 * height;
}

/// One supernode at work. Addresses are multiples of 32 bytes.
struct Panel {
  double* values;
  std::size_t width, height;  ///< of vertices

  std::size_t columns() const { return 3 * width; }
  std::size_t tile_doubles() const { return tile_rows * columns(); }
  /// First tile of the rows below.
  double* below() const { return values + tiles_of(width) * tile_doubles(); }
  /// The three rows of a vertex in scalar column 0; the next column is `tile_rows` further on.
  /// `row`: own rows first, then those below.
  double* vertex_row(std::size_t row) const {
    const std::size_t place = row < width ? row : row - width + 4 * tiles_of(width);
    return values + place / 4 * tile_doubles() + 3 * (place % 4);
  }
};

// All sums run over columns in one order on every processor: vector lanes are rows, or right-hand
// sides, and independent of each other.

/// Turns the assembled panel into its part of L; false where a pivot is not positive.
bool factor_panel(const Panel& panel);

/// U -= L21 L21^T, lower triangle; the part above it is left undefined.
void subtract_outer(double* update, const Panel& panel);

/// x of the supernode's columns <- L11^-1 x, and x of the rows below -= L21 x. `x`: all rows.
struct PanelRows {
  std::size_t first;           ///< first column of the supernode, of vertices
  const std::uint32_t* below;  ///< its rows below, of vertices
};
void solve_forward(double* x, const Panel& panel, const PanelRows& rows);
/// x of the supernode's columns <- L11^-T (x - L21^T x of the rows below).
void solve_backward(double* x, const Panel& panel, const PanelRows& rows);

/// The same for twelve right-hand sides at once, X row by row (12 numbers each, 32-byte aligned).
/// `gathered`: room for 36 height doubles.
void solve_forward_12(double* X, const Panel& panel, const PanelRows& rows, double* gathered);
void solve_backward_12(double* X, const Panel& panel, const PanelRows& rows, double* gathered);

/// C -= V^T W, 12 x 12 row by row, over `rows` rows of twelve numbers each.
void subtract_gram_12(double* C, const double* V, const double* W, std::size_t rows);

}  // namespace sunder

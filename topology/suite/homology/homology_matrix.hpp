// SPDX-License-Identifier: MIT
// Sparse integer matrices for homology: elimination of unit pivots, and the Smith normal form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunder::suite {

struct MatrixEntry {
  std::uint32_t row = 0;
  /// Never 0.
  std::int64_t value = 0;
  friend bool operator==(const MatrixEntry&, const MatrixEntry&) = default;
};

/// Columns of entries in rising order of rows.
struct SparseMatrix {
  std::size_t rows = 0;
  std::vector<std::vector<MatrixEntry>> columns;
};

/// The result of `eliminate_units` for a matrix.
struct Elimination {
  /// Number of pivots; one in each marked row and each marked column.
  std::size_t pivots = 0;
  std::vector<char> pivot_row, pivot_column;
  /// The rest without them: the matrix is equivalent to the identity of size `pivots` and this
  /// block. Over a field it is zero; over Z none of its entries is 1 or -1.
  SparseMatrix rest;
};

/// Gaussian elimination by columns, as long as some entry is a unit. `prime` 0: over Z, units are 1
/// and -1; otherwise over the field of `prime` elements (below 2^15). Rows with one entry go first
/// (a free face; costs nothing), then the shortest columns, each at its shortest row: little
/// fill-in on boundary matrices.
/// The square part of the marked rows and columns has determinant +1 or -1 (a unit), so for
/// matrices A, B with A B = 0, rows of B at pivot columns of A and columns of A at pivot rows of B
/// are integer combinations of the others: leaving them out keeps the rank and the elementary
/// divisors.
/// Throws std::overflow_error when a number over Z outgrows 64 bits.
Elimination eliminate_units(SparseMatrix matrix, int prime);

/// Elementary divisors (the diagonal of the Smith normal form without zeros), each dividing the
/// next. Dense, cubic: for the rest that `eliminate_units` leaves. Throws as that does.
std::vector<std::uint64_t> elementary_divisors(const SparseMatrix& matrix);

}  // namespace sunder::suite

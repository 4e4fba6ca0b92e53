// SPDX-License-Identifier: MIT
// Elimination of unit pivots in sparse matrices, and the Smith normal form of small ones.
#include "topology/suite/homology/homology_matrix.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>

namespace sunder::suite {
namespace {

using Column = std::vector<MatrixEntry>;

/// a - factor * b, exact or not at all.
std::int64_t less_multiple(std::int64_t a, std::int64_t factor, std::int64_t b) {
  std::int64_t product = 0, difference = 0;
  // The lowest number has no magnitude in 64 bits; it is taken for an overflow too.
  if (__builtin_mul_overflow(factor, b, &product) ||
      __builtin_sub_overflow(a, product, &difference) ||
      difference == std::numeric_limits<std::int64_t>::min()) {
    throw std::overflow_error("homology over Z: a number outgrew 64 bits");
  }
  return difference;
}

/// The integers (prime 0) or the field of `prime` elements, as numbers from 0 to prime - 1.
struct Ring {
  std::int64_t prime = 0;

  std::int64_t reduced(std::int64_t a) const {
    return prime == 0 ? a : (a % prime + prime) % prime;
  }
  bool is_unit(std::int64_t a) const { return prime == 0 ? a == 1 || a == -1 : a != 0; }
  /// Of a unit: a^(prime - 2), by Fermat.
  std::int64_t inverse(std::int64_t a) const {
    if (prime == 0) return a;
    std::int64_t power = 1;
    for (std::int64_t n = prime - 2; n > 0; n /= 2, a = a * a % prime) {
      if (n % 2 == 1) power = power * a % prime;
    }
    return power;
  }
};

const MatrixEntry* find_row(const Column& column, std::uint32_t row) {
  const auto at =
      std::lower_bound(column.begin(), column.end(), row,
                       [](const MatrixEntry& entry, std::uint32_t r) { return entry.row < r; });
  return at != column.end() && at->row == row ? &*at : nullptr;
}

class Eliminator {
 public:
  Eliminator(SparseMatrix matrix, int prime) : ring_{prime}, columns_(std::move(matrix.columns)) {
    result_.rest.rows = matrix.rows;
    result_.pivot_row.assign(matrix.rows, 0);
    result_.pivot_column.assign(columns_.size(), 0);
    columns_at_.resize(matrix.rows);
    row_size_.assign(matrix.rows, 0);
    for (std::uint32_t c = 0; c < columns_.size(); ++c) {
      for (MatrixEntry& entry : columns_[c]) entry.value = ring_.reduced(entry.value);
      std::erase_if(columns_[c], [](const MatrixEntry& entry) { return entry.value == 0; });
      for (const MatrixEntry& entry : columns_[c]) {
        columns_at_[entry.row].push_back(c);
        ++row_size_[entry.row];
      }
      waiting_.push({columns_[c].size(), c});
    }
    for (std::uint32_t r = 0; r < matrix.rows; ++r) {
      if (row_size_[r] == 1) single_rows_.push_back(r);
    }
  }

  Elimination run() && {
    do {
      while (!single_rows_.empty()) {
        const std::uint32_t row = single_rows_.back();
        single_rows_.pop_back();
        if (row_size_[row] == 1) take_single_row(row);
      }
    } while (take_short_column());
    for (Column& column : columns_) {
      if (!column.empty()) result_.rest.columns.push_back(std::move(column));
    }
    return std::move(result_);
  }

 private:
  void take_single_row(std::uint32_t row) {
    for (const std::uint32_t c : columns_at_[row]) {
      const MatrixEntry* entry = find_row(columns_[c], row);
      if (entry == nullptr) continue;
      if (ring_.is_unit(entry->value)) take_pivot(row, c);
      return;
    }
  }

  /// Takes one pivot in the shortest column that has a unit; false when there is none.
  bool take_short_column() {
    while (!waiting_.empty()) {
      const auto [size, c] = waiting_.top();
      waiting_.pop();
      if (columns_[c].size() != size || size == 0) continue;  // Has waited under another size too.
      const MatrixEntry* best = nullptr;
      for (const MatrixEntry& entry : columns_[c]) {
        if (!ring_.is_unit(entry.value)) continue;
        if (best == nullptr || row_size_[entry.row] < row_size_[best->row]) best = &entry;
      }
      if (best == nullptr) continue;  // It waits again when it changes.
      take_pivot(best->row, c);
      return true;
    }
    return false;
  }

  void take_pivot(std::uint32_t row, std::uint32_t c) {
    const Column pivot = std::move(columns_[c]);
    columns_[c].clear();
    const std::int64_t inverse = ring_.inverse(find_row(pivot, row)->value);
    // A column stands here twice when an entry came back after it had gone.
    const std::vector<std::uint32_t> others = std::move(columns_at_[row]);
    columns_at_[row].clear();
    for (const std::uint32_t other : others) {
      const MatrixEntry* entry = find_row(columns_[other], row);
      if (entry == nullptr) continue;
      const std::int64_t factor = ring_.reduced(entry->value * inverse);
      subtract(other, factor, pivot);
      waiting_.push({columns_[other].size(), other});
    }
    for (const MatrixEntry& entry : pivot) shrink(entry.row);
    ++result_.pivots;
    result_.pivot_row[row] = 1;
    result_.pivot_column[c] = 1;
  }

  void shrink(std::uint32_t row) {
    if (--row_size_[row] == 1) single_rows_.push_back(row);
  }

  /// Column `target` less `factor` times `pivot`.
  void subtract(std::uint32_t target, std::int64_t factor, const Column& pivot) {
    const Column& old = columns_[target];
    Column merged;
    merged.reserve(old.size() + pivot.size());
    auto a = old.begin();
    for (const MatrixEntry& b : pivot) {
      for (; a != old.end() && a->row < b.row; ++a) merged.push_back(*a);
      const bool both = a != old.end() && a->row == b.row;
      const std::int64_t value = ring_.reduced(less_multiple(both ? a->value : 0, factor, b.value));
      if (value != 0) merged.push_back({b.row, value});
      if (both && value == 0) shrink(b.row);
      if (!both) {
        ++row_size_[b.row];
        columns_at_[b.row].push_back(target);
      }
      a += both ? 1 : 0;
    }
    merged.insert(merged.end(), a, old.end());
    columns_[target] = std::move(merged);
  }

  Ring ring_;
  std::vector<Column> columns_;
  /// Columns with an entry in each row, and some that had one.
  std::vector<std::vector<std::uint32_t>> columns_at_;
  std::vector<std::size_t> row_size_;
  std::vector<std::uint32_t> single_rows_;
  /// (size, column), shortest first.
  using Waiting = std::pair<std::size_t, std::uint32_t>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
  Elimination result_;
};

/// A dense matrix on the way to its Smith normal form.
struct Dense {
  std::size_t rows = 0, columns = 0;
  std::vector<std::int64_t> values;
  std::int64_t& at(std::size_t i, std::size_t j) { return values[i * columns + j]; }
};

Dense dense(const SparseMatrix& matrix) {
  std::vector<std::uint32_t> rows;
  for (const Column& column : matrix.columns) {
    for (const MatrixEntry& entry : column) rows.push_back(entry.row);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  Dense result{rows.size(), matrix.columns.size(), {}};
  result.values.assign(result.rows * result.columns, 0);
  for (std::size_t c = 0; c < matrix.columns.size(); ++c) {
    for (const MatrixEntry& entry : matrix.columns[c]) {
      const auto row = std::lower_bound(rows.begin(), rows.end(), entry.row) - rows.begin();
      result.at(static_cast<std::size_t>(row), c) = entry.value;
    }
  }
  return result;
}

/// Brings the entry of least magnitude from (k, k) on to (k, k); false when all are zero.
bool bring_least(Dense& m, std::size_t k) {
  std::size_t row = m.rows, column = 0;
  for (std::size_t i = k; i < m.rows; ++i) {
    for (std::size_t j = k; j < m.columns; ++j) {
      if (m.at(i, j) == 0) continue;
      if (row < m.rows && std::abs(m.at(i, j)) >= std::abs(m.at(row, column))) continue;
      row = i;
      column = j;
    }
  }
  if (row == m.rows) return false;
  for (std::size_t j = 0; j < m.columns; ++j) std::swap(m.at(k, j), m.at(row, j));
  for (std::size_t i = 0; i < m.rows; ++i) std::swap(m.at(i, k), m.at(i, column));
  return true;
}

/// Divides row and column k by the entry (k, k); true when no remainder is left in either, nor
/// anywhere behind them.
bool divides_all(Dense& m, std::size_t k) {
  const auto clear_column = [&m, k](std::size_t j) {
    const std::int64_t factor = m.at(k, j) / m.at(k, k);
    for (std::size_t i = k; i < m.rows; ++i) {
      m.at(i, j) = less_multiple(m.at(i, j), factor, m.at(i, k));
    }
    return m.at(k, j) == 0;
  };
  const auto clear_row = [&m, k](std::size_t i) {
    const std::int64_t factor = m.at(i, k) / m.at(k, k);
    for (std::size_t j = k; j < m.columns; ++j) {
      m.at(i, j) = less_multiple(m.at(i, j), factor, m.at(k, j));
    }
    return m.at(i, k) == 0;
  };
  bool clear = true;
  for (std::size_t j = k + 1; j < m.columns; ++j) clear = clear_column(j) && clear;
  for (std::size_t i = k + 1; i < m.rows; ++i) clear = clear_row(i) && clear;
  if (!clear) return false;
  for (std::size_t i = k + 1; i < m.rows; ++i) {
    for (std::size_t j = k + 1; j < m.columns; ++j) {
      if (m.at(i, j) % m.at(k, k) == 0) continue;
      // Column j is added to column k: the next division leaves a smaller remainder.
      for (std::size_t r = k; r < m.rows; ++r) {
        m.at(r, k) = less_multiple(m.at(r, k), -1, m.at(r, j));
      }
      return false;
    }
  }
  return true;
}

}  // namespace

Elimination eliminate_units(SparseMatrix matrix, int prime) {
  return Eliminator(std::move(matrix), prime).run();
}

std::vector<std::uint64_t> elementary_divisors(const SparseMatrix& matrix) {
  Dense m = dense(matrix);
  std::vector<std::uint64_t> divisors;
  for (std::size_t k = 0; k < std::min(m.rows, m.columns) && bring_least(m, k); ++k) {
    while (!divides_all(m, k)) bring_least(m, k);
    divisors.push_back(static_cast<std::uint64_t>(std::abs(m.at(k, k))));
  }
  return divisors;
}

}  // namespace sunder::suite

// SPDX-License-Identifier: MIT
// Block elimination on top of a factor.
#include "mechanics/solver/factor_border.hpp"

#include <algorithm>

#include "mechanics/solver/block_panel.hpp"

namespace sunder {
namespace {

using Eigen::Index;
using Twelve = Eigen::Matrix<double, 12, 12, Eigen::RowMajor>;

/// Loads of vertices become loads of the unknowns: the origin bears the load of its copies too.
void fold(double* x, const FactorBorder& border, std::size_t lanes) {
  const std::size_t block = 3 * lanes;
  for (std::size_t c = border.columns.size(); c-- > 0;) {
    double* origin = x + block * border.columns[c].origin;
    const double* copy = x + block * (border.base + c);
    for (std::size_t k = 0; k < block; ++k) origin[k] += copy[k];
  }
}

/// Unknowns become displacements of vertices.
void unfold(double* x, const FactorBorder& border, std::size_t lanes) {
  const std::size_t block = 3 * lanes;
  for (std::size_t c = 0; c < border.columns.size(); ++c) {
    const double* origin = x + block * border.columns[c].origin;
    double* copy = x + block * (border.base + c);
    for (std::size_t k = 0; k < block; ++k) copy[k] += origin[k];
  }
}

/// Calls `visit(first, end)` for the scalar rows of every supernode marked.
template <class Visit>
void for_rows(const BlockAnalysis& analysis, const std::vector<char>& marked, Visit visit) {
  for (std::size_t s = 0; s < marked.size(); ++s) {
    if (!marked[s]) continue;
    visit(3 * std::size_t{analysis.supernodes[s].first},
          3 * std::size_t{analysis.supernodes[s].end});
  }
}

std::vector<char> both(const std::vector<char>& a, std::span<const char> b) {
  std::vector<char> marked(a);
  for (std::size_t s = 0; s < marked.size(); ++s) marked[s] = marked[s] && b[s];
  return marked;
}

/// - sum over the marked rows of a row of V times a row of W.
Twelve minus_product(const BlockAnalysis& analysis, const std::vector<char>& marked,
                     const double* V, const double* W) {
  AlignedDoubles sum(144, 0.0);
  for_rows(analysis, marked, [&](std::size_t first, std::size_t end) {
    subtract_gram_12(sum.data(), V + 12 * first, W + 12 * first, end - first);
  });
  return Eigen::Map<const Twelve>(sum.data());
}

/// The next columns, up to four, scattered: rows of the factor into the block, rows of copies into
/// `corner` (3 copies x 12).
void scatter_columns(BorderFactor::Block& block, Eigen::MatrixXd& corner, std::vector<char>& needed,
                     const BorderedMatrix& A) {
  const FactorBorder& border = A.border;
  const auto add = [&](std::uint32_t row, std::size_t j, const Eigen::Matrix3d& value) {
    if (row >= border.base) {
      const auto r = static_cast<Index>(3 * (row - border.base));
      corner.block<3, 3>(r, static_cast<Index>(3 * j)) += value;
      return;
    }
    mark_needed(needed, A.analysis, row);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        block.W[12 * (3 * row + r) + 3 * j + c] +=
            value(static_cast<Index>(r), static_cast<Index>(c));
      }
    }
  };
  for (std::size_t j = 0; j < block.count; ++j) {
    const FactorBorder::Column& column = border.columns[block.first + j];
    for (std::size_t e = 0; e < column.row.size(); ++e) {
      add(column.row[e], j, A.stiffness * column.stiffness[e]);
    }
    const Eigen::Matrix3d mass = A.mass * column.vertex_mass * Eigen::Matrix3d::Identity();
    auto row = static_cast<std::uint32_t>(border.base + block.first + j);
    for (; row >= border.base; row = border.columns[row - border.base].origin) add(row, j, mass);
    add(row, j, mass);
  }
}

/// Adds the block's rows to the Cholesky factor of the corner. `column`: 3 copies x 12.
bool grow_corner(BorderFactor& part, const BorderFactor::Block& block,
                 const Eigen::MatrixXd& column) {
  const auto old = static_cast<Index>(3 * block.first), more = static_cast<Index>(3 * block.count);
  if (part.corner.rows() < old + more) {
    part.corner.conservativeResize(2 * (old + more), 2 * (old + more));
  }
  Eigen::MatrixXd above = column.topLeftCorner(old, more);
  part.corner.topLeftCorner(old, old).triangularView<Eigen::Lower>().solveInPlace(above);
  Eigen::MatrixXd own = column.block(old, 0, more, more);
  own.noalias() -= above.transpose() * above;
  // The upper triangle is whole: a column knows the copies before it, not those that came after it
  // was made.
  own.triangularView<Eigen::StrictlyLower>() = own.transpose();
  const Eigen::LLT<Eigen::MatrixXd> llt(own);
  if (llt.info() != Eigen::Success || !own.allFinite()) return false;
  part.corner.block(old, 0, more, old) = above.transpose();
  // Saved states hold it whole.
  part.corner.block(0, old, old, more).setZero();
  part.corner.block(old, old, more, more) = llt.matrixL();
  return true;
}

/// z <- the solution with the corner's factor.
template <class Z>
void solve_corner(Z& z, const BorderFactor& part) {
  const auto size = static_cast<Index>(3 * part.copies);
  const auto corner = part.corner.topLeftCorner(size, size);
  corner.triangularView<Eigen::Lower>().solveInPlace(z);
  corner.transpose().triangularView<Eigen::Upper>().solveInPlace(z);
}

}  // namespace

void add_block(const FactorBorder& border, FactorBorder::Column& column, std::uint32_t row,
               const Eigen::Matrix3d& block) {
  for (;;) {
    const auto found = std::find(column.row.begin(), column.row.end(), row);
    const auto place = static_cast<std::size_t>(found - column.row.begin());
    if (found == column.row.end()) {
      column.row.push_back(row);
      column.stiffness.push_back(block);
    } else {
      column.stiffness[place] += block;
    }
    if (row < border.base) return;
    row = border.columns[row - border.base].origin;
  }
}

bool extend_border(BorderFactor& part, const BorderedMatrix& A) {
  part.needed.resize(A.analysis.supernodes.size(), 0);
  while (part.copies < A.border.columns.size()) {
    BorderFactor::Block block;
    block.first = part.copies;
    block.count = std::min<std::size_t>(4, A.border.columns.size() - part.copies);
    block.W.assign(36 * A.border.base, 0.0);
    const std::size_t copies = block.first + block.count;
    Eigen::MatrixXd corner =
        Eigen::MatrixXd::Zero(static_cast<Index>(3 * A.border.columns.size()), 12);
    std::vector<char> needed(A.analysis.supernodes.size(), 0);
    scatter_columns(block, corner, needed, A);
    solve_lower_12(block.W.data(), A.factor, A.analysis, needed);
    for (std::size_t s = 0; s < needed.size(); ++s) part.needed[s] |= needed[s];
    part.blocks.push_back(std::move(block));
    for (const BorderFactor::Block& other : part.blocks) {
      const auto rows = static_cast<Index>(3 * other.count);
      corner.middleRows(static_cast<Index>(3 * other.first), rows) +=
          minus_product(A.analysis, needed, other.W.data(), part.blocks.back().W.data())
              .topRows(rows);
    }
    if (!grow_corner(part, part.blocks.back(), corner)) return false;
    part.copies = copies;
  }
  return true;
}

void solve_bordered(double* x, const BorderFactor& part, const BorderedMatrix& A) {
  fold(x, A.border, 1);
  solve_lower(x, A.factor, A.analysis);
  Eigen::Map<Eigen::VectorXd> z(x + 3 * A.border.base, static_cast<Index>(3 * part.copies));
  using Row = Eigen::Map<const Eigen::Matrix<double, 12, 1>>;
  for (const BorderFactor::Block& block : part.blocks) {
    Eigen::Matrix<double, 12, 1> sum = Eigen::Matrix<double, 12, 1>::Zero();
    for_rows(A.analysis, part.needed, [&](std::size_t first, std::size_t end) {
      for (std::size_t r = first; r < end; ++r) sum += x[r] * Row(block.W.data() + 12 * r);
    });
    const auto count = static_cast<Index>(3 * block.count);
    z.segment(static_cast<Index>(3 * block.first), count) -= sum.head(count);
  }
  solve_corner(z, part);
  for (const BorderFactor::Block& block : part.blocks) {
    Eigen::Matrix<double, 12, 1> own = Eigen::Matrix<double, 12, 1>::Zero();
    const auto count = static_cast<Index>(3 * block.count);
    own.head(count) = z.segment(static_cast<Index>(3 * block.first), count);
    for_rows(A.analysis, part.needed, [&](std::size_t first, std::size_t end) {
      for (std::size_t r = first; r < end; ++r) x[r] -= own.dot(Row(block.W.data() + 12 * r));
    });
  }
  solve_upper(x, A.factor, A.analysis);
  unfold(x, A.border, 1);
}

void solve_bordered_12(double* X, const BorderFactor& part, const BorderedMatrix& A,
                       std::span<const char> loaded, std::span<const char> needed) {
  using RowsOf12 = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor>>;
  fold(X, A.border, 12);
  solve_lower_12(X, A.factor, A.analysis, loaded);
  RowsOf12 z(X + 36 * A.border.base, static_cast<Index>(3 * part.copies), 12);
  const std::vector<char> met = both(part.needed, loaded);
  for (const BorderFactor::Block& block : part.blocks) {
    const auto count = static_cast<Index>(3 * block.count);
    z.middleRows(static_cast<Index>(3 * block.first), count) +=
        minus_product(A.analysis, met, block.W.data(), X).topRows(count);
  }
  solve_corner(z, part);
  const std::vector<char> shared = both(part.needed, needed);
  for (const BorderFactor::Block& block : part.blocks) {
    const auto own =
        z.middleRows(static_cast<Index>(3 * block.first), static_cast<Index>(3 * block.count));
    for_rows(A.analysis, shared, [&](std::size_t first, std::size_t end) {
      const auto rows = static_cast<Index>(end - first);
      const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor>> W(
          block.W.data() + 12 * first, rows, 12);
      RowsOf12(X + 12 * first, rows, 12).noalias() -= W.leftCols(own.rows()) * own;
    });
  }
  solve_upper_12(X, A.factor, A.analysis, needed);
  unfold(X, A.border, 12);
}

}  // namespace sunder

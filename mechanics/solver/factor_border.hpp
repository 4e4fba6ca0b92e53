// SPDX-License-Identifier: MIT
// A factor that goes on serving after vertices have split: copies as borders of the old matrix.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "mechanics/solver/block_factor.hpp"

namespace sunder {

/// Copies of vertices that came after a factor was made, in extended rows: those of the factor
/// first, then one per copy. With x_copy = x_origin + delta as unknowns the old matrix is the
/// leading block of the new one (docs/explanation/theory.md, The factor). Vertices that came off
/// may stay: a vertex of another component has no load and no influence.
struct FactorBorder {
  /// One block column of the new matrix in those unknowns.
  struct Column {
    std::uint32_t origin = 0;  ///< extended row that the copy was part of
    double vertex_mass = 0;    ///< kg
    std::vector<std::uint32_t> row;
    std::vector<Eigen::Matrix3d> stiffness;  ///< of K, N/m, at each row
  };
  std::size_t base = 0;  ///< rows of the factor, of vertices
  std::vector<Column> columns;

  std::size_t rows() const { return base + columns.size(); }
};

/// Adds a block of K, N/m, to a column of the border: at its extended row and at all that the row
/// is a copy of, as the unknowns are differences.
void add_block(const FactorBorder& border, FactorBorder::Column& column, std::uint32_t row,
               const Eigen::Matrix3d& block);

/// The border's part of one factor: W = L^-1 B, and the factor of the remaining corner.
struct BorderFactor {
  /// Four copies at a time: 3 base rows of twelve numbers.
  struct Block {
    std::size_t first = 0, count = 0;  ///< copies
    AlignedDoubles W;
  };
  std::vector<Block> blocks;
  std::vector<char> needed;  ///< supernodes where W is not zero
  Eigen::MatrixXd corner;    ///< lower triangular, 3 copies; grows
  std::size_t copies = 0;    ///< entered so far
};

/// A = mass M + stiffness K, factored but for its border.
struct BorderedMatrix {
  const BlockFactor& factor;
  const BlockAnalysis& analysis;
  const FactorBorder& border;
  double mass, stiffness;
};

/// Enters the copies that `part` does not know yet; false where the matrix is not positive
/// definite. Twelve half back-solves for four copies, above the rows they touch: 0.5 ms at 6 000
/// tetrahedra.
bool extend_border(BorderFactor& part, const BorderedMatrix& A);

/// x <- A^-1 x on the extended rows: loads and answers of vertices, not of differences. `X`: the
/// same for twelve right-hand sides row by row, as in `solve_12`: loads in the supernodes `loaded`
/// and those above alone, answers in `needed`, which hold those. Copies count where their origins
/// do.
void solve_bordered(double* x, const BorderFactor& part, const BorderedMatrix& A);
void solve_bordered_12(double* X, const BorderFactor& part, const BorderedMatrix& A,
                       std::span<const char> loaded, std::span<const char> needed);

}  // namespace sunder

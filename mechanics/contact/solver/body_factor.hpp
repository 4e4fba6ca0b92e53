// SPDX-License-Identifier: MIT
// Cholesky factor of a sparse symmetric matrix of 6 x 6 blocks: few bodies, joined by contacts.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/state/columns.hpp"

namespace sunder {

/// A matrix with six rows per body, and its factor in place. For a heap of bodies the cost is in
/// the order of elimination and the entries' housekeeping, not in arithmetic. So it has dense
/// blocks and takes the body with the fewest neighbours first [Tinney, Walker 1967]. No unit.
class BodyFactor {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;

  /// All zero, for that many bodies.
  void reset(std::size_t bodies);

  /// Adds to the block in row `a` and column `b`. Off the diagonal needs a > b: the block above it
  /// is the transpose, and not given.
  void add(std::uint32_t a, std::uint32_t b, const Block& block);

  /// False where the matrix is not positive definite; then there is no factor.
  bool factor();

  /// x <- A^-1 x, six rows a body. Needs: `factor` gave true.
  void solve(Eigen::VectorXd& x) const;

  std::size_t size() const { return diagonal_.size(); }

 private:
  struct Entry {
    std::uint32_t body = 0, block = 0;
  };

  Block& between(std::uint32_t a, std::uint32_t b);
  void eliminate(std::uint32_t body);

  /// Of each body, ascending: those that it shares a block with; once it is eliminated, those that
  /// went later.
  std::vector<std::vector<Entry>> neighbours_;
  /// Rows of the higher body; of an eliminated one its columns.
  std::vector<Block> blocks_;
  std::vector<Block> diagonal_;  ///< L^-1 of eliminated bodies
  std::vector<std::uint32_t> order_;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Symmetric sparse matrices of 3 x 3 blocks, one row of blocks a vertex; and graphs of vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace sunder {

/// Neighbours of each vertex, itself not among them: `neighbour[start[i]] ..
/// neighbour[start[i+1]]`.
struct VertexGraph {
  std::vector<std::uint32_t> start;  ///< n + 1
  std::vector<std::uint32_t> neighbour;
  std::size_t size() const { return start.empty() ? 0 : start.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t vertex) const {
    return {neighbour.data() + start[vertex], neighbour.data() + start[vertex + 1]};
  }
};

/// The lower triangle of a symmetric matrix, column by column of blocks. Each column begins with
/// its diagonal block (held whole), then rows ascend.
struct BlockMatrix {
  std::vector<std::uint32_t> start;  ///< n + 1: places of blocks
  std::vector<std::uint32_t> row;    ///< of each block
  std::vector<double> value;         ///< nine a block, column by column
  std::size_t size() const { return start.empty() ? 0 : start.size() - 1; }
};

/// y = A x for 3 n numbers each; x and y apart. 10 ns a tetrahedron.
void multiply(double* y, const BlockMatrix& A, const double* x);

/// x . A x. 5 ns a tetrahedron.
double quadratic_form(const BlockMatrix& A, const double* x);

/// The graph of the leading `count` rows.
VertexGraph graph_of(const BlockMatrix& A, std::size_t count);

/// The leading rows with row i as row `place[i]`. Rows of a column do not ascend.
BlockMatrix renumbered(const BlockMatrix& A, std::span<const std::uint32_t> place);

/// Zeroes the rows and columns of held axes in the block of two vertices in a factor. A block on
/// the diagonal of the matrix keeps its own diagonal.
void leave_out(Eigen::Matrix3d& block, const std::array<bool, 3>& rows,
               const std::array<bool, 3>& columns, bool on_diagonal);

/// The matrix with such blocks. `held`: scalar rows, ascending.
BlockMatrix without_scalars(BlockMatrix A, std::span<const std::uint32_t> held);

/// The lower triangle of the leading 3 `count` rows and columns, scalar by scalar, for libraries.
Eigen::SparseMatrix<double> leading_scalars(const BlockMatrix& A, std::size_t count);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Products with matrices of blocks, and their scalars for libraries.
#include "mechanics/solver/block_matrix.hpp"

#include <algorithm>
#include <numeric>

namespace sunder {

void multiply(double* y, const BlockMatrix& A, const double* x) {
  const std::size_t n = A.size();
  std::fill(y, y + 3 * n, 0.0);
  const double* block = A.value.data();
  for (std::size_t j = 0; j < n; ++j) {
    const double x0 = x[3 * j], x1 = x[3 * j + 1], x2 = x[3 * j + 2];
    double s0 = block[0] * x0 + block[3] * x1 + block[6] * x2;
    double s1 = block[1] * x0 + block[4] * x1 + block[7] * x2;
    double s2 = block[2] * x0 + block[5] * x1 + block[8] * x2;
    block += 9;
    for (std::uint32_t e = A.start[j] + 1; e < A.start[j + 1]; ++e, block += 9) {
      const std::size_t i = 3 * std::size_t{A.row[e]};
      const double t0 = x[i], t1 = x[i + 1], t2 = x[i + 2];
      y[i] += block[0] * x0 + block[3] * x1 + block[6] * x2;
      y[i + 1] += block[1] * x0 + block[4] * x1 + block[7] * x2;
      y[i + 2] += block[2] * x0 + block[5] * x1 + block[8] * x2;
      s0 += block[0] * t0 + block[1] * t1 + block[2] * t2;
      s1 += block[3] * t0 + block[4] * t1 + block[5] * t2;
      s2 += block[6] * t0 + block[7] * t1 + block[8] * t2;
    }
    y[3 * j] += s0;
    y[3 * j + 1] += s1;
    y[3 * j + 2] += s2;
  }
}

double quadratic_form(const BlockMatrix& A, const double* x) {
  const double* block = A.value.data();
  double sum = 0;
  for (std::size_t j = 0; j < A.size(); ++j) {
    // Half of the diagonal block, and the blocks below it.
    double s0 = 0, s1 = 0, s2 = 0;
    const double half[3] = {0.5 * x[3 * j], 0.5 * x[3 * j + 1], 0.5 * x[3 * j + 2]};
    const double* y = half;
    for (std::uint32_t e = A.start[j]; e < A.start[j + 1]; ++e, block += 9) {
      if (e > A.start[j]) y = x + 3 * std::size_t{A.row[e]};
      s0 += block[0] * y[0] + block[1] * y[1] + block[2] * y[2];
      s1 += block[3] * y[0] + block[4] * y[1] + block[5] * y[2];
      s2 += block[6] * y[0] + block[7] * y[1] + block[8] * y[2];
    }
    sum += s0 * x[3 * j] + s1 * x[3 * j + 1] + s2 * x[3 * j + 2];
  }
  return 2 * sum;
}

VertexGraph graph_of(const BlockMatrix& A, std::size_t count) {
  VertexGraph graph;
  graph.start.assign(count + 1, 0);
  const auto for_links = [&](auto visit) {
    for (std::uint32_t j = 0; j < count; ++j) {
      for (std::uint32_t e = A.start[j] + 1; e < A.start[j + 1] && A.row[e] < count; ++e) {
        visit(j, A.row[e]);
        visit(A.row[e], j);
      }
    }
  };
  for_links([&](std::uint32_t a, std::uint32_t) { ++graph.start[a + 1]; });
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
  graph.neighbour.resize(graph.start.back());
  std::vector<std::uint32_t> next(graph.start.begin(), graph.start.end() - 1);
  for_links([&](std::uint32_t a, std::uint32_t b) { graph.neighbour[next[a]++] = b; });
  return graph;
}

BlockMatrix renumbered(const BlockMatrix& A, std::span<const std::uint32_t> place) {
  using Block = Eigen::Map<const Eigen::Matrix3d>;
  const std::size_t n = place.size();
  BlockMatrix B;
  B.start.assign(n + 1, 0);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::uint32_t e = A.start[j]; e < A.start[j + 1] && A.row[e] < n; ++e) {
      ++B.start[std::min(place[j], place[A.row[e]]) + 1];
    }
  }
  std::partial_sum(B.start.begin(), B.start.end(), B.start.begin());
  B.row.resize(B.start.back());
  B.value.resize(9 * B.row.size());
  std::vector<std::uint32_t> next;
  for (std::size_t j = 0; j < n; ++j) next.push_back(B.start[j] + 1);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::uint32_t e = A.start[j]; e < A.start[j + 1] && A.row[e] < n; ++e) {
      const std::uint32_t column = place[j], row = place[A.row[e]];
      const std::uint32_t at = row == column ? B.start[row] : next[std::min(row, column)]++;
      B.row[at] = std::max(row, column);
      const Block from(A.value.data() + 9 * std::size_t{e});
      Eigen::Map<Eigen::Matrix3d> to(B.value.data() + 9 * std::size_t{at});
      if (row >= column) {
        to = from;
      } else {
        to = from.transpose();
      }
    }
  }
  return B;
}

void leave_out(Eigen::Matrix3d& block, const std::array<bool, 3>& rows,
               const std::array<bool, 3>& columns, bool on_diagonal) {
  for (Eigen::Index c = 0; c < 3; ++c) {
    for (Eigen::Index r = 0; r < 3; ++r) {
      const bool held = rows[std::size_t(r)] || columns[std::size_t(c)];
      if (held && !(on_diagonal && r == c)) block(r, c) = 0;
    }
  }
}

BlockMatrix without_scalars(BlockMatrix A, std::span<const std::uint32_t> held) {
  std::vector<std::array<bool, 3>> axes(A.size(), std::array<bool, 3>{});
  for (const std::uint32_t scalar : held) axes[scalar / 3][scalar % 3] = true;
  for (std::size_t j = 0; j < A.size(); ++j) {
    for (std::uint32_t e = A.start[j]; e < A.start[j + 1]; ++e) {
      Eigen::Map<Eigen::Matrix3d> stored(A.value.data() + 9 * std::size_t{e});
      Eigen::Matrix3d block = stored;
      leave_out(block, axes[A.row[e]], axes[j], A.row[e] == j);
      stored = block;
    }
  }
  return A;
}

Eigen::SparseMatrix<double> leading_scalars(const BlockMatrix& A, std::size_t count) {
  const auto dofs = static_cast<Eigen::Index>(3 * count);
  Eigen::SparseMatrix<double> scalars(dofs, dofs);
  scalars.reserve(static_cast<Eigen::Index>(9 * A.row.size()));
  for (std::size_t j = 0; j < count; ++j) {
    for (int c = 0; c < 3; ++c) {
      const auto column = static_cast<Eigen::Index>(3 * j) + c;
      scalars.startVec(column);
      for (std::uint32_t e = A.start[j]; e < A.start[j + 1]; ++e) {
        if (A.row[e] >= count) break;
        for (int r = e == A.start[j] ? c : 0; r < 3; ++r) {
          scalars.insertBack(3 * static_cast<Eigen::Index>(A.row[e]) + r, column) =
              A.value[9 * std::size_t{e} + static_cast<std::size_t>(3 * c + r)];
        }
      }
    }
  }
  scalars.finalize();
  return scalars;
}

}  // namespace sunder

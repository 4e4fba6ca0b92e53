// SPDX-License-Identifier: MIT
// Assembly, elimination order, factor and compliance of one component.
#include "mechanics/component_system.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/OrderingMethods>

#include "mechanics/impact.hpp"
#include "mechanics/strain_displacement.hpp"
#include "topology/assert.hpp"

namespace sunder {
namespace {

using Sparse = ComponentSystem::Sparse;

/// Free vertices in minimum-degree order, held ones after them.
void choose_order(ComponentSystem& system, std::span<std::uint32_t> local_row,
                  const MechanicsState& state, std::span<const Corners> corners,
                  const Component& component) {
  constexpr std::uint32_t held = std::numeric_limits<std::uint32_t>::max();
  std::vector<VertexId> free;
  for (VertexId v : component.vertices) {
    const bool is_free = state.vertices.support[v.index()].is_none();
    local_row[v.index()] = is_free ? static_cast<std::uint32_t>(free.size()) : held;
    if (is_free) free.push_back(v);
  }
  system.free_count = free.size();

  std::vector<Eigen::Triplet<char>> links;
  links.reserve(component.tetrahedra.size() * 16);
  for (TetId t : component.tetrahedra) {
    for (VertexId a : corners[t.index()]) {
      for (VertexId b : corners[t.index()]) {
        const std::uint32_t i = local_row[a.index()];
        const std::uint32_t j = local_row[b.index()];
        if (i != held && j != held) {
          links.emplace_back(static_cast<int>(i), static_cast<int>(j), char{1});
        }
      }
    }
  }
  const int n = static_cast<int>(free.size());
  Eigen::SparseMatrix<char> graph(n, n);
  graph.setFromTriplets(links.begin(), links.end(), [](char a, char) { return a; });
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> eliminated;
  if (n > 0) Eigen::AMDOrdering<int>()(graph, eliminated);

  system.order.clear();
  for (int i = 0; i < n; ++i) {
    system.order.push_back(free[static_cast<std::size_t>(eliminated.indices()[i])]);
  }
  for (VertexId v : component.vertices) {
    if (local_row[v.index()] == held) system.order.push_back(v);
  }
  for (std::size_t i = 0; i < system.order.size(); ++i) {
    local_row[system.order[i].index()] = static_cast<std::uint32_t>(i);
  }
}

/// Blocks (row >= column) of the lower triangle, column by column, rows ascending.
struct BlockPattern {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> blocks;  ///< (column, row), sorted
  std::vector<std::size_t> column_start;                        ///< n + 1
};

BlockPattern block_pattern(std::span<const std::uint32_t> local_row,
                           std::span<const Corners> corners, const Component& component) {
  BlockPattern pattern;
  pattern.blocks.reserve(component.tetrahedra.size() * 10);
  for (TetId t : component.tetrahedra) {
    for (VertexId a : corners[t.index()]) {
      for (VertexId b : corners[t.index()]) {
        const std::uint32_t row = local_row[a.index()];
        const std::uint32_t column = local_row[b.index()];
        if (row >= column) pattern.blocks.emplace_back(column, row);
      }
    }
  }
  std::sort(pattern.blocks.begin(), pattern.blocks.end());
  pattern.blocks.erase(std::unique(pattern.blocks.begin(), pattern.blocks.end()),
                       pattern.blocks.end());
  pattern.column_start.assign(component.vertices.size() + 1, 0);
  for (const auto& [column, row] : pattern.blocks) ++pattern.column_start[column + 1];
  for (std::size_t j = 0; j < component.vertices.size(); ++j) {
    pattern.column_start[j + 1] += pattern.column_start[j];
  }
  return pattern;
}

/// The scalar matrix of the pattern, all zero. In scalar column 3 j + c the diagonal block gives
/// 3 - c rows and every later block 3.
Sparse empty_matrix(const BlockPattern& pattern) {
  const std::size_t n = pattern.column_start.size() - 1;
  Sparse K(static_cast<Eigen::Index>(3 * n), static_cast<Eigen::Index>(3 * n));
  K.resizeNonZeros(static_cast<Eigen::Index>(9 * pattern.blocks.size() - 3 * n));
  int* outer = K.outerIndexPtr();
  int* inner = K.innerIndexPtr();
  int next = 0;
  for (std::size_t j = 0; j < n; ++j) {
    for (int c = 0; c < 3; ++c) {
      outer[3 * j + static_cast<std::size_t>(c)] = next;
      for (std::size_t b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b) {
        const auto row = static_cast<int>(pattern.blocks[b].second);
        const int first = b == pattern.column_start[j] ? c : 0;
        for (int r = first; r < 3; ++r) inner[next++] = 3 * row + r;
      }
    }
  }
  outer[3 * n] = next;
  std::fill(K.valuePtr(), K.valuePtr() + next, 0.0);
  return K;
}

void add_block(Sparse& K, const BlockPattern& pattern,
               std::pair<std::uint32_t, std::uint32_t> column_row, const Mat3& block) {
  const auto begin = pattern.blocks.begin();
  const auto column_first =
      begin + static_cast<std::ptrdiff_t>(pattern.column_start[column_row.first]);
  const auto column_last =
      begin + static_cast<std::ptrdiff_t>(pattern.column_start[column_row.first + 1]);
  const auto place = std::lower_bound(column_first, column_last, column_row) - column_first;
  for (int c = 0; c < 3; ++c) {
    double* values = K.valuePtr() + K.outerIndexPtr()[3 * column_row.first + c];
    if (place == 0) {
      for (int r = c; r < 3; ++r) values[r - c] += block(r, c);
    } else {
      // The diagonal block before it took 3 - c places.
      for (int r = 0; r < 3; ++r) values[3 * place - c + r] += block(r, c);
    }
  }
}

}  // namespace

void build_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                  const MechanicsState& state, std::span<const Corners> corners,
                  const Component& component) {
  choose_order(system, local_row, state, corners, component);
  system.shape = rest_shape(state.vertices, system.order, component.rest_centre);
  const BlockPattern pattern = block_pattern(local_row, corners, component);
  system.stiffness = empty_matrix(pattern);
  const ElementColumns& elements = state.elements;
  for (TetId t : component.tetrahedra) {
    const ShapeGradient& G = elements.shape_gradient[t.index()];
    const Lame constants = lame(state.materials[elements.material[t.index()].index()]);
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        const std::uint32_t row = local_row[corners[t.index()][a].index()];
        const std::uint32_t column = local_row[corners[t.index()][b].index()];
        if (row < column) continue;
        add_block(system.stiffness, pattern, {column, row},
                  stiffness_block(G.col(a), G.col(b), elements.rest_volume[t.index()], constants));
      }
    }
  }
  system.cell_travel = cell_travel(state, component);
  for (SystemFactor* factor : {&system.step, &system.wave}) {
    factor->analysed = factor->factored = false;
    factor->touched.clear();
  }
}

void factor_system(ComponentSystem& system, const SystemMatrix& matrix, FactorUse use) {
  SystemFactor& own = factor_of(system, use);
  if (own.factored && own.matrix == matrix) return;
  own.touched.clear();
  const auto dofs = static_cast<Eigen::Index>(3 * system.free_count);
  if (dofs > 0) {
    Sparse A = system.stiffness.topLeftCorner(dofs, dofs);
    A *= matrix.stiffness;
    for (Eigen::Index i = 0; i < dofs; ++i) {
      // The diagonal comes first in every column of a lower triangle.
      A.valuePtr()[A.outerIndexPtr()[i]] += matrix.mass * system.shape.mass[i / 3];
    }
    if (!own.analysed) own.factor.analyzePattern(A);
    own.factor.factorize(A);
  }
  own.analysed = own.factored = true;
  own.matrix = matrix;
}

void solve_system(const ComponentSystem& system, Eigen::Ref<Eigen::MatrixXd> x, FactorUse use) {
  const SystemFactor& own = use == FactorUse::step ? system.step : system.wave;
  SUNDER_ASSERT(own.factored, "solve_system: no factor");
  if (system.free_count == 0) return;
  if (own.factor.info() != Eigen::Success) {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  own.factor.matrixL().solveInPlace(x);
  own.factor.matrixU().solveInPlace(x);
}

void multiply_stiffness(Eigen::Ref<Eigen::VectorXd> y, const ComponentSystem& system,
                        const Eigen::Ref<const Eigen::VectorXd>& x) {
  // By hand: Eigen's selfadjointView asks per entry on which side of the diagonal it is.
  const Sparse& K = system.stiffness;
  const int* outer = K.outerIndexPtr();
  const int* inner = K.innerIndexPtr();
  const double* value = K.valuePtr();
  y.setZero();
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    const double xj = x[j];
    double sum = value[outer[j]] * xj;
    for (int e = outer[j] + 1; e < outer[j + 1]; ++e) {
      sum += value[e] * x[inner[e]];
      y[inner[e]] += value[e] * xj;
    }
    y[j] += sum;
  }
}

namespace {

/// Vertices whose columns of A^-1 are solved for together: 12 right-hand sides fill the registers.
constexpr Eigen::Index block_vertices = 4;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3 * block_vertices, Eigen::RowMajor>;

/// Rows that the entries of A^-1 between touched vertices depend on: them and their ancestors in
/// the elimination tree (the parent of a column of L is its first row below the diagonal).
std::vector<bool> needed_rows(const Sparse& L, std::span<const std::uint32_t> touched) {
  std::vector<bool> needed(static_cast<std::size_t>(L.cols()), false);
  for (std::uint32_t v : touched) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      Eigen::Index j = 3 * static_cast<Eigen::Index>(v) + c;
      while (!needed[static_cast<std::size_t>(j)]) {
        needed[static_cast<std::size_t>(j)] = true;
        const int below = L.outerIndexPtr()[j] + 1;
        if (below == L.outerIndexPtr()[j + 1]) break;
        j = L.innerIndexPtr()[below];
      }
    }
  }
  return needed;
}

/// X <- (L L^T)^-1 X on the needed rows only; the others are left wrong.
void solve_needed(Columns& X, const Sparse& L, const std::vector<bool>& needed) {
  const int* outer = L.outerIndexPtr();
  const int* inner = L.innerIndexPtr();
  const double* value = L.valuePtr();
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    if (!needed[static_cast<std::size_t>(j)]) continue;
    X.row(j) /= value[outer[j]];
    for (int e = outer[j] + 1; e < outer[j + 1]; ++e) X.row(inner[e]) -= value[e] * X.row(j);
  }
  for (Eigen::Index j = L.cols() - 1; j >= 0; --j) {
    if (!needed[static_cast<std::size_t>(j)]) continue;
    for (int e = outer[j] + 1; e < outer[j + 1]; ++e) X.row(j) -= value[e] * X.row(inner[e]);
    X.row(j) /= value[outer[j]];
  }
}

/// Columns of A^-1 of the touched vertices from place `first` on, into the compliance cache. Only
/// rows at touched vertices are kept: those of later ones come from their own columns.
void fill_compliance(SystemFactor& system, std::size_t first) {
  const auto k = static_cast<Eigen::Index>(system.touched.size());
  if (system.compliance.rows() < 3 * k) system.compliance.conservativeResize(6 * k, 6 * k);
  if (system.factor.info() != Eigen::Success) {
    system.compliance.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const Sparse& L = system.factor.matrixL().nestedExpression();
  const std::vector<bool> needed = needed_rows(L, system.touched);
  Columns X(L.rows(), 3 * block_vertices);
  for (auto next = static_cast<Eigen::Index>(first); next < k; next += block_vertices) {
    const Eigen::Index count = std::min(block_vertices, k - next);
    X.setZero();
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::Index v = system.touched[static_cast<std::size_t>(next + b)];
      X.block<3, 3>(3 * v, 3 * b).setIdentity();
    }
    solve_needed(X, L, needed);
    for (Eigen::Index b = 0; b < count; ++b) {
      for (Eigen::Index i = 0; i < k; ++i) {
        const Eigen::Index v = system.touched[static_cast<std::size_t>(i)];
        const Mat3 block = X.block<3, 3>(3 * v, 3 * b);
        system.compliance.block<3, 3>(3 * i, 3 * (next + b)) = block;
        system.compliance.block<3, 3>(3 * (next + b), 3 * i) = block.transpose();
      }
    }
  }
}

}  // namespace

std::vector<std::uint32_t> touch_compliance(ComponentSystem& system,
                                            std::span<const std::uint32_t> local_vertices,
                                            FactorUse use) {
  SystemFactor& own = factor_of(system, use);
  const std::size_t known = own.touched.size();
  std::vector<std::uint32_t> places;
  places.reserve(local_vertices.size());
  for (std::uint32_t v : local_vertices) {
    SUNDER_ASSERT(v < system.free_count, "touch_compliance: the vertex is held");
    const auto found = std::find(own.touched.begin(), own.touched.end(), v);
    places.push_back(static_cast<std::uint32_t>(found - own.touched.begin()));
    if (found == own.touched.end()) own.touched.push_back(v);
  }
  if (own.touched.size() > known) fill_compliance(own, known);
  return places;
}

}  // namespace sunder

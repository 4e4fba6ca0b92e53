// SPDX-License-Identifier: MIT
// The factor of a system, solves with it, and compliance.
#include <algorithm>
#include <limits>
#include <numeric>

#include "mechanics/solver/component_system.hpp"
#include "mechanics/solver/parallel.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// The rows of the factor, of vertices: free ones, or extended ones.
std::size_t factor_rows(const ComponentSystem& system) {
  return system.analysis.order.size() + system.border.columns.size();
}

std::uint32_t factor_row(const ComponentSystem& system, std::size_t local) {
  return system.factor_row.empty() ? static_cast<std::uint32_t>(local) : system.factor_row[local];
}

BorderedMatrix bordered(const ComponentSystem& system, const SystemFactor& own) {
  return {own.factor, system.analysis, system.border, own.matrix.mass, own.matrix.stiffness};
}

/// A new order of elimination for the system as it is. Its numbering stays.
void renew_analysis(ComponentSystem& system) {
  system.analysis = analyse(graph_of(system.stiffness, system.free_count));
  system.factor_row.resize(system.free_count);
  system.row_vertex.clear();
  for (std::uint32_t i = 0; i < system.free_count; ++i) {
    system.factor_row[system.analysis.order[i]] = i;
    system.row_vertex.push_back(system.order[system.analysis.order[i]]);
  }
  system.border = {};
  system.border_age = 0;
  system.step.factored = false;
  system.step.border = {};
  system.step.touched.clear();
}

void make_factor(ComponentSystem& system, SystemFactor& own) {
  FactorScratch scratch;
  BlockMatrix left;
  if (!system.held_scalars.empty()) left = without_scalars(system.stiffness, system.held_scalars);
  const BlockMatrix& stiffness = system.held_scalars.empty() ? system.stiffness : left;
  if (system.factor_row.empty()) {
    factor(own.factor, system.analysis,
           {stiffness, system.shape.mass, own.matrix.mass, own.matrix.stiffness}, scratch);
    return;
  }
  const BlockMatrix K = renumbered(stiffness, system.factor_row);
  Eigen::VectorXd mass(static_cast<Eigen::Index>(system.free_count));
  for (std::size_t i = 0; i < system.free_count; ++i) {
    mass[system.factor_row[i]] = system.shape.mass[static_cast<Eigen::Index>(i)];
  }
  factor(own.factor, system.analysis, {K, mass, own.matrix.mass, own.matrix.stiffness}, scratch);
}

/// x <- A^-1 x by way of the rows of the factor.
void solve_extended(double* x, const ComponentSystem& system, const SystemFactor& own) {
  own.extended.assign(3 * factor_rows(system), 0.0);
  double* extended = own.extended.data();
  for (std::size_t i = 0; i < system.free_count; ++i) {
    std::copy_n(x + 3 * i, 3, extended + 3 * std::size_t{system.factor_row[i]});
  }
  if (system.border.columns.empty()) {
    solve(extended, own.factor, system.analysis);
  } else {
    solve_bordered(extended, own.border, bordered(system, own));
  }
  for (std::size_t i = 0; i < system.free_count; ++i) {
    std::copy_n(extended + 3 * std::size_t{system.factor_row[i]}, 3, x + 3 * i);
  }
}

}  // namespace

void factor_system(ComponentSystem& system, const SystemMatrix& matrix) {
  SystemFactor& own = system.step;
  // With copies, or rows of vertices that came off, the present system has no order of elimination.
  const bool is_extended =
      !system.border.columns.empty() || factor_rows(system) != system.free_count;
  bool serves = own.factored && own.matrix == matrix;
  if (is_extended) {
    serves = serves && ++system.border_age <= BorderLimits::age &&
             extend_border(own.border, bordered(system, own));
    if (!serves) renew_analysis(system);
  }
  if (serves) return;
  own.touched.clear();
  own.matrix = matrix;
  make_factor(system, own);
  own.factored = true;
}

void solve_system(const ComponentSystem& system, Eigen::Ref<Eigen::MatrixXd> x) {
  const SystemFactor& own = system.step;
  SUNDER_ASSERT(own.factored, "solve_system: no factor");
  if (!own.factor.positive_definite) {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  for (const std::uint32_t scalar : system.held_scalars) x.row(scalar).setZero();
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    if (system.factor_row.empty()) {
      solve(x.col(j).data(), own.factor, system.analysis);
    } else {
      solve_extended(x.col(j).data(), system, own);
    }
  }
}

void multiply_stiffness(Eigen::Ref<Eigen::VectorXd> y, const ComponentSystem& system,
                        const Eigen::Ref<const Eigen::VectorXd>& x) {
  multiply(y.data(), system.stiffness, x.data());
}

namespace {

/// The row of the factor that a vertex is, or is a copy of.
std::uint32_t origin_row(const ComponentSystem& system, std::uint32_t vertex) {
  const std::size_t base = system.analysis.order.size();
  std::uint32_t row = factor_row(system, vertex);
  while (row >= base) row = system.border.columns[row - base].origin;
  return row;
}

}  // namespace

void mark_supernodes(std::vector<char>& marked, const ComponentSystem& system,
                     std::span<const std::uint32_t> vertices) {
  marked.assign(system.analysis.supernodes.size(), 0);
  for (std::uint32_t v : vertices) mark_needed(marked, system.analysis, origin_row(system, v));
}

namespace {

/// Zeros where loads and answers will be.
void clear_rows(AlignedDoubles& X, const ComponentSystem& system, std::span<const char> needed) {
  if (X.size() < 36 * factor_rows(system)) X.resize(36 * factor_rows(system));
  for (std::size_t s = 0; s < needed.size(); ++s) {
    if (!needed[s]) continue;
    const Supernode& node = system.analysis.supernodes[s];
    std::fill(X.data() + 36 * node.first, X.data() + 36 * node.end, 0.0);
  }
  std::fill(X.data() + 36 * system.analysis.order.size(), X.data() + 36 * factor_rows(system), 0.0);
}

/// The columns of A^-1 of up to four touched vertices, by their places, into the compliance cache.
/// A column gives the entries between its vertex and those of lower places, so that no two columns
/// write the same.
void fill_block(SystemFactor& own, const ComponentSystem& system, const ColumnBlock& task,
                ColumnScratch& scratch) {
  const std::span<const std::uint32_t> places = task.places();
  std::array<std::uint32_t, ColumnBlock::size> vertices;
  for (std::size_t b = 0; b < places.size(); ++b) vertices[b] = own.touched[places[b]];
  mark_supernodes(scratch.loaded, system, {vertices.data(), places.size()});
  clear_rows(scratch.X, system, own.needed);
  const auto block = [&](std::uint32_t vertex, std::size_t b) {
    return Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>, 0, Eigen::OuterStride<12>>(
        scratch.X.data() + 36 * std::size_t{factor_row(system, vertex)} + 3 * b);
  };
  for (std::size_t b = 0; b < places.size(); ++b) {
    block(vertices[b], b).setIdentity();
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if (std::ranges::binary_search(system.held_scalars, 3 * vertices[b] + axis)) {
        block(vertices[b], b)(axis, axis) = 0;
      }
    }
  }
  if (system.border.columns.empty()) {
    solve_lower_12(scratch.X.data(), own.factor, system.analysis, scratch.loaded);
    solve_upper_12(scratch.X.data(), own.factor, system.analysis, own.needed);
  } else {
    solve_bordered_12(scratch.X.data(), own.border, bordered(system, own), scratch.loaded,
                      own.needed);
  }
  for (std::size_t b = 0; b < places.size(); ++b) {
    const auto column = static_cast<Eigen::Index>(3 * places[b]);
    for (std::size_t i = 0; i <= places[b]; ++i) {
      const auto row = static_cast<Eigen::Index>(3 * i);
      const Mat3 answer = block(own.touched[i], b);
      own.compliance.block<3, 3>(row, column) = answer;
      own.compliance.block<3, 3>(column, row) = answer.transpose();
    }
  }
}

}  // namespace

void fill_columns(std::span<const ColumnBlock> blocks, unsigned threads,
                  std::vector<ColumnScratch>& scratch) {
  scratch.resize(std::max<std::size_t>(scratch.size(), std::max(threads, 1u)));
  parallel_for(threads, blocks.size(), [&](std::size_t k, unsigned worker) {
    const ColumnBlock& block = blocks[k];
    fill_block(block.system->step, *block.system, block, scratch[worker]);
  });
}

std::vector<std::uint32_t> note_touched(ComponentSystem& system,
                                        std::span<const std::uint32_t> local_vertices,
                                        std::vector<ColumnBlock>& missing) {
  SystemFactor& own = system.step;
  const std::size_t known = own.touched.size();
  std::vector<std::uint32_t> places;
  places.reserve(local_vertices.size());
  for (std::uint32_t v : local_vertices) {
    SUNDER_ASSERT(v < system.free_count, "note_touched: the vertex is held");
    const auto found = std::find(own.touched.begin(), own.touched.end(), v);
    places.push_back(static_cast<std::uint32_t>(found - own.touched.begin()));
    if (found == own.touched.end()) own.touched.push_back(v);
  }
  if (own.touched.size() == known) return places;
  const auto size = static_cast<Eigen::Index>(3 * own.touched.size());
  if (own.compliance.rows() < size) own.compliance.conservativeResize(2 * size, 2 * size);
  if (!own.factor.positive_definite) {
    own.compliance.setConstant(std::numeric_limits<double>::quiet_NaN());
    return places;
  }
  mark_supernodes(own.needed, system, own.touched);
  // Neighbours in the order of elimination share most of their way up.
  std::vector<std::uint32_t> fresh(own.touched.size() - known);
  std::iota(fresh.begin(), fresh.end(), static_cast<std::uint32_t>(known));
  const auto row = [&](std::uint32_t place) { return origin_row(system, own.touched[place]); };
  std::ranges::stable_sort(fresh, {}, row);
  for (std::size_t first = 0; first < fresh.size(); first += ColumnBlock::size) {
    ColumnBlock block{&system, 0, {}};
    for (; block.count < ColumnBlock::size && first + block.count < fresh.size(); ++block.count) {
      block.place[block.count] = fresh[first + block.count];
    }
    missing.push_back(block);
  }
  return places;
}

std::vector<std::uint32_t> touch_compliance(ComponentSystem& system,
                                            std::span<const std::uint32_t> local_vertices) {
  std::vector<ColumnBlock> missing;
  std::vector<ColumnScratch> scratch;
  std::vector<std::uint32_t> places = note_touched(system, local_vertices, missing);
  fill_columns(missing, 1, scratch);
  return places;
}

}  // namespace sunder

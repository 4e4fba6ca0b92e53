// SPDX-License-Identifier: MIT
// Factors of a system, solves with them, and compliance.
#include <algorithm>
#include <limits>

#include "mechanics/component_system.hpp"
#include "topology/assert.hpp"

namespace sunder {
namespace {

/// The rows of the factors, of vertices: free ones, or extended ones.
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
  for (SystemFactor* own : {&system.step, &system.wave}) {
    own->factored = false;
    own->border = {};
    own->touched.clear();
  }
}

void make_factor(ComponentSystem& system, SystemFactor& own) {
  FactorRoom room;
  if (system.factor_row.empty()) {
    factor(own.factor, system.analysis,
           {system.stiffness, system.shape.mass, own.matrix.mass, own.matrix.stiffness}, room);
    return;
  }
  const BlockMatrix K = renumbered(system.stiffness, system.factor_row);
  Eigen::VectorXd mass(static_cast<Eigen::Index>(system.free_count));
  for (std::size_t i = 0; i < system.free_count; ++i) {
    mass[system.factor_row[i]] = system.shape.mass[static_cast<Eigen::Index>(i)];
  }
  factor(own.factor, system.analysis, {K, mass, own.matrix.mass, own.matrix.stiffness}, room);
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

void factor_system(ComponentSystem& system, const SystemMatrix& matrix, FactorUse use) {
  SystemFactor& own = factor_of(system, use);
  const bool has_border = !system.border.columns.empty();
  bool serves = own.factored && own.matrix == matrix;
  if (has_border) {
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

void solve_system(const ComponentSystem& system, Eigen::Ref<Eigen::MatrixXd> x, FactorUse use) {
  const SystemFactor& own = use == FactorUse::step ? system.step : system.wave;
  SUNDER_ASSERT(own.factored, "solve_system: no factor");
  if (!own.factor.positive_definite) {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
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

/// Vertices whose columns of A^-1 are solved for together: 12 right-hand sides fill the registers.
constexpr std::size_t block_vertices = 4;

/// Supernodes that the entries of A^-1 between touched vertices depend on: theirs and all above.
std::vector<char> needed_supernodes(const ComponentSystem& system,
                                    std::span<const std::uint32_t> touched) {
  std::vector<char> needed(system.analysis.supernodes.size(), 0);
  const std::size_t base = system.analysis.order.size();
  for (std::uint32_t v : touched) {
    std::uint32_t row = factor_row(system, v);
    while (row >= base) row = system.border.columns[row - base].origin;
    mark_needed(needed, system.analysis, row);
  }
  return needed;
}

/// Columns of A^-1 of the touched vertices from place `first` on, into the compliance cache. Only
/// rows at touched vertices are kept: those of later ones come from their own columns.
void fill_compliance(SystemFactor& own, const ComponentSystem& system, std::size_t first) {
  const std::size_t k = own.touched.size();
  const auto size = static_cast<Eigen::Index>(3 * k);
  if (own.compliance.rows() < size) own.compliance.conservativeResize(2 * size, 2 * size);
  if (!own.factor.positive_definite) {
    own.compliance.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const std::vector<char> needed = needed_supernodes(system, own.touched);
  AlignedDoubles X(36 * factor_rows(system));
  const auto block = [&](std::uint32_t vertex, std::size_t b) {
    return Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>, 0, Eigen::OuterStride<12>>(
        X.data() + 36 * std::size_t{factor_row(system, vertex)} + 3 * b);
  };
  for (std::size_t next = first; next < k; next += block_vertices) {
    const std::size_t count = std::min(block_vertices, k - next);
    std::fill(X.begin(), X.end(), 0.0);
    for (std::size_t b = 0; b < count; ++b) block(own.touched[next + b], b).setIdentity();
    if (system.border.columns.empty()) {
      solve_12(X.data(), own.factor, system.analysis, needed);
    } else {
      solve_bordered_12(X.data(), own.border, bordered(system, own), needed);
    }
    for (std::size_t b = 0; b < count; ++b) {
      const auto column = static_cast<Eigen::Index>(3 * (next + b));
      for (std::size_t i = 0; i < k; ++i) {
        const auto row = static_cast<Eigen::Index>(3 * i);
        const Mat3 answer = block(own.touched[i], b);
        own.compliance.block<3, 3>(row, column) = answer;
        own.compliance.block<3, 3>(column, row) = answer.transpose();
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
  if (own.touched.size() > known) fill_compliance(own, system, known);
  return places;
}

}  // namespace sunder

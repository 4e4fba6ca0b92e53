// SPDX-License-Identifier: MIT
// Assembly, elimination order, factor and compliance of one component.
#include "mechanics/component_system.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mechanics/impact.hpp"
#include "mechanics/strain_displacement.hpp"
#include "topology/assert.hpp"

namespace sunder {
namespace {

/// Row of a vertex that is held, while free ones are numbered.
constexpr std::uint32_t held = std::numeric_limits<std::uint32_t>::max();

/// The tetrahedra at every vertex of a component, in its own numbers.
struct VertexStars {
  std::vector<std::uint32_t> start;  ///< n + 1
  std::vector<TetId> tetrahedron;

  std::span<const TetId> of(std::size_t row) const {
    return {tetrahedron.data() + start[row], tetrahedron.data() + start[row + 1]};
  }
};

/// Rows are those of `Component::vertices`.
VertexStars vertex_stars(std::span<const std::uint32_t> row, std::span<const Corners> corners,
                         const Component& component) {
  VertexStars stars;
  stars.start.assign(component.vertices.size() + 1, 0);
  for (TetId t : component.tetrahedra) {
    for (VertexId v : corners[t.index()]) ++stars.start[row[v.index()] + 1];
  }
  std::partial_sum(stars.start.begin(), stars.start.end(), stars.start.begin());
  stars.tetrahedron.resize(4 * component.tetrahedra.size());
  std::vector<std::uint32_t> next(stars.start.begin(), stars.start.end() - 1);
  for (TetId t : component.tetrahedra) {
    for (VertexId v : corners[t.index()]) stars.tetrahedron[next[row[v.index()]]++] = t;
  }
  return stars;
}

/// The graph of the free vertices, numbered by `free_row` (or `held`).
VertexGraph free_graph(const VertexStars& stars, std::span<const std::uint32_t> free_row,
                       std::span<const Corners> corners, const Component& component) {
  VertexGraph graph;
  graph.start.push_back(0);
  std::vector<std::uint32_t> mark(component.vertices.size(), held);
  for (std::size_t i = 0; i < component.vertices.size(); ++i) {
    const std::uint32_t own = free_row[component.vertices[i].index()];
    if (own == held) continue;
    mark[own] = own;
    for (TetId t : stars.of(i)) {
      for (VertexId v : corners[t.index()]) {
        const std::uint32_t other = free_row[v.index()];
        if (other == held || mark[other] == own) continue;
        mark[other] = own;
        graph.neighbour.push_back(other);
      }
    }
    graph.start.push_back(static_cast<std::uint32_t>(graph.neighbour.size()));
  }
  return graph;
}

/// Free vertices in the order of elimination, held ones after them; `local_row` says which.
/// Gives the tetrahedra at each row.
VertexStars choose_order(ComponentSystem& system, std::span<std::uint32_t> local_row,
                         const MechanicsState& state, std::span<const Corners> corners,
                         const Component& component) {
  for (std::size_t i = 0; i < component.vertices.size(); ++i) {
    local_row[component.vertices[i].index()] = static_cast<std::uint32_t>(i);
  }
  const VertexStars stars = vertex_stars(local_row, corners, component);
  std::vector<std::uint32_t> natural, held_rows;
  for (std::size_t i = 0; i < component.vertices.size(); ++i) {
    const VertexId v = component.vertices[i];
    const bool is_free = state.vertices.support[v.index()].is_none();
    (is_free ? natural : held_rows).push_back(static_cast<std::uint32_t>(i));
    local_row[v.index()] = is_free ? static_cast<std::uint32_t>(natural.size() - 1) : held;
  }
  system.free_count = natural.size();
  system.analysis = analyse(free_graph(stars, local_row, corners, component));

  std::vector<std::uint32_t> rows;
  for (std::uint32_t i : system.analysis.order) rows.push_back(natural[i]);
  rows.insert(rows.end(), held_rows.begin(), held_rows.end());
  system.order.clear();
  VertexStars ordered;
  ordered.start.push_back(0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const VertexId v = component.vertices[rows[i]];
    system.order.push_back(v);
    local_row[v.index()] = static_cast<std::uint32_t>(i);
    const auto star = stars.of(rows[i]);
    ordered.tetrahedron.insert(ordered.tetrahedron.end(), star.begin(), star.end());
    ordered.start.push_back(static_cast<std::uint32_t>(ordered.tetrahedron.size()));
  }
  return ordered;
}

/// The rows of every column, its own first and then ascending.
void set_pattern(BlockMatrix& K, const VertexStars& stars, std::span<const std::uint32_t> local_row,
                 std::span<const Corners> corners) {
  const std::size_t n = stars.start.size() - 1;
  std::vector<std::uint32_t> mark(n, held);
  K.start.assign(1, 0);
  K.row.clear();
  for (std::uint32_t j = 0; j < n; ++j) {
    const auto begin = static_cast<std::ptrdiff_t>(K.row.size());
    for (TetId t : stars.of(j)) {
      for (VertexId v : corners[t.index()]) {
        const std::uint32_t row = local_row[v.index()];
        if (row < j || mark[row] == j) continue;
        mark[row] = j;
        K.row.push_back(row);
      }
    }
    std::sort(K.row.begin() + begin, K.row.end());
    K.start.push_back(static_cast<std::uint32_t>(K.row.size()));
  }
  K.value.assign(9 * K.row.size(), 0.0);
}

/// Adds up K, column by column.
void assemble_stiffness(BlockMatrix& K, const VertexStars& stars,
                        std::span<const std::uint32_t> local_row, const MechanicsState& state,
                        std::span<const Corners> corners) {
  const ElementColumns& elements = state.elements;
  std::vector<Lame> constants;
  for (const Material& material : state.materials) constants.push_back(lame(material));
  std::vector<std::uint32_t> place(K.size());
  for (std::uint32_t j = 0; j < K.size(); ++j) {
    for (std::uint32_t e = K.start[j]; e < K.start[j + 1]; ++e) place[K.row[e]] = e;
    for (TetId t : stars.of(j)) {
      const ShapeGradient& G = elements.shape_gradient[t.index()];
      const Corners& c = corners[t.index()];
      int own = 0;
      while (local_row[c[static_cast<std::size_t>(own)].index()] != j) ++own;
      for (int a = 0; a < 4; ++a) {
        const std::uint32_t row = local_row[c[static_cast<std::size_t>(a)].index()];
        if (row < j) continue;
        Eigen::Map<Mat3>(K.value.data() + 9 * std::size_t{place[row]}) +=
            stiffness_block(G.col(a), G.col(own), elements.rest_volume[t.index()],
                            constants[elements.material[t.index()].index()]);
      }
    }
  }
}

}  // namespace

void build_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                  const MechanicsState& state, std::span<const Corners> corners,
                  const Component& component) {
  const VertexStars stars = choose_order(system, local_row, state, corners, component);
  system.shape = rest_shape(state.vertices, system.order, component.rest_centre);
  set_pattern(system.stiffness, stars, local_row, corners);
  assemble_stiffness(system.stiffness, stars, local_row, state, corners);
  system.cell_travel = cell_travel(state, component);
  for (SystemFactor* factor : {&system.step, &system.wave}) {
    factor->factored = false;
    factor->touched.clear();
  }
}

void factor_system(ComponentSystem& system, const SystemMatrix& matrix, FactorUse use) {
  SystemFactor& own = factor_of(system, use);
  if (own.factored && own.matrix == matrix) return;
  own.touched.clear();
  FactorRoom room;
  factor(own.factor, system.analysis,
         {system.stiffness, system.shape.mass, matrix.mass, matrix.stiffness}, room);
  own.factored = true;
  own.matrix = matrix;
}

void solve_system(const ComponentSystem& system, Eigen::Ref<Eigen::MatrixXd> x, FactorUse use) {
  const SystemFactor& own = use == FactorUse::step ? system.step : system.wave;
  SUNDER_ASSERT(own.factored, "solve_system: no factor");
  if (!own.factor.positive_definite) {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    solve(x.col(j).data(), own.factor, system.analysis);
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
std::vector<char> needed_supernodes(const BlockAnalysis& analysis,
                                    std::span<const std::uint32_t> touched) {
  std::vector<char> needed(analysis.supernodes.size(), 0);
  for (std::uint32_t v : touched) {
    std::uint32_t s = analysis.supernode_of[v];
    for (; s != Supernode::none && !needed[s]; s = analysis.supernodes[s].parent) needed[s] = 1;
  }
  return needed;
}

/// Columns of A^-1 of the touched vertices from place `first` on, into the compliance cache. Only
/// rows at touched vertices are kept: those of later ones come from their own columns.
void fill_compliance(SystemFactor& own, const BlockAnalysis& analysis, std::size_t first) {
  const std::size_t k = own.touched.size();
  const auto size = static_cast<Eigen::Index>(3 * k);
  if (own.compliance.rows() < size) own.compliance.conservativeResize(2 * size, 2 * size);
  if (!own.factor.positive_definite) {
    own.compliance.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const std::vector<char> needed = needed_supernodes(analysis, own.touched);
  AlignedDoubles X(36 * analysis.order.size());
  const auto block = [&X](std::uint32_t vertex, std::size_t b) {
    return Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>, 0, Eigen::OuterStride<12>>(
        X.data() + 36 * std::size_t{vertex} + 3 * b);
  };
  for (std::size_t next = first; next < k; next += block_vertices) {
    const std::size_t count = std::min(block_vertices, k - next);
    std::fill(X.begin(), X.end(), 0.0);
    for (std::size_t b = 0; b < count; ++b) block(own.touched[next + b], b).setIdentity();
    solve_12(X, own.factor, analysis, needed);
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
  if (own.touched.size() > known) fill_compliance(own, system.analysis, known);
  return places;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Assembly and elimination order of one component.
#include "mechanics/solver/component_system.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mechanics/element/second_order.hpp"
#include "mechanics/solver/assemble_system.hpp"
#include "mechanics/state/supports.hpp"

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

ElementNodes nodes_in(const SystemInput& input, TetId t) {
  return nodes_of(input.state.elements, input.corners, t);
}

/// Rows are those of `Component::vertices`.
VertexStars vertex_stars(std::span<const std::uint32_t> row, const SystemInput& input) {
  const Component& component = input.component;
  VertexStars stars;
  stars.start.assign(component.vertices.size() + 1, 0);
  for (TetId t : component.tetrahedra) {
    for (VertexId v : nodes_in(input, t)) ++stars.start[row[v.index()] + 1];
  }
  std::partial_sum(stars.start.begin(), stars.start.end(), stars.start.begin());
  stars.tetrahedron.resize(stars.start.back());
  std::vector<std::uint32_t> next(stars.start.begin(), stars.start.end() - 1);
  for (TetId t : component.tetrahedra) {
    for (VertexId v : nodes_in(input, t)) stars.tetrahedron[next[row[v.index()]]++] = t;
  }
  return stars;
}

/// The graph of the free vertices, numbered by `free_row` (or `held`).
VertexGraph free_graph(const VertexStars& stars, std::span<const std::uint32_t> free_row,
                       const SystemInput& input) {
  const Component& component = input.component;
  VertexGraph graph;
  graph.start.push_back(0);
  std::vector<std::uint32_t> mark(component.vertices.size(), held);
  for (std::size_t i = 0; i < component.vertices.size(); ++i) {
    const std::uint32_t own = free_row[component.vertices[i].index()];
    if (own == held) continue;
    mark[own] = own;
    for (TetId t : stars.of(i)) {
      for (VertexId v : nodes_in(input, t)) {
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
void choose_order(ComponentSystem& system, std::span<std::uint32_t> local_row,
                  const SystemInput& input) {
  const Component& component = input.component;
  for (std::size_t i = 0; i < component.vertices.size(); ++i) {
    local_row[component.vertices[i].index()] = static_cast<std::uint32_t>(i);
  }
  const VertexStars stars = vertex_stars(local_row, input);
  std::vector<VertexId> natural, held_vertices;
  for (const VertexId v : component.vertices) {
    const bool is_free = !is_held_whole(input.state, v);
    (is_free ? natural : held_vertices).push_back(v);
    local_row[v.index()] = is_free ? static_cast<std::uint32_t>(natural.size() - 1) : held;
  }
  system.free_count = natural.size();
  system.analysis = analyse(free_graph(stars, local_row, input));
  system.order.clear();
  for (std::uint32_t i : system.analysis.order) system.order.push_back(natural[i]);
  system.order.insert(system.order.end(), held_vertices.begin(), held_vertices.end());
}

/// The rows of every column, its own first and then ascending.
void set_pattern(BlockMatrix& K, const VertexStars& stars, std::span<const std::uint32_t> local_row,
                 const SystemInput& input) {
  const std::size_t n = stars.start.size() - 1;
  std::vector<std::uint32_t> mark(n, held);
  K.start.assign(1, 0);
  K.row.clear();
  for (std::uint32_t j = 0; j < n; ++j) {
    const auto begin = static_cast<std::ptrdiff_t>(K.row.size());
    for (TetId t : stars.of(j)) {
      for (VertexId v : nodes_in(input, t)) {
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
                        std::span<const std::uint32_t> local_row, const SystemInput& input) {
  const ElementColumns& elements = input.state.elements;
  std::vector<Lame> constants;
  for (const Material& material : input.state.materials) constants.push_back(lame(material));
  std::vector<std::uint32_t> place(K.size());
  for (std::uint32_t j = 0; j < K.size(); ++j) {
    for (std::uint32_t e = K.start[j]; e < K.start[j + 1]; ++e) place[K.row[e]] = e;
    for (TetId t : stars.of(j)) {
      const ShapeGradient& G = elements.shape_gradient[t.index()];
      const double volume = elements.rest_volume[t.index()];
      const Lame& material = constants[elements.material[t.index()].index()];
      const Lame scaled{volume * material.lambda, volume * material.mu};
      const ElementNodes nodes = nodes_in(input, t);
      std::size_t own = 0;
      while (local_row[nodes.row[own].index()] != j) ++own;
      for (std::size_t a = 0; a < nodes.count; ++a) {
        const std::uint32_t row = local_row[nodes.row[a].index()];
        if (row < j) continue;
        double* const block = K.value.data() + 9 * std::size_t{place[row]};
        if (nodes.count == 4) {
          add_stiffness_block(block, G.col(static_cast<Eigen::Index>(a)),
                              G.col(static_cast<Eigen::Index>(own)), scaled);
        } else {
          add_second_order_block(block, G, a, own, scaled);
        }
      }
    }
  }
}

}  // namespace

ComponentSystems::ComponentSystems() = default;
ComponentSystems::ComponentSystems(ComponentSystems&&) noexcept = default;
ComponentSystems& ComponentSystems::operator=(ComponentSystems&&) noexcept = default;
ComponentSystems::~ComponentSystems() = default;

ComponentSystems::ComponentSystems(const ComponentSystems& other) : local_row(other.local_row) {
  const auto copy = [](const std::unique_ptr<ComponentSystem>& system) {
    return system ? std::make_unique<ComponentSystem>(*system) : nullptr;
  };
  std::ranges::transform(other.present, std::back_inserter(present), copy);
  std::ranges::transform(other.retired, std::back_inserter(retired), copy);
}

ComponentSystems& ComponentSystems::operator=(const ComponentSystems& other) {
  return *this = ComponentSystems(other);
}

void assemble_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                     const SystemInput& input) {
  for (std::size_t i = 0; i < system.order.size(); ++i) {
    local_row[system.order[i].index()] = static_cast<std::uint32_t>(i);
  }
  system.held_scalars.clear();
  for (std::uint32_t i = 0; i < system.free_count; ++i) {
    const AxisSet axes = held_axes(input.state, system.order[i]);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if (axes[axis]) system.held_scalars.push_back(3 * i + axis);
    }
  }
  const Component& component = input.component;
  const VertexStars stars = vertex_stars(local_row, input);
  system.shape = rest_shape(input.state.vertices, system.order, component.rest_centre);
  set_pattern(system.stiffness, stars, local_row, input);
  assemble_stiffness(system.stiffness, stars, local_row, input);
  system.tetrahedra = component.tetrahedra;
  system.corners.clear();
  system.edge_nodes.clear();
  for (TetId t : component.tetrahedra) system.corners.push_back(input.corners[t.index()]);
  const std::vector<EdgeNodes>& edges = input.state.elements.edge_nodes;
  if (edges.empty()) return;
  for (TetId t : component.tetrahedra) system.edge_nodes.push_back(edges[t.index()]);
}

void build_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                  const MechanicsState& state, std::span<const Corners> corners,
                  const Component& component) {
  system = ComponentSystem{};
  choose_order(system, local_row, {state, corners, component});
  assemble_system(system, local_row, {state, corners, component});
  const auto free_end = system.order.begin() + static_cast<std::ptrdiff_t>(system.free_count);
  system.row_vertex.assign(system.order.begin(), free_end);
}

}  // namespace sunder

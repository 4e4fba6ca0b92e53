// SPDX-License-Identifier: MIT
// A system after splits with the factor of the one before.
#include <algorithm>

#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/solver/assemble_system.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

constexpr std::uint32_t no_row = Supernode::none;

/// Row = VertexId: its extended row, or none.
using ExtendedRows = std::vector<std::uint32_t>;

/// Gives every vertex at the place of a vertex of the old system a row of its own, and notes the
/// original of each copy.
void find_copies(ComponentSystem& old, ExtendedRows& rows, const SystemInput& input) {
  for (std::size_t r = 0; r < old.row_vertex.size(); ++r) {
    rows[old.row_vertex[r].index()] = static_cast<std::uint32_t>(r);
  }
  const auto find_copy = [&](VertexId before, VertexId copy) {
    // Held vertices have no row, and copies of them neither.
    const std::uint32_t origin = rows[before.index()];
    if (copy == before || rows[copy.index()] != no_row || origin == no_row) return;
    rows[copy.index()] = static_cast<std::uint32_t>(old.row_vertex.size());
    old.row_vertex.push_back(copy);
    old.border.columns.push_back({.origin = origin,
                                  .vertex_mass = input.state.vertices.mass[copy.index()],
                                  .row = {},
                                  .stiffness = {}});
  };
  for (std::size_t i = 0; i < old.tetrahedra.size(); ++i) {
    const TetId t = old.tetrahedra[i];
    const ElementNodes now = nodes_of(input.state.elements, input.corners, t);
    for (std::size_t a = 0; a < now.count; ++a) {
      find_copy(a < 4 ? old.corners[i][a] : old.edge_nodes[i][a - 4], now.row[a]);
    }
  }
}

/// K in the columns of the copies from place `first` on.
void fill_columns(ComponentSystem& old, const ExtendedRows& rows, std::size_t first,
                  const SystemInput& input) {
  const ElementColumns& elements = input.state.elements;
  for (const TetId t : old.tetrahedra) {
    const ElementNodes nodes = nodes_of(elements, input.corners, t);
    for (std::size_t a = 0; a < nodes.count; ++a) {
      const std::uint32_t own = rows[nodes.row[a].index()];
      if (own == no_row || own < old.border.base + first) continue;
      const ShapeGradient& G = elements.shape_gradient[t.index()];
      const Lame constants = lame(material_of(input.state, t));
      for (std::size_t b = 0; b < nodes.count; ++b) {
        const std::uint32_t row = rows[nodes.row[b].index()];
        if (row == no_row) continue;
        Mat3 block = node_block(G, elements.rest_volume[t.index()], constants, nodes.count, b, a);
        leave_out(block, held_axes(input.state, nodes.row[b]), held_axes(input.state, nodes.row[a]),
                  a == b);
        add_block(old.border, old.border.columns[own - old.border.base], row, block);
      }
    }
  }
}

/// Free vertices by extended row, then the held ones; false where a vertex became free or held.
bool set_order(ComponentSystem& system, const ExtendedRows& rows, const SystemInput& input) {
  std::vector<VertexId> held_whole;
  for (VertexId v : input.component.vertices) {
    const bool is_free = !is_held_whole(input.state, v);
    if (is_free != (rows[v.index()] != no_row)) return false;
    (is_free ? system.order : held_whole).push_back(v);
  }
  std::sort(system.order.begin(), system.order.end(),
            [&](VertexId a, VertexId b) { return rows[a.index()] < rows[b.index()]; });
  system.free_count = system.order.size();
  for (VertexId v : system.order) system.factor_row.push_back(rows[v.index()]);
  system.order.insert(system.order.end(), held_whole.begin(), held_whole.end());
  return true;
}

}  // namespace

bool extend_system(ComponentSystem& system, ComponentSystem& old,
                   std::span<std::uint32_t> local_row, const SystemInput& input) {
  system = ComponentSystem{};
  if (!old.step.factored || !old.step.factor.positive_definite) return false;
  old.border.base = old.analysis.order.size();
  if (2 * input.component.vertices.size() < old.border.base) return false;
  ExtendedRows rows(input.state.vertices.size(), no_row);
  const std::size_t first = old.border.columns.size();
  find_copies(old, rows, input);
  const std::size_t copies = old.border.columns.size();
  if (copies > BorderLimits::copies) return false;
  if (copies * BorderLimits::vertices_to_copy > old.border.base) return false;
  fill_columns(old, rows, first, input);
  if (!set_order(system, rows, input)) return false;
  assemble_system(system, local_row, input);
  system.analysis = std::move(old.analysis);
  system.border = std::move(old.border);
  system.border_age = old.border_age;
  system.row_vertex = std::move(old.row_vertex);
  system.step = std::move(old.step);
  system.step.touched.clear();
  return true;
}

}  // namespace sunder

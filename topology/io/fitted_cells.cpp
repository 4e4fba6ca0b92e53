// SPDX-License-Identifier: MIT
// Which cells a format holds, and a mesh of those alone.
#include "topology/io/fitted_cells.hpp"

#include <algorithm>

#include "topology/io/tetgen/tetgen.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/take_rows.hpp"

namespace sunder::io {

namespace {

constexpr CellKind polyhedra[] = {CellKind::hexahedron8, CellKind::prism6, CellKind::pyramid5};

/// The rows of the cells of a kind that have all of its corners.
std::vector<std::uint32_t> whole_rows(const FileMesh& mesh, CellKind kind) {
  std::vector<std::uint32_t> whole;
  const CellRows rows = rows_of(mesh, kind);
  for (std::uint32_t i = 0; i < rows.count; ++i) {
    std::vector<std::uint32_t> nodes(rows[i].begin(), rows[i].end());
    std::ranges::sort(nodes);
    if (std::ranges::adjacent_find(nodes) == nodes.end()) whole.push_back(i);
  }
  return whole;
}

}  // namespace

std::size_t collapsed_cells(const FileMesh& mesh, const FormatTraits& t) {
  std::size_t collapsed = 0;
  for (const CellKind kind : polyhedra) {
    if (t.format != MeshFormat::ovm) continue;
    collapsed += rows_of(mesh, kind).count - whole_rows(mesh, kind).size();
  }
  return collapsed;
}

KindSet kinds_held(const FileMesh& mesh, const FormatTraits& t) {
  if (t.format != MeshFormat::tetgen) return t.cells;
  constexpr KindSet straight =
      kind_set({CellKind::edge, CellKind::triangle, CellKind::tetrahedron});
  return is_tetgen_curved(mesh) ? t.cells & ~straight : t.cells & straight;
}

std::optional<FileMesh> fitted_cells(const FileMesh& mesh, const FormatTraits& t) {
  const KindSet held = kinds_held(mesh, t);
  const bool all_held = std::ranges::all_of(all_cell_kinds, [&](CellKind kind) {
    return contains(held, kind) || rows_of(mesh, kind).count == 0;
  });
  const bool has_collapsed = collapsed_cells(mesh, t) > 0;
  if (all_held && !has_collapsed) return std::nullopt;
  FileMesh fitted = mesh;
  for (const CellKind kind : all_cell_kinds) {
    if (contains(held, kind)) continue;
    const CellKind lower = held_kind(held, kind);
    lower == kind ? drop_cells(fitted, kind) : move_cells(fitted, kind, lower);
  }
  for (const CellKind kind : polyhedra) {
    if (collapsed_cells(fitted, t) > 0) take_cells(fitted, kind, whole_rows(fitted, kind));
  }
  return fitted;
}

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// Which cells a format holds, and a mesh of those alone.
#include "topology/io/fitted_cells.hpp"

#include <algorithm>

#include "topology/io/tetgen/tetgen.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {

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
  if (all_held) return std::nullopt;
  FileMesh fitted = mesh;
  for (const CellKind kind : all_cell_kinds) {
    if (contains(held, kind)) continue;
    const CellKind lower = held_kind(held, kind);
    lower == kind ? drop_cells(fitted, kind) : move_cells(fitted, kind, lower);
  }
  return fitted;
}

}  // namespace sunder::io

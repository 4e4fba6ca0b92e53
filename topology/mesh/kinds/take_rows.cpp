// SPDX-License-Identifier: MIT
// Points and cells in a new order, with all that is said of them.
#include "topology/mesh/kinds/take_rows.hpp"

namespace sunder {

void take_points(FileMesh& mesh, const std::vector<std::uint32_t>& rows,
                 const std::vector<std::uint32_t>& new_row) {
  number_rows(mesh.source_point_id, mesh.points.size(), 1);
  take_rows(mesh.points, rows);
  take_rows(mesh.source_point_id, rows);
  take_rows(mesh.point_region, rows);
  take_rows(mesh.point_data, rows);
  for (const CellKind kind : all_cell_kinds) {
    for (std::uint32_t& node : nodes_of(mesh, kind)) node = new_row[node];
  }
}

void take_cells(FileMesh& mesh, CellKind kind, const std::vector<std::uint32_t>& rows) {
  take_rows(columns_of(mesh, kind), rows);
  if (kind == CellKind::vertex) return take_rows(mesh.vertices.corners, rows);
  if (kind == CellKind::edge) return take_rows(mesh.edges.corners, rows);
  if (kind == CellKind::triangle) return take_rows(mesh.triangles.corners, rows);
  if (kind == CellKind::tetrahedron) return take_rows(mesh.tetrahedra.corners, rows);
  OtherCells& cells = other_cells(mesh, kind);
  if (kind != CellKind::polygon) return take_rows(cells.points, rows, traits_of(kind).nodes);
  const OtherCells old{{}, cells.points, cells.ends};
  cells.points.clear();
  cells.ends.clear();
  for (const std::uint32_t row : rows) {
    const std::size_t begin = row == 0 ? 0 : old.ends[row - 1];
    cells.points.insert(cells.points.end(), old.points.begin() + static_cast<std::ptrdiff_t>(begin),
                        old.points.begin() + static_cast<std::ptrdiff_t>(old.ends[row]));
    cells.ends.push_back(cells.points.size());
  }
}

}  // namespace sunder

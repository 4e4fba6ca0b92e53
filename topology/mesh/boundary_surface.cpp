// SPDX-License-Identifier: MIT
// Faces of one tetrahedron, found by sorting, with what the mesh's own triangles say of them.
#include "topology/mesh/boundary_surface.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "topology/base/point_math.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/mesh/face_table.hpp"

namespace sunder {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Row = std::uint32_t;
constexpr Row no_row = std::numeric_limits<Row>::max();

struct Face {
  Corners sorted;
  /// 4 * tetrahedron + corner left out.
  std::uint32_t place;
};

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

bool is_inverted(const FileMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  const auto& x = mesh.points;
  return detail::six_volumes(x[t[0]], x[t[1]], x[t[2]], x[t[3]]) < 0;
}

/// Faces of exactly one tetrahedron, sorted by their points.
std::vector<Face> boundary_faces(const FileMesh& mesh) {
  std::vector<Face> faces;
  const FaceTable table = face_table(mesh.tetrahedra.corners, mesh.points.size());
  for_each_face(table, [&](const Corners& points, std::span<const TableFace> sides) {
    if (sides.size() == 1) faces.push_back({points, sides[0].half_face});
  });
  return faces;
}

/// The first triangle of the mesh on each face; no_row where there is none.
std::vector<Row> triangles_on(const std::vector<Face>& faces, const FileMesh& mesh) {
  std::vector<Row> rows(faces.size(), no_row);
  for (std::size_t i = 0; i < mesh.triangles.corners.size(); ++i) {
    const Corners key = sorted(mesh.triangles.corners[i]);
    const auto face = std::ranges::lower_bound(faces, key, {}, &Face::sorted);
    if (face == faces.end() || face->sorted != key) continue;
    Row& row = rows[static_cast<std::size_t>(face - faces.begin())];
    if (row == no_row) row = static_cast<Row>(i);
  }
  return rows;
}

/// `rows` of a column with `components` numbers each, `filling` where there is no row.
template <class Value>
std::vector<Value> taken(const std::vector<Value>& column, const std::vector<Row>& rows,
                         std::size_t components, Value filling) {
  std::vector<Value> out;
  if (column.empty()) return out;
  out.reserve(rows.size() * components);
  for (const Row row : rows) {
    for (std::size_t k = 0; k < components; ++k) {
      out.push_back(row == no_row ? filling : column[row * components + k]);
    }
  }
  return out;
}

std::vector<DataColumn> taken(const std::vector<DataColumn>& columns,
                              const std::vector<Row>& rows) {
  std::vector<DataColumn> out;
  for (const DataColumn& c : columns) {
    DataColumn& column = out.emplace_back(DataColumn{c.name, c.components, c.type, {}});
    if (const auto* const reals = std::get_if<std::vector<double>>(&c.values)) {
      column.values = taken(*reals, rows, c.components, std::numeric_limits<double>::quiet_NaN());
    } else {
      column.values =
          taken(std::get<std::vector<std::int64_t>>(c.values), rows, c.components, std::int64_t{0});
    }
  }
  return out;
}

/// Labels, numbers and data of `rows`; none at all where no row is there.
template <std::size_t N>
void take_columns(CellList<N>& to, const CellList<N>& from, const std::vector<Row>& rows) {
  if (std::ranges::all_of(rows, [](Row row) { return row == no_row; })) return;
  to.region = taken(from.region, rows, 1, 0);
  to.entity = taken(from.entity, rows, 1, 0);
  to.source_id = taken(from.source_id, rows, 1, std::int64_t{0});
  to.data = taken(from.data, rows);
}

/// Numbers, each once, for triangles that the mesh did not have: after all of its own.
void number_others(CellList<3>& triangles, const FileMesh& mesh, const std::vector<Row>& rows) {
  if (triangles.source_id.empty()) return;
  std::int64_t last = 0;
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    for (const std::int64_t id : cells.source_id) last = std::max(last, id);
  });
  const auto room = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() - last);
  if (room < rows.size()) return triangles.source_id.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] == no_row) triangles.source_id[i] = ++last;
  }
}

/// The points that the triangles of `surface` use, in the mesh's order; returns the new row of each
/// point of the mesh.
std::vector<Row> take_points(BoundarySurface& surface, const FileMesh& mesh) {
  std::vector<Row> new_row(mesh.points.size(), no_row), rows;
  for (const Corners& corners : surface.mesh.triangles.corners) {
    for (const Row corner : corners) new_row[corner] = 0;
  }
  for (Row p = 0; p < new_row.size(); ++p) {
    if (new_row[p] == no_row) continue;
    new_row[p] = static_cast<Row>(rows.size());
    rows.push_back(p);
  }
  surface.lost_points = mesh.points.size() - rows.size();
  surface.mesh.points = taken(mesh.points, rows, 1, Point{});
  surface.mesh.point_region = taken(mesh.point_region, rows, 1, 0);
  surface.mesh.point_data = taken(mesh.point_data, rows);
  surface.mesh.source_point_id = taken(mesh.source_point_id, rows, 1, std::int64_t{0});
  if (surface.lost_points > 0 && mesh.source_point_id.empty()) {
    for (const Row row : rows) surface.mesh.source_point_id.push_back(row + 1L);
  }
  return new_row;
}

/// Vertices or edges whose points are all there; returns how many are lost.
template <std::size_t N>
std::size_t take_cells(CellList<N>& to, const CellList<N>& from, const std::vector<Row>& new_row) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < from.corners.size(); ++i) {
    auto corners = from.corners[i];
    for (Row& corner : corners) corner = new_row[corner];
    if (std::ranges::find(corners, no_row) != corners.end()) continue;
    to.corners.push_back(corners);
    rows.push_back(static_cast<Row>(i));
  }
  take_columns(to, from, rows);
  return from.corners.size() - rows.size();
}

}  // namespace

BoundarySurface boundary_surface(const FileMesh& mesh) {
  std::vector<Face> faces = boundary_faces(mesh);
  const std::vector<Row> own = triangles_on(faces, mesh);
  std::vector<Row> order(faces.size()), rows;
  std::iota(order.begin(), order.end(), Row{0});
  std::ranges::sort(order, {}, [&](Row face) { return faces[face].place; });

  BoundarySurface surface;
  surface.mesh.region_name = mesh.region_name;
  surface.mesh.region_name[3].clear();
  CellList<3>& triangles = surface.mesh.triangles;
  for (const Row face : order) {
    const auto& t = mesh.tetrahedra.corners[faces[face].place / 4];
    triangles.corners.push_back(corners_of_face(t, HalfFaceId{faces[face].place}));
    if (is_inverted(mesh, t)) std::swap(triangles.corners.back()[1], triangles.corners.back()[2]);
    rows.push_back(own[face]);
  }
  take_columns(triangles, mesh.triangles, rows);
  number_others(triangles, mesh, rows);
  const auto matched =
      static_cast<std::size_t>(std::ranges::count_if(rows, [](Row row) { return row != no_row; }));
  surface.lost_cells[2] = mesh.triangles.corners.size() - matched;

  const std::vector<Row> new_row = take_points(surface, mesh);
  for (Corners& corners : triangles.corners) {
    for (Row& corner : corners) corner = new_row[corner];
  }
  surface.lost_cells[0] = take_cells(surface.mesh.vertices, mesh.vertices, new_row);
  surface.lost_cells[1] = take_cells(surface.mesh.edges, mesh.edges, new_row);
  return surface;
}

}  // namespace sunder

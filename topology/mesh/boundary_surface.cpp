// SPDX-License-Identifier: MIT
// Faces of one volume cell only, found by sorting, with the data of the mesh's own cells on them.
#include "topology/mesh/boundary_surface.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "topology/base/point_math.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/mesh/face_table.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Row = std::uint32_t;
constexpr Row no_row = std::numeric_limits<Row>::max();

constexpr Row no_corner = no_row;

/// A face by its points in ascending order; triangles end with no_corner.
using Key = std::array<std::uint32_t, 4>;

struct Face {
  Key sorted;
  /// The points in their order, outward; a triangle repeats the last.
  Key points;
  /// The place among the faces of all cells.
  std::uint64_t place;
};

bool is_triangle(const Face& face) { return face.sorted[3] == no_corner; }

Key key_of(std::span<const std::uint32_t> corners) {
  Key key{no_corner, no_corner, no_corner, no_corner};
  std::ranges::copy(corners, key.begin());
  std::ranges::sort(key);
  return key;
}

bool is_inverted(const FileMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  const auto& x = mesh.points;
  return detail::six_volumes(x[t[0]], x[t[1]], x[t[2]], x[t[3]]) < 0;
}

/// Faces of exactly one tetrahedron, sorted by their points.
std::vector<Face> faces_of_tetrahedra(const FileMesh& mesh) {
  std::vector<Face> faces;
  const FaceTable table = face_table(mesh.tetrahedra.corners, mesh.points.size());
  for_each_face(table, [&](const Corners& points, std::span<const TableFace> sides) {
    if (sides.size() != 1) return;
    const std::uint32_t place = sides[0].half_face;
    const auto& t = mesh.tetrahedra.corners[place / 4];
    auto [a, b, c] = corners_of_face(t, HalfFaceId{place});
    if (is_inverted(mesh, t)) std::swap(b, c);
    faces.push_back({{points[0], points[1], points[2], no_corner}, {a, b, c, c}, place});
  });
  return faces;
}

/// The same for volume cells of all kinds. A face with a repeated point has no other side to find.
std::vector<Face> faces_of_all(const FileMesh& mesh) {
  std::vector<Face> faces;
  std::uint64_t place = 0;
  for (const CellKind kind : all_cell_kinds) {
    const std::span<const FaceCorners> own = faces_of(kind);
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count && !own.empty(); ++i) {
      const auto corners = rows[i];
      const bool is_turned = six_volumes_of(mesh, kind, corners) < 0;
      for (const FaceCorners& f : own) {
        Face face{{}, {corners[f[0]], corners[f[1]], corners[f[2]], corners[f[3]]}, place++};
        const std::size_t n = f[2] == f[3] ? 3 : 4;
        face.sorted = key_of(std::span(face.points).first(n));
        if (is_turned) std::reverse(face.points.begin(), face.points.begin() + n);
        if (n == 3) face.points[3] = face.points[2];
        faces.push_back(face);
      }
    }
  }
  std::ranges::sort(faces, {}, [](const Face& f) { return std::pair(f.sorted, f.place); });
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    for (end = i; end < faces.size() && faces[end].sorted == faces[i].sorted;) ++end;
    if (end == i + 1) faces[kept++] = faces[i];
  }
  faces.resize(kept);
  return faces;
}

std::vector<Face> boundary_faces(const FileMesh& mesh) {
  for (const CellKind kind : {CellKind::hexahedron8, CellKind::prism6, CellKind::pyramid5}) {
    if (rows_of(mesh, kind).count > 0) return faces_of_all(mesh);
  }
  return faces_of_tetrahedra(mesh);
}

/// The first cell of a kind on each face; no_row where there is none.
std::vector<Row> cells_on(const std::vector<Face>& faces, const FileMesh& mesh, CellKind kind) {
  std::vector<Row> rows(faces.size(), no_row);
  const CellRows cells = rows_of(mesh, kind);
  for (std::size_t i = 0; i < cells.count; ++i) {
    const Key key = key_of(cells[i]);
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
void take_columns(CellColumns& to, const CellColumns& from, const std::vector<Row>& rows) {
  if (std::ranges::all_of(rows, [](Row row) { return row == no_row; })) return;
  to.region = taken(from.region, rows, 1, 0);
  to.entity = taken(from.entity, rows, 1, 0);
  to.source_id = taken(from.source_id, rows, 1, std::int64_t{0});
  to.data = taken(from.data, rows);
}

/// Numbers, each once, for faces that the mesh did not have: after all of its own.
void number_others(CellColumns& cells, std::int64_t& last, const std::vector<Row>& rows) {
  if (cells.source_id.empty()) return;
  const auto room = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() - last);
  if (room < rows.size()) return cells.source_id.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] == no_row) cells.source_id[i] = ++last;
  }
}

std::int64_t last_number(const FileMesh& mesh) {
  std::int64_t last = 0;
  for (const CellKind kind : all_cell_kinds) {
    for (const std::int64_t id : columns_of(mesh, kind).source_id) last = std::max(last, id);
  }
  return last;
}

constexpr CellKind face_kinds[] = {CellKind::triangle, CellKind::quad4};

/// The points that the faces of `surface` use, in the mesh's order; returns the new row of each
/// point of the mesh.
std::vector<Row> take_points(BoundarySurface& surface, const FileMesh& mesh) {
  std::vector<Row> new_row(mesh.points.size(), no_row), rows;
  for (const CellKind kind : face_kinds) {
    for (const Row corner : nodes_of(surface.mesh, kind)) new_row[corner] = 0;
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

/// Keeps vertices or edges with all points present; returns how many are lost.
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

/// The faces of one kind, in the order of their places; returns how many cells of the mesh are on
/// none of them.
std::size_t take_faces(FileMesh& surface, const FileMesh& mesh, const std::vector<Face>& faces,
                       CellKind kind, std::int64_t& last) {
  const std::vector<Row> own = cells_on(faces, mesh, kind);
  std::vector<Row> order, rows;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (is_triangle(faces[i]) == (kind == CellKind::triangle)) order.push_back(static_cast<Row>(i));
  }
  std::ranges::sort(order, {}, [&](Row face) { return faces[face].place; });
  for (const Row face : order) {
    append_cell(surface, kind, std::span(faces[face].points).first(traits_of(kind).nodes));
    rows.push_back(own[face]);
  }
  take_columns(columns_of(surface, kind), columns_of(mesh, kind), rows);
  number_others(columns_of(surface, kind), last, rows);
  const auto matched = rows.size() - static_cast<std::size_t>(std::ranges::count(rows, no_row));
  return rows_of(mesh, kind).count - matched;
}

BoundarySurface surface_of_linear(const FileMesh& mesh) {
  const std::vector<Face> faces = boundary_faces(mesh);
  BoundarySurface surface;
  surface.mesh.region_name = mesh.region_name;
  surface.mesh.region_name[3].clear();
  std::int64_t last = last_number(mesh);
  for (const CellKind kind : face_kinds) {
    surface.lost_cells[index_of(kind)] = take_faces(surface.mesh, mesh, faces, kind, last);
  }
  surface.lost_cells[index_of(CellKind::polygon)] = rows_of(mesh, CellKind::polygon).count;
  const std::vector<Row> new_row = take_points(surface, mesh);
  for (const CellKind kind : face_kinds) {
    for (Row& corner : nodes_of(surface.mesh, kind)) corner = new_row[corner];
  }
  surface.lost_cells[index_of(CellKind::vertex)] =
      take_cells(surface.mesh.vertices, mesh.vertices, new_row);
  surface.lost_cells[index_of(CellKind::edge)] =
      take_cells(surface.mesh.edges, mesh.edges, new_row);
  return surface;
}

}  // namespace

bool has_volume_cells(const FileMesh& mesh) {
  return std::ranges::any_of(all_cell_kinds, [&](CellKind kind) {
    return traits_of(kind).dimension == 3 && rows_of(mesh, kind).count > 0;
  });
}

double six_volumes_of(const FileMesh& mesh, CellKind linear,
                      std::span<const std::uint32_t> corners) {
  const auto& x = mesh.points;
  double sum = 0;
  for (const FaceCorners& f : faces_of(linear)) {
    for (std::size_t k = 1; k + 1 < (f[2] == f[3] ? 3u : 4u); ++k) {
      sum += detail::six_volumes(x[corners[0]], x[corners[f[0]]], x[corners[f[k]]],
                                 x[corners[f[k + 1]]]);
    }
  }
  return sum;
}

BoundarySurface boundary_surface(const FileMesh& mesh) {
  const bool is_linear = std::ranges::all_of(all_cell_kinds, [&](CellKind kind) {
    return linear_kind(kind) == kind || rows_of(mesh, kind).count == 0;
  });
  if (is_linear) return surface_of_linear(mesh);
  FileMesh linear = mesh;
  make_linear(linear);
  return surface_of_linear(linear);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// OpenVolumeMesh's text written.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "topology/io/ovm/ovm.hpp"
#include "topology/io/ovm/ovm_reader.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/text/number_sink.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {
namespace {

/// Rows by their points in ascending order. Of rows on the same points the first is found.
template <std::size_t Points>
struct RowTable {
  using Key = std::array<std::uint32_t, Points>;
  static constexpr std::uint32_t none = 0xffffffffU;

  std::vector<Key> keys;
  /// Rows, each at the place that its key's hash says or behind it; a power of two, half empty.
  std::vector<std::uint32_t> slots = std::vector<std::uint32_t>(16, none);
};

template <std::size_t Points>
std::uint32_t& slot_of(RowTable<Points>& table, const std::array<std::uint32_t, Points>& key) {
  std::uint64_t hash = 0;
  for (const std::uint32_t point : key) hash = (hash ^ point) * 0x9e3779b97f4a7c15u;
  // First near the other rows of the lowest point, which are asked for at about the same time;
  // where that is taken, anywhere.
  const std::size_t near = std::size_t{key[0]} * 16 + (hash >> 60);
  std::size_t at = hash >> 32;
  for (bool is_first = true;; is_first = false) {
    std::uint32_t& row = table.slots[(is_first ? near : at++) & (table.slots.size() - 1)];
    if (row == table.none || table.keys[row] == key) return row;
  }
}

/// The row on these points, in any order; a new one behind all others if there is none yet.
template <std::size_t Points>
std::uint32_t row_of(RowTable<Points>& table, std::array<std::uint32_t, Points> points) {
  std::ranges::sort(points);
  if (2 * table.keys.size() >= table.slots.size()) {
    table.slots.assign(4 * table.slots.size(), table.none);
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      std::uint32_t& row = slot_of(table, table.keys[i]);
      row = std::min(row, static_cast<std::uint32_t>(i));
    }
  }
  std::uint32_t& row = slot_of(table, points);
  if (row == table.none) {
    row = static_cast<std::uint32_t>(table.keys.size());
    table.keys.push_back(points);
  }
  return row;
}

/// A row of its own, even where there is one on these points.
template <std::size_t Points>
void add_row(RowTable<Points>& table, const std::array<std::uint32_t, Points>& points) {
  const std::size_t rows = table.keys.size();
  if (row_of(table, points) == rows) return;
  table.keys.push_back(points);
  std::ranges::sort(table.keys.back());
}

/// Up to four corners, or the row of a polygon, which nothing else shares.
struct Face {
  std::array<std::uint32_t, 4> points;
  /// 0 for a polygon: its row stands in `points`.
  std::size_t corners = 0;
};

/// Triangles end with a number that no point has, polygons have but one that is less.
std::array<std::uint32_t, 4> key_of(const Face& face) {
  std::array<std::uint32_t, 4> key{no_corner, no_corner, no_corner, no_corner};
  std::copy_n(face.points.begin(), std::max<std::size_t>(face.corners, 1), key.begin());
  std::ranges::sort(key);
  return key;
}

constexpr CellKind face_kinds[] = {CellKind::triangle, CellKind::quad4, CellKind::polygon};
constexpr CellKind volume_kinds[] = {CellKind::tetrahedron, CellKind::hexahedron8, CellKind::prism6,
                                     CellKind::pyramid5};

/// Edges and faces of the file: the mesh's own first.
struct Skeleton {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<Face> faces;
  RowTable<2> edge_rows;
  RowTable<4> face_rows;
  /// Of the polyhedra, one after the other, and where those of each end.
  std::vector<std::uint32_t> half_faces;
  std::vector<std::size_t> ends;
  /// By how many places the corners of each polyhedron's base are turned.
  std::vector<std::int32_t> turn;
};

std::uint32_t half_edge(Skeleton& s, std::uint32_t from, std::uint32_t to) {
  const std::uint32_t row = row_of(s.edge_rows, {from, to});
  if (row == s.edges.size()) s.edges.push_back({from, to});
  return 2 * row + (s.edges[row][0] == from ? 0 : 1);
}

/// How far the corners are turned against a face, and whether they run the other way; none where
/// they are in another order.
struct Turn {
  std::size_t places;
  bool is_other_way;
};
std::optional<Turn> turn_of(const Face& face, const Face& corners) {
  const std::size_t n = face.corners;
  for (const bool other : {false, true}) {
    for (std::size_t places = 0; places < n; ++places) {
      bool same = true;
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t at = other ? (2 * n - places - k) % n : (places + k) % n;
        same = same && face.points[at] == corners.points[k];
      }
      if (same) return Turn{places, other};
    }
  }
  return std::nullopt;
}

/// The half-face with these corners in this cyclic order.
std::uint32_t half_face(Skeleton& s, const Face& corners, std::size_t* turned = nullptr) {
  std::uint32_t row = row_of(s.face_rows, key_of(corners));
  if (row == s.faces.size()) s.faces.push_back(corners);
  std::optional<Turn> turn = turn_of(s.faces[row], corners);
  if (!turn) {  // other sides between the same points
    row = static_cast<std::uint32_t>(s.faces.size());
    add_row(s.face_rows, key_of(corners));
    s.faces.push_back(corners);
    turn = Turn{0, false};
  }
  if (turned != nullptr) *turned = turn->places;
  return 2 * row + (turn->is_other_way ? 1 : 0);
}

/// The faces of a polyhedron, looking inward where its volume is positive, its base first.
std::vector<Face> faces_inward(CellKind kind, std::span<const std::uint32_t> c) {
  if (kind == CellKind::tetrahedron) {
    return {{{c[0], c[1], c[2], c[2]}, 3},
            {{c[0], c[2], c[3], c[3]}, 3},
            {{c[0], c[3], c[1], c[1]}, 3},
            {{c[1], c[3], c[2], c[2]}, 3}};
  }
  std::vector<Face> faces;
  for (const FaceCorners& f : faces_of(kind)) {
    const std::size_t n = f[2] == f[3] ? 3 : 4;
    Face face{{c[f[0]], c[f[1]], c[f[2]], c[f[3]]}, n};
    std::reverse(face.points.begin() + 1, face.points.begin() + static_cast<std::ptrdiff_t>(n));
    faces.push_back(face);
  }
  // The base is the face on the first corners, in their order.
  const auto is_base = [&](const Face& face) {
    return face.points[0] == c[0] && face.points[1] == c[1] && face.points[2] == c[2] &&
           face.corners == corners_of_base(kind);
  };
  std::iter_swap(faces.begin(), std::ranges::find_if(faces, is_base));
  return faces;
}

Skeleton skeleton_of(const FileMesh& mesh) {
  Skeleton s;
  s.edges = mesh.edges.corners;
  for (const auto& edge : s.edges) add_row(s.edge_rows, edge);
  for (const CellKind kind : face_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    for (std::uint32_t i = 0; i < rows.count; ++i) {
      Face face{{i, i, i, i}, 0};
      if (kind != CellKind::polygon) {
        face.corners = rows.nodes;
        std::ranges::copy(rows[i], face.points.begin());
      }
      s.faces.push_back(face);
      // A polygon's key is no row of points: it is never asked for.
      add_row(s.face_rows, key_of(face));
    }
  }
  for (const CellKind kind : volume_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (const Face& face : faces_inward(kind, rows[i])) {
        const bool is_base = s.half_faces.size() == (s.ends.empty() ? 0 : s.ends.back());
        std::size_t places = 0;
        s.half_faces.push_back(half_face(s, face, &places));
        if (is_base) s.turn.push_back(static_cast<std::int32_t>(places));
      }
      s.ends.push_back(s.half_faces.size());
    }
  }
  return s;
}

void put_head(NumberSink& out, std::string_view name, std::size_t rows) {
  put_text(out, name);
  out.bytes += '\n';
  put_text(out, rows);
  out.bytes += '\n';
}

template <class Row>
void put_row(NumberSink& out, const Row& row) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (k > 0) out.bytes += ' ';
    put_text(out, row[k]);
  }
  out.bytes += '\n';
}

void put_skeleton(NumberSink& out, const FileMesh& mesh, Skeleton& s) {
  put_text(out, "OVM ASCII\n");
  put_head(out, "Vertices", mesh.points.size());
  for (const Point& p : mesh.points) put_row(out, p);
  const CellRows polygons = rows_of(mesh, CellKind::polygon);
  std::vector<std::uint32_t> half_edges;
  std::vector<std::size_t> ends;
  for (const Face& f : s.faces) {
    const auto corners =
        f.corners == 0 ? polygons[f.points[0]] : std::span(f.points).first(f.corners);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      half_edges.push_back(half_edge(s, corners[k], corners[(k + 1) % corners.size()]));
    }
    ends.push_back(half_edges.size());
  }
  put_head(out, "Edges", s.edges.size());
  for (const auto& edge : s.edges) put_row(out, edge);
  const auto put_lists = [&](const std::vector<std::uint32_t>& numbers,
                             const std::vector<std::size_t>& list_ends) {
    std::size_t begin = 0;
    for (const std::size_t end : list_ends) {
      put_text(out, end - begin);
      out.bytes += ' ';
      put_row(out, std::span(numbers).subspan(begin, end - begin));
      begin = end;
    }
  };
  put_head(out, "Faces", s.faces.size());
  put_lists(half_edges, ends);
  put_head(out, "Polyhedra", s.ends.size());
  put_lists(s.half_faces, s.ends);
}

constexpr std::string_view entities[] = {"VProp", "EProp", "FProp", "CProp"};

/// Values of a property for `rows` rows; those that are not there are `usual`.
template <class Value>
void put_property(NumberSink& out, int dimension, std::string_view type, OvmOwn own,
                  const std::vector<Value>& values, std::size_t rows) {
  if (values.empty()) return;
  put_text(out, fmt::format("{} {} \"{}\"\n", entities[dimension], type,
                            ovm_own[static_cast<std::size_t>(own)]));
  for (std::size_t i = 0; i < rows; ++i) {
    put_text(out, i < values.size() ? values[i] : Value{0});
    out.bytes += '\n';
  }
}

/// A column as one property, or, where no type has so many components, as one each.
void put_data(NumberSink& out, int dimension, const DataColumn& column, std::size_t rows) {
  constexpr std::string_view type_words[] = {"", "double", "vec2d", "vec3d", "vec4d"};
  const bool is_own = std::ranges::find(ovm_own, column.name) != std::end(ovm_own);
  const std::string name = escaped_name(column.name, is_own);
  const std::size_t n = column.components;
  const std::size_t parts = n <= 4 ? 1 : n, in_part = n / parts;
  const auto put_values = [&](const auto& values, std::size_t row, std::size_t first) {
    for (std::size_t k = first; k < first + in_part; ++k) {
      if (k > first) out.bytes += ' ';
      if (row * n + k < values.size()) {
        put_text(out, static_cast<double>(values[row * n + k]));
      } else {
        put_text(out, "nan");
      }
    }
    out.bytes += '\n';
  };
  for (std::size_t part = 0; part < parts; ++part) {
    put_text(out, fmt::format("{} {} \"{}{}\"\n", entities[dimension], type_words[in_part], name,
                              parts == 1 ? std::string() : fmt::format("[{}/{}]", part, n)));
    std::visit(
        [&](const auto& values) {
          for (std::size_t row = 0; row < rows; ++row) put_values(values, row, part);
        },
        column.values);
  }
}

/// The columns of the cells of one dimension, which are the first of `rows` edges, faces or
/// polyhedra.
void put_cells(NumberSink& out, const FileMesh& mesh, int d, std::span<const CellKind> kinds,
               std::size_t rows) {
  CellColumns cells;
  std::size_t count = 0;
  for (const CellKind kind : kinds) {
    const std::size_t more = rows_of(mesh, kind).count;
    append_columns(cells, count, CellColumns(columns_of(mesh, kind)), more);
    count += more;
  }
  if (d < 3) {
    put_property(out, d, "int", OvmOwn::cell, std::vector<std::int32_t>(count, 1), rows);
  }
  put_property(out, d, "int", OvmOwn::region, cells.region, rows);
  put_property(out, d, "int", OvmOwn::entity, cells.entity, rows);
  put_property(out, d, "long", OvmOwn::cell_id, cells.source_id, rows);
  for (const DataColumn& column : cells.data) put_data(out, d, column, rows);
}

}  // namespace

std::string write_ovm(const FileMesh& mesh) {
  Skeleton s = skeleton_of(mesh);
  NumberSink out;
  out.bytes.reserve(64 * mesh.points.size() + 128 * mesh.tetrahedra.corners.size());
  put_skeleton(out, mesh, s);
  const std::size_t points = mesh.points.size();
  put_property(out, 0, "int", OvmOwn::region, mesh.point_region, points);
  put_property(out, 0, "long", OvmOwn::point_id, mesh.source_point_id, points);
  for (const DataColumn& column : mesh.point_data) put_data(out, 0, column, points);
  put_cells(out, mesh, 1, {{CellKind::edge}}, s.edges.size());
  put_cells(out, mesh, 2, face_kinds, s.faces.size());
  if (std::ranges::any_of(s.turn, [](std::int32_t x) { return x != 0; })) {
    put_property(out, 3, "int", OvmOwn::turn, s.turn, s.ends.size());
  }
  put_cells(out, mesh, 3, volume_kinds, s.ends.size());
  return std::move(out.bytes);
}

}  // namespace sunder::io

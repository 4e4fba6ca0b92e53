// SPDX-License-Identifier: MIT
// OpenVolumeMesh's text written.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <variant>

#include "topology/io/number_sink.hpp"
#include "topology/io/ovm/ovm.hpp"
#include "topology/io/tetgen/tetgen.hpp"

namespace sunder::io {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

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

/// Edges and faces of the file: the mesh's own first.
struct Skeleton {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<Triangle> faces;
  RowTable<2> edge_rows;
  RowTable<3> face_rows;
  std::vector<std::array<std::uint32_t, 4>> half_faces;
  /// By how many places the first three corners of each tetrahedron are turned.
  std::vector<std::int32_t> turn;
};

std::uint32_t half_edge(Skeleton& s, std::uint32_t from, std::uint32_t to) {
  const std::uint32_t row = row_of(s.edge_rows, {from, to});
  if (row == s.edges.size()) s.edges.push_back({from, to});
  return 2 * row + (s.edges[row][0] == from ? 0 : 1);
}

/// The half-face with these corners in this cyclic order.
std::uint32_t half_face(Skeleton& s, const Triangle& corners) {
  const std::uint32_t row = row_of(s.face_rows, corners);
  if (row == s.faces.size()) s.faces.push_back(corners);
  const Triangle& face = s.faces[row];
  const auto at = std::ranges::find(face, corners[0]) - face.begin();
  return 2 * row + (face[static_cast<std::size_t>(at + 1) % 3] == corners[1] ? 0 : 1);
}

/// How far the corners are turned against those that a reader finds for the half-face.
std::int32_t turn_of(const Skeleton& s, std::uint32_t half_face, const Triangle& corners) {
  Triangle read = s.faces[half_face / 2];
  if (half_face % 2 == 1) std::swap(read[1], read[2]);
  return static_cast<std::int32_t>(std::ranges::find(read, corners[0]) - read.begin());
}

Skeleton skeleton_of(const FileMesh& mesh) {
  Skeleton s;
  s.edges = mesh.edges.corners;
  for (const auto& edge : s.edges) add_row(s.edge_rows, edge);
  s.faces = mesh.triangles.corners;
  for (const Triangle& face : s.faces) add_row(s.face_rows, face);
  s.half_faces.reserve(mesh.tetrahedra.corners.size());
  for (const auto& [a, b, c, d] : mesh.tetrahedra.corners) {
    s.half_faces.push_back({half_face(s, {a, b, c}), half_face(s, {a, c, d}),
                            half_face(s, {a, d, b}), half_face(s, {b, d, c})});
    s.turn.push_back(turn_of(s, s.half_faces.back()[0], {a, b, c}));
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
  std::vector<Triangle> half_edges;
  half_edges.reserve(s.faces.size());
  for (const auto& [a, b, c] : s.faces) {
    half_edges.push_back({half_edge(s, a, b), half_edge(s, b, c), half_edge(s, c, a)});
  }
  put_head(out, "Edges", s.edges.size());
  for (const auto& edge : s.edges) put_row(out, edge);
  put_head(out, "Faces", s.faces.size());
  for (const Triangle& face : half_edges) {
    put_text(out, "3 ");
    put_row(out, face);
  }
  put_head(out, "Polyhedra", s.half_faces.size());
  for (const auto& cell : s.half_faces) {
    put_text(out, "4 ");
    put_row(out, cell);
  }
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
  constexpr std::string_view types[] = {"", "double", "vec2d", "vec3d", "vec4d"};
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
    put_text(out, fmt::format("{} {} \"{}{}\"\n", entities[dimension], types[in_part], name,
                              parts == 1 ? std::string() : fmt::format("[{}/{}]", part, n)));
    std::visit(
        [&](const auto& values) {
          for (std::size_t row = 0; row < rows; ++row) put_values(values, row, part);
        },
        column.values);
  }
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
  for_each_cell_list(mesh, [&](const auto& cells, int d) {
    if (d == 0) return;
    const std::size_t rows = d == 1   ? s.edges.size()
                             : d == 2 ? s.faces.size()
                                      : s.half_faces.size();
    if (d < 3) {
      put_property(out, d, "int", OvmOwn::cell, std::vector<std::int32_t>(cells.corners.size(), 1),
                   rows);
    } else if (std::ranges::any_of(s.turn, [](std::int32_t x) { return x != 0; })) {
      put_property(out, d, "int", OvmOwn::turn, s.turn, rows);
    }
    put_property(out, d, "int", OvmOwn::region, cells.region, rows);
    put_property(out, d, "int", OvmOwn::entity, cells.entity, rows);
    put_property(out, d, "long", OvmOwn::cell_id, cells.source_id, rows);
    for (const DataColumn& column : cells.data) put_data(out, d, column, rows);
  });
  return std::move(out.bytes);
}

}  // namespace sunder::io

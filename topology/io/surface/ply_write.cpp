// SPDX-License-Identifier: MIT
// PLY written: points, edges and triangles with a property for every number of theirs.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "topology/io/surface/ply.hpp"
#include "topology/io/text/number_sink.hpp"
#include "topology/io/vtk/vtk_columns.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {
namespace {

/// Names that mean something to readers, and are not for data.
constexpr std::string_view own_names[] = {"x",
                                          "y",
                                          "z",
                                          "vertex_indices",
                                          "vertex_index",
                                          "vertex1",
                                          "vertex2",
                                          "point_region",
                                          "source_point_id"};

/// A column with the words for its components.
struct Written {
  DataColumn data;
  std::vector<std::string> words;
};

/// An element's columns.
struct Columns {
  std::vector<Written> list;
  std::set<std::string> taken;
  /// Lines with details that the words do not hold.
  std::string comments;
};

void add_own(Columns& columns, std::string name, const std::vector<std::int64_t>& values) {
  const auto type = ply_type(values);
  if (values.empty() || !type) return;
  columns.list.push_back({{name, 1, *type, values}, {name}});
}

std::vector<std::int64_t> wide(const std::vector<std::int32_t>& labels) {
  return {labels.begin(), labels.end()};
}

/// Letters, digits and a few signs; other characters become _.
std::string word_of(std::string_view name) {
  std::string word(name);
  for (char& c : word) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '_' || c == ':' || c == '.' || c == '-';
    if (!is_plain) c = '_';
  }
  return word.empty() ? "data" : word;
}

/// Whether a word is taken, or would be read as something else.
bool is_taken(const Columns& columns, const std::string& word) {
  return columns.taken.contains(word) || is_region_name(word) || is_entity_name(word) ||
         is_cell_id_name(word) || std::ranges::find(own_names, word) != std::end(own_names);
}

void add_data(Columns& columns, std::string_view element, const std::vector<DataColumn>& data) {
  for (const DataColumn& column : data) {
    const auto type = ply_type(column);
    if (!type) continue;
    Written& written = columns.list.emplace_back(Written{column, {}});
    written.data.type = *type;
    for (std::size_t k = 0; k < column.components; ++k) {
      std::string word = word_of(column.name);
      if (column.components > 1) word += fmt::format("_{}", k);
      while (is_taken(columns, word)) word += '_';
      columns.taken.insert(word);
      written.words.push_back(std::move(word));
    }
    if (column.components == 1 && written.words[0] == column.name) continue;
    columns.comments += fmt::format("comment column {} {} {} \"{}\"\n", element, written.words[0],
                                    column.components, column.name);
  }
}

Columns columns_of(const CellColumns& cells, std::string_view element) {
  Columns columns;
  add_own(columns, "region", wide(cells.region));
  add_own(columns, "entity", wide(cells.entity));
  add_own(columns, "source_cell_id", cells.source_id);
  add_data(columns, element, cells.data);
  return columns;
}

Columns columns_of_points(const FileMesh& mesh) {
  Columns columns;
  add_own(columns, "source_point_id", mesh.source_point_id);
  add_own(columns, "point_region", wide(mesh.point_region));
  add_data(columns, "vertex", mesh.point_data);
  return columns;
}

void put_properties(NumberSink& out, const Columns& columns) {
  for (const Written& w : columns.list) {
    for (const std::string& word : w.words) {
      put_text(out, fmt::format("property {} {}\n",
                                ply_types[static_cast<std::size_t>(w.data.type)], word));
    }
  }
}

template <class Stored>
void put_number(NumberSink& out, Stored number) {
  if (out.is_binary) return put_little(out, number);
  // Small integers are characters to no reader.
  if constexpr (sizeof(Stored) == 1) {
    put_text(out, static_cast<int>(number));
  } else {
    put_text(out, number);
  }
  out.bytes += ' ';
}

void put_columns(NumberSink& out, const Columns& columns, std::size_t row) {
  for (const Written& w : columns.list) {
    for (std::size_t k = 0; k < w.data.components; ++k) {
      const std::size_t place = row * w.data.components + k;
      with_stored(w.data.type, [&](auto zero) {
        std::visit(
            [&](const auto& values) {
              put_number(out, static_cast<decltype(zero)>(values[place]));
            },
            w.data.values);
      });
    }
  }
}

void end_row(NumberSink& out) {
  if (!out.is_binary) out.bytes.back() = '\n';
}

/// How the length of a list is written before it.
enum class ListLength { none, narrow, wide };

/// Cells with the rows from `first` on of the columns.
void put_cells(NumberSink& out, const CellRows& rows, ListLength length, const Columns& columns,
               std::size_t first) {
  for (std::size_t i = 0; i < rows.count; ++i) {
    const auto nodes = rows[i];
    if (length == ListLength::narrow) put_number(out, static_cast<std::uint8_t>(nodes.size()));
    if (length == ListLength::wide) put_number(out, static_cast<std::int32_t>(nodes.size()));
    for (const std::uint32_t node : nodes) put_number(out, static_cast<std::int32_t>(node));
    put_columns(out, columns, first + i);
    end_row(out);
  }
}

constexpr CellKind face_kinds[] = {CellKind::triangle, CellKind::quad4, CellKind::polygon};

std::size_t corners_of_largest(const FileMesh& mesh) {
  const CellRows rows = rows_of(mesh, CellKind::polygon);
  std::size_t most = 4;
  for (std::size_t i = 0; i < rows.count; ++i) most = std::max(most, rows[i].size());
  return most;
}

/// The columns of faces of all kinds, one after the other.
CellColumns columns_of_faces(const FileMesh& mesh) {
  CellColumns all;
  std::size_t rows = 0;
  for (const CellKind kind : face_kinds) {
    const std::size_t more = rows_of(mesh, kind).count;
    append_columns(all, rows, CellColumns(columns_of(mesh, kind)), more);
    rows += more;
  }
  return all;
}

}  // namespace

std::optional<NumberType> ply_type(const std::vector<std::int64_t>& numbers) {
  const auto fits = [&numbers](auto zero) {
    return std::ranges::all_of(numbers, [](std::int64_t x) {
      return x == static_cast<std::int64_t>(static_cast<decltype(zero)>(x));
    });
  };
  if (fits(std::int32_t{})) return NumberType::int32;
  if (fits(std::uint32_t{})) return NumberType::uint32;
  return std::nullopt;
}

std::optional<NumberType> ply_type(const DataColumn& column) {
  if (column.name.find('\n') != std::string::npos) return std::nullopt;
  const bool is_wide = column.type == NumberType::int64 || column.type == NumberType::uint64;
  return is_wide ? ply_type(std::get<std::vector<std::int64_t>>(column.values)) : column.type;
}

std::string write_ply(const FileMesh& mesh, bool is_binary) {
  const Columns vertex = columns_of_points(mesh), face = columns_of(columns_of_faces(mesh), "face"),
                edge = columns_of(mesh.edges, "edge");
  std::size_t faces = 0;
  for (const CellKind kind : face_kinds) faces += rows_of(mesh, kind).count;
  NumberSink out{.is_binary = is_binary};
  out.bytes.reserve(1024 + 64 * mesh.points.size() + 40 * cell_count(mesh));
  put_text(out, fmt::format("ply\nformat {} 1.0\n", is_binary ? "binary_little_endian" : "ascii"));
  for (const Columns* columns : {&vertex, &face, &edge}) put_text(out, columns->comments);
  put_text(out, fmt::format("element vertex {}\nproperty double x\nproperty double y\n"
                            "property double z\n",
                            mesh.points.size()));
  put_properties(out, vertex);
  const bool is_wide = corners_of_largest(mesh) > 255;
  put_text(out, fmt::format("element face {}\nproperty list {} int vertex_indices\n", faces,
                            is_wide ? "int" : "uchar"));
  put_properties(out, face);
  if (!mesh.edges.corners.empty()) {
    put_text(out, fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\n",
                              mesh.edges.corners.size()));
    put_properties(out, edge);
  }
  put_text(out, "end_header\n");
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double x : mesh.points[i]) put_number(out, x);
    put_columns(out, vertex, i);
    end_row(out);
  }
  std::size_t first = 0;
  for (const CellKind kind : face_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    put_cells(out, rows, is_wide ? ListLength::wide : ListLength::narrow, face, first);
    first += rows.count;
  }
  put_cells(out, rows_of(mesh, CellKind::edge), ListLength::none, edge, 0);
  return std::move(out.bytes);
}

}  // namespace sunder::io

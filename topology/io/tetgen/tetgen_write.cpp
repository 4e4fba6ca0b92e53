// SPDX-License-Identifier: MIT
// TetGen's files written, one after the other.
#include <fmt/format.h>

#include <cstdint>
#include <system_error>
#include <variant>

#include "topology/io/files/output_file.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/text/number_sink.hpp"

namespace sunder::io {
namespace {

std::size_t numbers_in(const std::vector<DataColumn>& columns) {
  std::size_t sum = 0;
  for (const DataColumn& column : columns) sum += column.components;
  return sum;
}

/// A comment with the names of the numbers behind each row, if there are any.
void put_names(NumberSink& out, std::string_view beginning, std::string_view before,
               const std::vector<DataColumn>& columns, std::string_view after) {
  if (columns.empty()) return;
  std::string_view comma = " ";
  put_text(out, beginning);
  const auto add = [&](std::string_view name, std::size_t components) {
    put_text(out, comma);
    put_text(out, name);
    if (components != 1) put_text(out, fmt::format("*{}", components));
    comma = ", ";
  };
  if (!before.empty()) add(before, 1);
  for (const DataColumn& column : columns) {
    const bool is_first = before.empty() && &column == &columns.front();
    add(escaped_name(column.name, is_first && is_tetgen_region(column.name)), column.components);
  }
  if (!after.empty()) add(after, 1);
  out.bytes += '\n';
}

/// The numbers of one row, a blank before each.
void put_columns(NumberSink& out, const std::vector<DataColumn>& columns, std::size_t row) {
  for (const DataColumn& column : columns) {
    std::visit(
        [&](const auto& values) {
          for (std::size_t k = 0; k < column.components; ++k) {
            out.bytes += ' ';
            put_text(out, values[row * column.components + k]);
          }
        },
        column.values);
  }
}

std::string points_text(const FileMesh& mesh) {
  NumberSink out;
  const bool marked = !mesh.point_region.empty();
  out.bytes.reserve(64 * mesh.points.size());
  put_names(out, "# attribute and marker names:", "", mesh.point_data, marked ? "marker" : "");
  put_text(out, fmt::format("{} 3 {} {}\n", mesh.points.size(), numbers_in(mesh.point_data),
                            marked ? 1 : 0));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    put_text(out, i + 1);
    for (const double x : mesh.points[i]) {
      out.bytes += ' ';
      put_text(out, x);
    }
    put_columns(out, mesh.point_data, i);
    if (marked) {
      out.bytes += ' ';
      put_text(out, mesh.point_region[i]);
    }
    out.bytes += '\n';
  }
  return std::move(out.bytes);
}

/// A row of cells: its number, its nodes, its label.
void put_cell(NumberSink& out, CellKind kind, std::span<const std::uint32_t> nodes,
              const std::vector<std::int32_t>& label, std::size_t row) {
  const std::span<const std::uint8_t> order = tetgen_order(kind);
  put_text(out, row + 1);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    out.bytes += ' ';
    put_text(out, nodes[order.empty() ? k : order[k]] + std::int64_t{1});
  }
  if (label.empty()) return;
  out.bytes += ' ';
  put_text(out, label[row]);
}

std::string tetrahedra_text(const FileMesh& mesh, CellKind kind) {
  NumberSink out;
  const CellRows rows = rows_of(mesh, kind);
  const CellColumns& cells = columns_of(mesh, kind);
  const std::vector<std::int32_t>& label = label_of(cells);
  const std::size_t labels = label.empty() ? 0 : 1;
  out.bytes.reserve(40 * rows.count);
  put_names(out, "# attribute names:", labels == 1 ? "region" : "", cells.data, "");
  put_text(out, fmt::format("{} {} {}\n", rows.count, rows.nodes, labels + numbers_in(cells.data)));
  for (std::size_t i = 0; i < rows.count; ++i) {
    put_cell(out, kind, rows[i], label, i);
    put_columns(out, cells.data, i);
    out.bytes += '\n';
  }
  return std::move(out.bytes);
}

std::string marked_text(const FileMesh& mesh, CellKind kind) {
  NumberSink out;
  const CellRows rows = rows_of(mesh, kind);
  const std::vector<std::int32_t>& label = label_of(columns_of(mesh, kind));
  out.bytes.reserve(32 * rows.count);
  put_text(out, fmt::format("{} {}\n", rows.count, label.empty() ? 0 : 1));
  for (std::size_t i = 0; i < rows.count; ++i) {
    put_cell(out, kind, rows[i], label, i);
    out.bytes += '\n';
  }
  return std::move(out.bytes);
}

}  // namespace

std::string escaped_name(std::string_view name, bool escape_first) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_odd =
        byte <= 0x20 || byte == 0x7f || c == '%' || c == ',' || c == '*' || c == '"';
    if (is_odd || (escape_first && out.empty())) {
      out += fmt::format("%{:02X}", byte);
    } else {
      out += c;
    }
  }
  return out;
}

bool is_tetgen_curved(const FileMesh& mesh) {
  bool has_curved = false, has_straight = false;
  for (const CellKind kind : {CellKind::edge, CellKind::triangle, CellKind::tetrahedron}) {
    has_straight = has_straight || rows_of(mesh, kind).count > 0;
  }
  for (const CellKind kind : {CellKind::edge3, CellKind::triangle6, CellKind::tetrahedron10}) {
    has_curved = has_curved || rows_of(mesh, kind).count > 0;
  }
  return has_curved && !has_straight;
}

std::optional<Finding> write_tetgen(const std::filesystem::path& path, const FileMesh& mesh,
                                    const FileEncoding&) {
  const auto named = [stem = tetgen_stem(path)](std::string_view ending) {
    std::filesystem::path file = stem;
    return file += ending;
  };
  const auto is_there = [&](std::string_view ending) {
    return file_exists(named(ending)) || file_exists(named(std::string(ending) + ".gz"));
  };
  const bool is_curved = is_tetgen_curved(mesh);
  const auto kind = [&](CellKind linear, CellKind curved) { return is_curved ? curved : linear; };
  const CellKind body = kind(CellKind::tetrahedron, CellKind::tetrahedron10);
  const CellKind face = kind(CellKind::triangle, CellKind::triangle6);
  const CellKind edge = kind(CellKind::edge, CellKind::edge3);
  if (auto error = write_file(named(".ele"), tetrahedra_text(mesh, body))) return error;
  if (rows_of(mesh, face).count > 0 || is_there(".face")) {
    if (auto error = write_file(named(".face"), marked_text(mesh, face))) return error;
  }
  if (rows_of(mesh, edge).count > 0 || is_there(".edge")) {
    if (auto error = write_file(named(".edge"), marked_text(mesh, edge))) return error;
  }
  return write_file(named(".node"), points_text(mesh));
}

}  // namespace sunder::io

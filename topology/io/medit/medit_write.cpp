// SPDX-License-Identifier: MIT
// Writing MEDIT: points, then cells by dimension, each with its reference.
#include "topology/io/medit/medit.hpp"
#include "topology/io/number_sink.hpp"

namespace sunder::io {
namespace {

constexpr int dimension_code = 3, vertices_code = 4, end_code = 54;
constexpr std::string_view keywords[] = {"", "Edges", "Triangles", "Tetrahedra"};
constexpr int keyword_codes[] = {0, 5, 6, 8};

std::string write_text(const FileMesh& mesh) {
  NumberSink out;
  out.bytes.reserve(64 * mesh.points.size() + 32 * cell_count(mesh));
  put_text(out, "MeshVersionFormatted 2\nDimension 3\n");
  const auto section = [&out](std::string_view keyword, std::size_t rows) {
    put_text(out, keyword);
    out.bytes += '\n';  // meshio wants the count on a line of its own
    put_text(out, rows);
    out.bytes += '\n';
  };
  section("Vertices", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double x : mesh.points[i]) put<double>(out, x);
    put<std::int32_t>(out, mesh.point_region.empty() ? 0 : mesh.point_region[i], '\n');
  }
  for_each_cell_list(mesh, [&](const auto& cells, int dimension) {
    if (dimension == 0 || cells.corners.empty()) return;
    const std::vector<std::int32_t>& label = label_of(cells);
    section(keywords[dimension], cells.corners.size());
    for (std::size_t i = 0; i < cells.corners.size(); ++i) {
      for (const std::uint32_t corner : cells.corners[i]) put<std::int64_t>(out, corner + 1L);
      put<std::int32_t>(out, label.empty() ? 0 : label[i], '\n');
    }
  });
  put_text(out, "End\n");
  return std::move(out.bytes);
}

/// Version 3: doubles, 4-byte integers, places of 8 bytes.
std::string write_binary(const FileMesh& mesh) {
  NumberSink out{.is_binary = true};
  out.bytes.reserve(64 + 28 * mesh.points.size() + 20 * cell_count(mesh));
  put_raw<std::int32_t>(out, 1);
  put_raw<std::int32_t>(out, 3);
  // A keyword, and the place behind `bytes` more.
  const auto section = [&out](int code, std::size_t bytes) {
    put_raw<std::int32_t>(out, code);
    put_raw<std::int64_t>(out, out.bytes.size() + sizeof(std::int64_t) + bytes);
  };
  section(dimension_code, 4);
  put_raw<std::int32_t>(out, 3);
  section(vertices_code, 4 + 28 * mesh.points.size());
  put_raw<std::int32_t>(out, mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double x : mesh.points[i]) put_raw<double>(out, x);
    put_raw<std::int32_t>(out, mesh.point_region.empty() ? 0 : mesh.point_region[i]);
  }
  for_each_cell_list(mesh, [&](const auto& cells, int dimension) {
    if (dimension == 0 || cells.corners.empty()) return;
    const std::vector<std::int32_t>& label = label_of(cells);
    const std::size_t numbers = static_cast<std::size_t>(dimension) + 2;
    section(keyword_codes[dimension], 4 + 4 * numbers * cells.corners.size());
    put_raw<std::int32_t>(out, cells.corners.size());
    for (std::size_t i = 0; i < cells.corners.size(); ++i) {
      for (const std::uint32_t corner : cells.corners[i]) put_raw<std::int32_t>(out, corner + 1);
      put_raw<std::int32_t>(out, label.empty() ? 0 : label[i]);
    }
  });
  put_raw<std::int32_t>(out, end_code);
  put_raw<std::int64_t>(out, 0);
  return std::move(out.bytes);
}

}  // namespace

std::string write_medit(const FileMesh& mesh, bool is_binary) {
  return is_binary ? write_binary(mesh) : write_text(mesh);
}

}  // namespace sunder::io

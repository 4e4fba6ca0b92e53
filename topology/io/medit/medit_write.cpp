// SPDX-License-Identifier: MIT
// Writing MEDIT: points, then cells by dimension, each with its reference.
#include "topology/io/medit/medit.hpp"
#include "topology/io/medit/medit_order.hpp"
#include "topology/io/text/number_sink.hpp"

namespace sunder::io {
namespace {

/// In this order.
struct WrittenSection {
  CellKind kind;
  std::string_view keyword;
  int code;
};
constexpr WrittenSection written_sections[] = {{CellKind::edge, "Edges", 5},
                                               {CellKind::edge3, "EdgesP2", 25},
                                               {CellKind::triangle, "Triangles", 6},
                                               {CellKind::triangle6, "TrianglesP2", 24},
                                               {CellKind::quad4, "Quadrilaterals", 7},
                                               {CellKind::quad9, "QuadrilateralsQ2", 27},
                                               {CellKind::tetrahedron, "Tetrahedra", 8},
                                               {CellKind::tetrahedron10, "TetrahedraP2", 30},
                                               {CellKind::hexahedron8, "Hexahedra", 10},
                                               {CellKind::hexahedron27, "HexahedraQ2", 33},
                                               {CellKind::prism6, "Prisms", 9},
                                               {CellKind::prism18, "PrismsP2", 86},
                                               {CellKind::pyramid5, "Pyramids", 49},
                                               {CellKind::pyramid14, "PyramidsP2", 87}};

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
  for (const WrittenSection& s : written_sections) {
    const CellRows rows = rows_of(mesh, s.kind);
    if (rows.count == 0) continue;
    const std::vector<std::int32_t>& label = label_of(columns_of(mesh, s.kind));
    if (needs_medit_order(s.kind)) {
      const MeditOrder& order = *medit_order_of(s.kind);
      section(order.keyword, rows.nodes);
      for (const BezierPlace& place : bezier_places(s.kind)) {
        for (std::size_t k = 0; k < order.numbers; ++k) {
          put<std::int64_t>(out, place[k], k + 1 == order.numbers ? '\n' : ' ');
        }
      }
    }
    section(s.keyword, rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (const std::uint32_t node : rows[i]) put<std::int64_t>(out, node + 1L);
      put<std::int32_t>(out, label.empty() ? 0 : label[i], '\n');
    }
  }
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
  for (const WrittenSection& s : written_sections) {
    const CellRows rows = rows_of(mesh, s.kind);
    if (rows.count == 0) continue;
    const std::vector<std::int32_t>& label = label_of(columns_of(mesh, s.kind));
    if (needs_medit_order(s.kind)) {
      const MeditOrder& order = *medit_order_of(s.kind);
      section(order.code, 4 + 4 * order.numbers * rows.nodes);
      put_raw<std::int32_t>(out, rows.nodes);
      for (const BezierPlace& place : bezier_places(s.kind)) {
        for (std::size_t k = 0; k < order.numbers; ++k) put_raw<std::int32_t>(out, place[k]);
      }
    }
    section(s.code, 4 + 4 * (rows.nodes + 1) * rows.count);
    put_raw<std::int32_t>(out, rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (const std::uint32_t node : rows[i]) put_raw<std::int32_t>(out, node + 1);
      put_raw<std::int32_t>(out, label.empty() ? 0 : label[i]);
    }
  }
  put_raw<std::int32_t>(out, end_code);
  put_raw<std::int64_t>(out, 0);
  return std::move(out.bytes);
}

}  // namespace

std::string write_medit(const FileMesh& mesh, bool is_binary) {
  return is_binary ? write_binary(mesh) : write_text(mesh);
}

}  // namespace sunder::io

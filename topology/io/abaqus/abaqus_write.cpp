// SPDX-License-Identifier: MIT
// Abaqus' input written: nodes, elements and sets.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "topology/base/sort_unique.hpp"
#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/regions/named_regions.hpp"
#include "topology/io/text/number_sink.hpp"

namespace sunder::io {
namespace {

/// Kinds that Abaqus has, by names that CalculiX and others know too where there are such.
struct WrittenType {
  CellKind kind;
  std::string_view name;
};
constexpr WrittenType written_types[] = {{CellKind::edge, "T3D2"},
                                         {CellKind::edge3, "T3D3"},
                                         {CellKind::triangle, "S3"},
                                         {CellKind::triangle6, "STRI65"},
                                         {CellKind::quad4, "S4"},
                                         {CellKind::quad8, "S8R"},
                                         {CellKind::quad9, "M3D9"},
                                         {CellKind::tetrahedron, "C3D4"},
                                         {CellKind::tetrahedron10, "C3D10"},
                                         {CellKind::hexahedron8, "C3D8"},
                                         {CellKind::hexahedron20, "C3D20"},
                                         {CellKind::hexahedron27, "C3D27"},
                                         {CellKind::prism6, "C3D6"},
                                         {CellKind::prism15, "C3D15"},
                                         {CellKind::prism18, "C3D15V"},
                                         {CellKind::pyramid5, "C3D5"}};

/// Whether all `rows` have a number, positive and unlike the others.
bool are_held(std::vector<std::int64_t> numbers, std::size_t rows) {
  if (numbers.size() != rows) return false;
  sort_unique(numbers);
  return numbers.size() == rows && (rows == 0 || numbers.front() > 0);
}

void put_real(NumberSink& out, double x) {
  constexpr std::size_t calculix_reads = 20;
  const std::size_t before = out.bytes.size();
  put_text(out, x);
  if (out.bytes.size() - before <= calculix_reads || !(std::abs(x) < 1)) return;
  char text[400];
  const auto [end, reason] = std::to_chars(text, text + sizeof text, x, std::chars_format::fixed);
  out.bytes.resize(before);
  out.bytes.append(text, end);
}

void put_nodes(NumberSink& out, const FileMesh& mesh, bool has_numbers) {
  put_text(out, "*NODE\n");
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    put_text(out, has_numbers ? mesh.source_point_id[i] : static_cast<std::int64_t>(i + 1));
    for (const double x : mesh.points[i]) {
      put_text(out, ", ");
      put_real(out, x);
    }
    out.bytes += '\n';
  }
}

/// Calls `begin(i)` where a row has another label than the one before, then `row(i)`.
template <class Begin, class Row>
void for_each_run(std::size_t rows, const std::vector<std::int32_t>& label, Begin begin, Row row) {
  for (std::size_t i = 0; i < rows; ++i) {
    if (i == 0 || (!label.empty() && label[i] != label[i - 1])) begin(i);
    row(i);
  }
}

}  // namespace

HeldNumbers abaqus_holds(const FileMesh& mesh) {
  std::vector<std::int64_t> cells;
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::vertex) continue;
    const std::vector<std::int64_t>& own = columns_of(mesh, kind).source_id;
    cells.insert(cells.end(), own.begin(), own.end());
  }
  return {are_held(mesh.source_point_id, mesh.points.size()),
          are_held(std::move(cells), cell_count(mesh) - mesh.vertices.corners.size())};
}

std::string write_abaqus(const FileMesh& mesh) {
  NumberSink out;
  const HeldNumbers own = abaqus_holds(mesh);
  const RegionNames words = region_words(mesh.region_name);
  out.bytes.reserve(64 * mesh.points.size() + 48 * cell_count(mesh));
  put_text(out, fmt::format("*HEADING\n{} nodes, {} elements, written by Sunder\n",
                            mesh.points.size(), cell_count(mesh) - mesh.vertices.corners.size()));
  put_nodes(out, mesh, own.points);
  const auto node = [&](std::uint32_t row) {
    put_text(out, own.points ? mesh.source_point_id[row] : std::int64_t{row} + 1);
  };
  std::int64_t next = 1;
  for (const WrittenType& type : written_types) {
    const CellRows rows = rows_of(mesh, type.kind);
    const CellColumns& cells = columns_of(mesh, type.kind);
    const std::vector<std::int32_t>& label = label_of(cells);
    const std::span<const std::uint8_t> order = abaqus_order(type.kind);
    const auto begin = [&](std::size_t i) {
      put_text(out, fmt::format("*ELEMENT, TYPE={}", type.name));
      if (!label.empty()) {
        const int d = traits_of(type.kind).dimension;
        put_text(out, ", ELSET=" + word_of_region(words, d, label[i]));
      }
      out.bytes += '\n';
    };
    for_each_run(rows.count, label, begin, [&](std::size_t i) {
      // CalculiX reads 16 numbers of a line.
      constexpr std::size_t most = 15;
      put_text(out, own.cells ? cells.source_id[i] : next++);
      for (std::size_t k = 0; k < rows.nodes; ++k) {
        put_text(out, k > 0 && k % most == 0 ? ",\n" : ", ");
        node(rows[i][order.empty() ? k : order[k]]);
      }
      out.bytes += '\n';
    });
  }
  const std::vector<std::int32_t>& label = label_of(mesh.vertices);
  std::size_t in_line = 0;
  const auto begin = [&](std::size_t i) {
    const std::int32_t region = label.empty() ? 0 : label[i];
    put_text(out, fmt::format("{}*NSET, NSET={}\n", in_line > 0 ? "\n" : "",
                              word_of_region(words, 0, region)));
    in_line = 0;
  };
  for_each_run(mesh.vertices.corners.size(), label, begin, [&](std::size_t i) {
    constexpr std::size_t most = 16;
    if (in_line == most) {
      put_text(out, ",\n");
      in_line = 0;
    }
    if (in_line++ > 0) put_text(out, ", ");
    node(mesh.vertices.corners[i][0]);
  });
  if (in_line > 0) out.bytes += '\n';
  return std::move(out.bytes);
}

}  // namespace sunder::io

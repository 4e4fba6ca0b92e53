// SPDX-License-Identifier: MIT
// Abaqus' input written: nodes, elements and sets.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "topology/base/sort_unique.hpp"
#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/named_regions.hpp"
#include "topology/io/number_sink.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view element_types[] = {"", "T3D2", "S3", "C3D4"};

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
  for_each_cell_list(mesh, [&](const auto& list, int d) {
    if (d > 0) cells.insert(cells.end(), list.source_id.begin(), list.source_id.end());
  });
  return {are_held(mesh.source_point_id, mesh.points.size()),
          are_held(std::move(cells), cell_count(mesh) - mesh.vertices.corners.size())};
}

std::string write_abaqus(const FileMesh& mesh) {
  NumberSink out;
  const HeldNumbers own = abaqus_holds(mesh);
  const RegionNames words = region_words(mesh.region_name);
  out.bytes.reserve(64 * mesh.points.size() + 48 * cell_count(mesh));
  put_text(out, fmt::format("*HEADING\n{} nodes, {} tetrahedra, written by Sunder\n",
                            mesh.points.size(), mesh.tetrahedra.corners.size()));
  put_nodes(out, mesh, own.points);
  const auto node = [&](std::uint32_t row) {
    put_text(out, own.points ? mesh.source_point_id[row] : std::int64_t{row} + 1);
  };
  std::int64_t next = 1;
  for_each_cell_list(mesh, [&](const auto& cells, int d) {
    if (d == 0) return;
    const std::vector<std::int32_t>& label = label_of(cells);
    const auto begin = [&](std::size_t i) {
      put_text(out, fmt::format("*ELEMENT, TYPE={}", element_types[d]));
      if (!label.empty()) put_text(out, ", ELSET=" + word_of_region(words, d, label[i]));
      out.bytes += '\n';
    };
    for_each_run(cells.corners.size(), label, begin, [&](std::size_t i) {
      put_text(out, own.cells ? cells.source_id[i] : next++);
      for (const std::uint32_t corner : cells.corners[i]) {
        put_text(out, ", ");
        node(corner);
      }
      out.bytes += '\n';
    });
  });
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

// SPDX-License-Identifier: MIT
// From the arrays of a VTU file to points, cells and columns.
#include "topology/io/vtu_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "topology/io/scan.hpp"
#include "topology/io/vtk_cells.hpp"
#include "topology/io/vtu_xml.hpp"

namespace sunder::io {
namespace {

const VtuArray* find_array(const std::vector<VtuArray>& arrays, std::string_view name) {
  const auto found =
      std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

[[noreturn]] void fail_piece(const VtuDocument& document, const VtuPiece& piece, Finding finding) {
  fail(document.layout.text, piece.at, std::move(finding));
}

const VtuArray& needed_array(const VtuDocument& document, const VtuPiece& piece,
                             std::string_view name) {
  if (const VtuArray* array = find_array(piece.cell_arrays, name)) return *array;
  fail_piece(document, piece,
             {.code = "missing_array",
              .text = fmt::format("this piece has no array {} under Cells", name),
              .remedy = "the file is incomplete: write it again"});
}

void read_points(const VtuDocument& document, const VtuPiece& piece, Draft& draft) {
  if (piece.points == 0) return;
  if (piece.point_arrays.empty()) {
    fail_piece(document, piece,
               {.code = "missing_array",
                .text = "this piece has no array under Points",
                .remedy = "the file is incomplete: write it again"});
  }
  const VtuArray& array = piece.point_arrays.front();
  if (array.components != 3) {
    fail(document.layout.text, array.at,
         {.code = "bad_attribute",
          .text = fmt::format("points have {} components: 3 were expected", array.components),
          .remedy = "write x, y and z for every point"});
  }
  const std::vector<double> x = read_doubles(document.layout, array, 3 * piece.points);
  draft.mesh.points.reserve(draft.mesh.points.size() + piece.points);
  for (std::size_t i = 0; i < piece.points; ++i) {
    add_point(draft, {x[3 * i], x[3 * i + 1], x[3 * i + 2]}, array.at);
  }
}

VtkCells read_cells(const VtuDocument& document, const VtuPiece& piece) {
  VtkCells cells;
  if (piece.cells == 0) return cells;
  const VtuArray& offsets = needed_array(document, piece, "offsets");
  const VtuArray& connectivity = needed_array(document, piece, "connectivity");
  cells.types = read_integers(document.layout, needed_array(document, piece, "types"), piece.cells);
  cells.ends = read_integers(document.layout, offsets, piece.cells);
  check_vtk_cells(cells, document.layout.text, offsets.at);
  const auto listed = static_cast<std::size_t>(cells.ends.back());
  if (listed > document.layout.text.size() * most_unfolding) {
    fail(document.layout.text, offsets.at,
         {.code = "count_too_big",
          .text = fmt::format("the last offset is {}, more than the file can hold", listed),
          .remedy = "the file is damaged: write it again"});
  }
  cells.points = read_integers(document.layout, connectivity, listed);
  return cells;
}

/// An array as a column; arrays that are no numbers (strings) are none.
std::optional<DataColumn> read_column(const VtuDocument& document, const VtuArray& array,
                                      std::size_t rows, Draft& draft) {
  const auto* const word = std::ranges::find(vtu_types, array.type);
  if (word == std::end(vtu_types)) {
    draft.findings.push_back({.code = "skipped_data",
                              .severity = Severity::warning,
                              .text = fmt::format("the data {} of type {} are left out",
                                                  in_quotes(array.name), in_quotes(array.type)),
                              .remedy = "give them as numbers, if they matter",
                              .line = line_of(document.layout.text, array.at)});
    return std::nullopt;
  }
  const auto type = static_cast<NumberType>(word - vtu_types);
  DataColumn column{array.name, array.components, type, {}};
  if (type == NumberType::float64 || type == NumberType::float32) {
    column.values = read_doubles(document.layout, array, rows * array.components);
  } else {
    column.values = read_integers(document.layout, array, rows * array.components);
  }
  return column;
}

void read_piece(const VtuDocument& document, const VtuPiece& piece, Draft& draft) {
  VtkPiece place{.first_point = draft.mesh.points.size(), .points = piece.points};
  read_points(document, piece, draft);
  {
    const VtkCells cells = read_cells(document, piece);
    const std::size_t at =
        cells.types.empty() ? 0 : needed_array(document, piece, "connectivity").at;
    add_vtk_cells(draft, place, cells, at);
  }
  for (const VtuArray& array : piece.cell_data) {
    const auto column = read_column(document, array, piece.cells, draft);
    if (column) add_vtk_cell_column(draft, place, *column, array.at);
  }
  for (const VtuArray& array : piece.point_data) {
    auto column = read_column(document, array, piece.points, draft);
    if (column) add_vtk_point_column(draft, place, std::move(*column), array.at);
  }
}

}  // namespace

bool is_vtu(std::string_view text) {
  const std::string_view word = first_word(text);
  return word.starts_with("<?xml") || word.starts_with("<VTKFile");
}

Draft read_vtu(std::string_view text) {
  const VtuDocument document = parse_vtu(text);
  Draft draft{.text = text};
  for (const VtuPiece& piece : document.pieces) read_piece(document, piece, draft);
  finish_vtk_columns(draft);
  return draft;
}

}  // namespace sunder::io

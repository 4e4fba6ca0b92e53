// SPDX-License-Identifier: MIT
// From the arrays of a VTU file to points, cells and columns.
#include "topology/io/vtu/vtu_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "topology/io/text/scan.hpp"
#include "topology/io/vtk/vtk_columns.hpp"
#include "topology/io/vtk/vtk_polydata.hpp"
#include "topology/io/vtu/vtu_xml.hpp"

namespace sunder::io {
namespace {

const VtuArray* find_array(const std::list<VtuArray>& arrays, std::string_view name,
                           std::size_t list) {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) {
    return a.name == name && a.poly_list == list;
  });
  return found == arrays.end() ? nullptr : &*found;
}

[[noreturn]] void fail_piece(const VtuDocument& document, const VtuPiece& piece, Finding finding) {
  fail(document.layout.text, piece.at, std::move(finding));
}

const VtuArray& needed_array(const VtuDocument& document, const VtuPiece& piece,
                             std::string_view name, std::size_t list = 0) {
  if (const VtuArray* array = find_array(piece.cell_arrays, name, list)) return *array;
  fail_piece(document, piece,
             {.code = "missing_array",
              .text = fmt::format("this piece has no array {} among its cells", name),
              .remedy = "the file is incomplete: write it again"});
}

void read_points(VtuDocument& document, const VtuPiece& piece, Draft& draft) {
  if (piece.points == 0) return;
  if (piece.point_arrays.empty()) {
    fail_piece(document, piece,
               {.code = "missing_array",
                .text = "this piece has no array under Points",
                .remedy = "the file is incomplete: write it again"});
  }
  VtuArray array = piece.point_arrays.front();
  // Digits of coordinates are kept, whatever the type.
  if (array.is_ascii && array.type == "Float32") array.type = "Float64";
  if (array.components != 3) {
    fail(document.layout.text, array.at,
         {.code = "bad_attribute",
          .text = fmt::format("points have {} components: 3 were expected", array.components),
          .remedy = "write x, y and z for every point"});
  }
  Point point;
  std::size_t k = 0;
  read_doubles(document.layout, array, 3 * piece.points, [&](std::span<const double> block) {
    if (k == 0) make_room(draft.mesh.points, piece.points);  // their bytes are there
    for (const double x : block) {
      point[k++ % 3] = x;
      if (k % 3 == 0) add_point(draft, point, array.at);
    }
  });
}

/// The connectivity that goes with these ends.
std::vector<std::int64_t> read_connectivity(VtuDocument& document, const VtuArray& array,
                                            std::int64_t end, std::size_t at) {
  const auto listed = static_cast<std::size_t>(std::max<std::int64_t>(end, 0));
  if (listed > document.layout.text.size() * most_unfolding) {
    fail(document.layout.text, at,
         {.code = "count_too_big",
          .text = fmt::format("the last offset is {}, more than the file can hold", listed),
          .remedy = "the file is damaged: write it again"});
  }
  return read_integers(document.layout, array, listed);
}

/// All lists of PolyData as one.
VtkCells read_poly_cells(VtuDocument& document, const VtuPiece& piece, std::size_t& at) {
  VtkCells cells;
  for (std::size_t i = 0; i < poly_lists; ++i) {
    if (piece.poly_cells[i] == 0) continue;
    const VtuArray& offsets = needed_array(document, piece, "offsets", i);
    const VtuArray& connectivity = needed_array(document, piece, "connectivity", i);
    at = offsets.at;
    VtkCells list{.ends = read_integers(document.layout, offsets, piece.poly_cells[i])};
    list.points = read_connectivity(document, connectivity, list.ends.back(), at);
    append_poly_cells(cells, static_cast<PolyList>(i), std::move(list),
                      document.layout.text.size());
  }
  check_vtk_cells(cells, document.layout.text, at);
  return cells;
}

/// `at`: becomes the place of the cells in the text.
VtkCells read_cells(VtuDocument& document, const VtuPiece& piece, std::size_t& at) {
  VtkCells cells;
  if (piece.cells == 0) return cells;
  if (document.is_polydata) return read_poly_cells(document, piece, at);
  const auto array = [&](std::string_view name) -> const VtuArray& {
    return needed_array(document, piece, name);
  };
  const VtuArray& offsets = array("offsets");
  const VtuArray& connectivity = array("connectivity");
  at = connectivity.at;
  cells.types = read_integers(document.layout, array("types"), piece.cells);
  cells.ends = read_integers(document.layout, offsets, piece.cells);
  check_vtk_cells(cells, document.layout.text, offsets.at);
  cells.points = read_connectivity(document, connectivity, cells.ends.back(), offsets.at);
  return cells;
}

/// All points and cells of a piece; where they went in the mesh.
VtkPiece read_grid(VtuDocument& document, const VtuPiece& piece, Draft& draft) {
  VtkPiece place{.first_point = draft.mesh.points.size(), .points = piece.points};
  read_points(document, piece, draft);
  std::size_t at = 0;
  const VtkCells cells = read_cells(document, piece, at);
  add_vtk_cells(draft, place, cells, at);
  return place;
}

/// How many numbers an array has; fails where the file cannot hold them.
std::size_t numbers_of(const VtuDocument& document, const VtuArray& array, std::size_t rows) {
  const std::size_t most = document.layout.text.size() * most_unfolding;
  if (rows <= most / array.components) return rows * array.components;
  fail(document.layout.text, array.at,
       {.code = "count_too_big",
        .text = fmt::format("array {} has {} components for {} rows, more than the file can hold",
                            in_quotes(array.name), array.components, rows),
        .remedy = "correct NumberOfComponents, or write the file again"});
}

/// Where an array goes, and the names that its piece has given before.
struct ColumnPlace {
  Draft& draft;
  VtkPiece& piece;
  VtkNames& names;
  bool of_cells = false;
};

void read_column(VtuDocument& document, const VtuArray& array, const ColumnPlace& to) {
  const std::size_t rows = to.of_cells ? to.piece.list_of_cell.size() : to.piece.points;
  if (rows == 0 || array.components == 0) return;
  const auto* const word = std::ranges::find(vtu_types, array.type);
  if (word == std::end(vtu_types)) {
    return add_skipped(to.draft, "data that are no numbers",
                       fmt::format("{} of type {}", array.name, array.type), array.at);
  }
  const auto type = static_cast<NumberType>(word - vtu_types);
  const VtkArrayHead head{array.name, array.components, type, to.of_cells, array.at};
  if (!is_new_name(to.draft, to.names, head)) return;
  VtuLayout& layout = document.layout;
  const std::size_t n = numbers_of(document, array, rows);
  if (is_vtk_label(head)) {
    return add_vtk_label(to.draft, to.piece, head, read_integers(layout, array, n));
  }
  // Of the whole file no more numbers than it has bytes; unfolded ones are here when room is made.
  const std::size_t most = std::max(n, layout.is_compressed ? 0 : layout.text.size());
  const auto into_mesh = [&]<class Value>(Value) -> TakeValues<Value> {
    return [&, sink = std::optional<VtkSink<Value>>()](std::span<const Value> block) mutable {
      if (!sink) sink = begin_vtk_data<Value>(to.draft, to.piece, head, most);
      (*sink)(block);
    };
  };
  is_real(type) ? read_doubles(layout, array, n, into_mesh(double{}))
                : read_integers(layout, array, n, into_mesh(std::int64_t{}));
}

}  // namespace

bool is_vtu(std::string_view text) {
  const std::string_view word = first_word(text);
  return (word.starts_with("<?xml") || word.starts_with("<VTKFile")) && !is_vtp(text);
}

bool is_vtp(std::string_view text) {
  if (!first_word(text).starts_with('<')) return false;
  constexpr std::size_t far = 4096;
  const std::size_t tag = text.substr(0, far).find("<VTKFile");
  if (tag == std::string_view::npos) return false;
  const std::string_view attributes = text.substr(tag, text.find('>', tag) - tag);
  return attributes.find("\"PolyData\"") != std::string_view::npos ||
         attributes.find("'PolyData'") != std::string_view::npos;
}

Draft read_vtu(std::string_view text) {
  VtuDocument document = parse_vtu(text);
  Draft draft{.text = text};
  for (const VtuSkipped& s : document.skipped) add_skipped(draft, s.kind, s.name, s.at);
  std::size_t points = 0;
  for (const VtuPiece& piece : document.pieces) points += piece.points;
  const bool is_one = document.pieces.size() == 1 || document.layout.is_compressed;
  if (!is_one) draft.mesh.points.reserve(std::min(points, text.size() / 3));
  // All rows first: then columns are as long as they will be from the start.
  std::vector<VtkPiece> places;
  places.reserve(document.pieces.size());
  for (const VtuPiece& piece : document.pieces) {
    places.push_back(read_grid(document, piece, draft));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    VtkNames names;
    for (const VtuArray& array : document.pieces[i].cell_data) {
      read_column(document, array, {draft, places[i], names, true});
    }
    for (const VtuArray& array : document.pieces[i].point_data) {
      read_column(document, array, {draft, places[i], names, false});
    }
  }
  finish_vtk_columns(draft);
  return draft;
}

}  // namespace sunder::io

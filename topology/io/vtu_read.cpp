// SPDX-License-Identifier: MIT
// From the arrays of a VTU file to tetrahedra: cell types, offsets and regions judged.
#include "topology/io/vtu_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "topology/io/scan.hpp"
#include "topology/io/vtu_xml.hpp"

namespace sunder::io {
namespace {

/// VTK's cell types: number, plural name, dimension (vtkCellType.h).
struct CellType {
  std::int64_t number;
  std::string_view name;
  int dimension;
};
constexpr std::int64_t tetrahedron_type = 10;
constexpr CellType cell_types[] = {
    {0, "empty cells", 0},
    {1, "vertices", 0},
    {2, "poly-vertices", 0},
    {3, "lines", 1},
    {4, "polylines", 1},
    {5, "triangles", 2},
    {6, "triangle strips", 2},
    {7, "polygons", 2},
    {8, "pixels", 2},
    {9, "quadrilaterals", 2},
    {10, "tetrahedra", 3},
    {11, "voxels", 3},
    {12, "hexahedra", 3},
    {13, "wedges", 3},
    {14, "pyramids", 3},
    {15, "pentagonal prisms", 3},
    {16, "hexagonal prisms", 3},
    {21, "quadratic edges", 1},
    {22, "quadratic triangles", 2},
    {23, "quadratic quadrilaterals", 2},
    {24, "quadratic tetrahedra", 3},
    {25, "quadratic hexahedra", 3},
    {26, "quadratic wedges", 3},
    {27, "quadratic pyramids", 3},
    {28, "biquadratic quadrilaterals", 2},
    {29, "triquadratic hexahedra", 3},
    {30, "quadratic-linear quadrilaterals", 2},
    {31, "quadratic-linear wedges", 3},
    {32, "biquadratic-quadratic wedges", 3},
    {33, "biquadratic-quadratic hexahedra", 3},
    {34, "biquadratic triangles", 2},
    {35, "cubic lines", 1},
    {36, "quadratic polygons", 2},
    {37, "triquadratic pyramids", 3},
    {41, "convex point sets", 3},
    {42, "polyhedra", 3},
    {68, "Lagrange curves", 1},
    {69, "Lagrange triangles", 2},
    {70, "Lagrange quadrilaterals", 2},
    {71, "Lagrange tetrahedra", 3},
    {72, "Lagrange hexahedra", 3},
    {73, "Lagrange wedges", 3},
    {74, "Lagrange pyramids", 3},
    {75, "Bezier curves", 1},
    {76, "Bezier triangles", 2},
    {77, "Bezier quadrilaterals", 2},
    {78, "Bezier tetrahedra", 3},
    {79, "Bezier hexahedra", 3},
    {80, "Bezier wedges", 3},
    {81, "Bezier pyramids", 3},
};

/// Integer cell arrays that mean a region, ours first; the others as Gmsh, meshio, CGAL and FEniCS
/// name them.
constexpr std::string_view region_names[] = {"region", "gmsh:physical", "medit:ref",
                                             "CellEntityIds", "cell_tags"};

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

/// The cells of one piece: what each is, and where its points end in the list.
struct Cells {
  std::vector<std::int64_t> types;
  std::vector<std::int64_t> ends;
  std::vector<std::int64_t> points;
};

Cells read_cells(const VtuDocument& document, const VtuPiece& piece) {
  Cells cells;
  if (piece.cells == 0) return cells;
  const VtuArray& offsets = needed_array(document, piece, "offsets");
  const VtuArray& connectivity = needed_array(document, piece, "connectivity");
  cells.types = read_integers(document.layout, needed_array(document, piece, "types"), piece.cells);
  cells.ends = read_integers(document.layout, offsets, piece.cells);
  std::int64_t before = 0;
  for (std::size_t c = 0; c < piece.cells; ++c) {
    const std::int64_t size = cells.ends[c] - before;
    if (cells.ends[c] < before || (cells.types[c] == tetrahedron_type && size != 4)) {
      fail(document.layout.text, offsets.at,
           {.code = "bad_offsets",
            .ids = {static_cast<std::int64_t>(c)},
            .text = fmt::format("cell {} (VTK type {}) ends at offset {}, the one before at {}{}",
                                c, cells.types[c], cells.ends[c], before,
                                cells.ends[c] < before ? ": offsets must not fall"
                                                       : ": a tetrahedron has 4 points"),
            .remedy = "the file is damaged: write it again"});
    }
    before = cells.ends[c];
  }
  if (static_cast<std::size_t>(before) > document.layout.text.size() * most_unfolding) {
    fail(document.layout.text, offsets.at,
         {.code = "count_too_big",
          .text = fmt::format("the last offset is {}, more than the file can hold", before),
          .remedy = "the file is damaged: write it again"});
  }
  cells.points = read_integers(document.layout, connectivity, static_cast<std::size_t>(before));
  return cells;
}

void add_other_cell(const VtuDocument& document, const VtuPiece& piece, std::int64_t number,
                    Draft& draft) {
  const auto* const type = std::find_if(std::begin(cell_types), std::end(cell_types),
                                        [&](const CellType& t) { return t.number == number; });
  if (type == std::end(cell_types)) {
    fail_piece(document, piece,
               {.code = "unknown_cell_type",
                .text = fmt::format("VTK cell type {} is not known", number),
                .remedy = "save the mesh with linear cells only"});
  }
  add_other_cells(draft, type->name, type->dimension, 1, piece.at);
}

/// Values of an array, one a cell, of those cells that are tetrahedra.
template <class Value>
void append_of_tetrahedra(const Cells& cells, const std::vector<std::int64_t>& values,
                          std::vector<Value>& out) {
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    if (cells.types[c] == tetrahedron_type) out.push_back(static_cast<Value>(values[c]));
  }
}

bool is_integer_scalar(const VtuArray& array) {
  return array.components == 1 && array.type.substr(0, 5) != "Float";
}

/// Regions and source ids; of several pieces all or none have them.
void read_columns(const VtuDocument& document, const VtuPiece& piece, const Cells& cells,
                  Draft& draft) {
  for (const std::string_view name : region_names) {
    const VtuArray* array = find_array(piece.cell_data, name);
    if (array == nullptr || !is_integer_scalar(*array)) continue;
    const auto values = read_integers(document.layout, *array, piece.cells);
    for (const std::int64_t value : values) {
      if (value >= std::numeric_limits<std::int32_t>::min() &&
          value <= std::numeric_limits<std::int32_t>::max()) {
        continue;
      }
      fail(document.layout.text, array->at,
           {.code = "number_out_of_range",
            .text = fmt::format("region {} has more than 32 bits", value),
            .remedy = "number the regions from -2147483648 to 2147483647"});
    }
    append_of_tetrahedra(cells, values, draft.mesh.region);
    break;
  }
  const VtuArray* array = find_array(piece.cell_data, "source_tetrahedron_id");
  if (array != nullptr && is_integer_scalar(*array)) {
    append_of_tetrahedra(cells, read_integers(document.layout, *array, piece.cells),
                         draft.mesh.source_tetrahedron_id);
  }
  array = find_array(piece.point_data, "source_point_id");
  if (array != nullptr && is_integer_scalar(*array)) {
    const auto ids = read_integers(document.layout, *array, piece.points);
    draft.mesh.source_point_id.insert(draft.mesh.source_point_id.end(), ids.begin(), ids.end());
  }
}

void read_piece(const VtuDocument& document, const VtuPiece& piece, Draft& draft) {
  const auto first_point = static_cast<std::int64_t>(draft.mesh.points.size());
  read_points(document, piece, draft);
  const auto points = static_cast<std::int64_t>(piece.points);
  const Cells cells = read_cells(document, piece);
  const std::size_t at = cells.types.empty() ? 0 : needed_array(document, piece, "connectivity").at;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    if (cells.types[c] != tetrahedron_type) {
      add_other_cell(document, piece, cells.types[c], draft);
      continue;
    }
    FileTetrahedron tetrahedron{.at = at};
    for (int k = 0; k < 4; ++k) {
      const std::int64_t row = cells.points[static_cast<std::size_t>(cells.ends[c]) - 4 + k];
      tetrahedron.numbers[k] = row;
      tetrahedron.rows[k] = row >= 0 && row < points ? first_point + row : -1;
    }
    add_tetrahedron(draft, tetrahedron);
  }
  read_columns(document, piece, cells, draft);
}

}  // namespace

Draft read_vtu(std::string_view text) {
  const VtuDocument document = parse_vtu(text);
  Draft draft{.text = text};
  for (const VtuPiece& piece : document.pieces) read_piece(document, piece, draft);
  TetMesh& mesh = draft.mesh;
  if (mesh.region.size() != mesh.tetrahedra.size()) mesh.region.clear();
  if (mesh.source_point_id.size() != mesh.points.size()) mesh.source_point_id.clear();
  if (mesh.source_tetrahedron_id.size() != mesh.tetrahedra.size()) {
    mesh.source_tetrahedron_id.clear();
  }
  return draft;
}

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// Between VTK's one list of cells of any type and ours of simplices by dimension.
#include "topology/io/vtk/vtk_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "topology/io/scan.hpp"

namespace sunder::io {
namespace {

/// VTK's cell types: number, plural name, dimension (vtkCellType.h).
struct CellType {
  std::int64_t number;
  std::string_view name;
  int dimension;
  /// Whether its first points are the corners of a simplex.
  bool is_simplex = false;
};
constexpr CellType cell_types[] = {
    {0, "empty cells", 0},
    {1, "vertices", 0, true},
    {2, "poly-vertices", 0},
    {3, "lines", 1, true},
    {4, "polylines", 1},
    {5, "triangles", 2, true},
    {6, "triangle strips", 2},
    {7, "polygons", 2},
    {8, "pixels", 2},
    {9, "quadrilaterals", 2},
    {10, "tetrahedra", 3, true},
    {11, "voxels", 3},
    {12, "hexahedra", 3},
    {13, "wedges", 3},
    {14, "pyramids", 3},
    {15, "pentagonal prisms", 3},
    {16, "hexagonal prisms", 3},
    {21, "quadratic edges", 1, true},
    {22, "quadratic triangles", 2, true},
    {23, "quadratic quadrilaterals", 2},
    {24, "quadratic tetrahedra", 3, true},
    {25, "quadratic hexahedra", 3},
    {26, "quadratic wedges", 3},
    {27, "quadratic pyramids", 3},
    {28, "biquadratic quadrilaterals", 2},
    {29, "triquadratic hexahedra", 3},
    {30, "quadratic-linear quadrilaterals", 2},
    {31, "quadratic-linear wedges", 3},
    {32, "biquadratic-quadratic wedges", 3},
    {33, "biquadratic-quadratic hexahedra", 3},
    {34, "biquadratic triangles", 2, true},
    {35, "cubic lines", 1, true},
    {36, "quadratic polygons", 2},
    {37, "triquadratic pyramids", 3},
    {41, "convex point sets", 3},
    {42, "polyhedra", 3},
    {68, "Lagrange curves", 1, true},
    {69, "Lagrange triangles", 2, true},
    {70, "Lagrange quadrilaterals", 2},
    {71, "Lagrange tetrahedra", 3, true},
    {72, "Lagrange hexahedra", 3},
    {73, "Lagrange wedges", 3},
    {74, "Lagrange pyramids", 3},
    {75, "Bezier curves", 1, true},
    {76, "Bezier triangles", 2, true},
    {77, "Bezier quadrilaterals", 2},
    {78, "Bezier tetrahedra", 3, true},
    {79, "Bezier hexahedra", 3},
    {80, "Bezier wedges", 3},
    {81, "Bezier pyramids", 3},
};

const CellType& cell_type(const Draft& draft, std::int64_t number, std::size_t at) {
  const auto* const type = std::ranges::find(cell_types, number, &CellType::number);
  if (type == std::end(cell_types)) {
    fail(draft.text, at,
         {.code = "unknown_cell_type",
          .text = fmt::format("VTK cell type {} is not known", number),
          .remedy = "save the mesh with linear cells only"});
  }
  return *type;
}

/// How many points a cell has at least: the corners of simplices.
std::size_t fewest_points(const CellType& type) {
  return type.is_simplex ? static_cast<std::size_t>(type.dimension) + 1 : 0;
}

bool is_linear(std::int64_t type) { return type == 1 || type == 3 || type == 5 || type == 10; }

}  // namespace

void check_vtk_cells(const VtkCells& cells, std::string_view text, std::size_t at) {
  std::int64_t before = 0;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    // Numbers of a file: their difference may need more than 64 bits.
    const std::int64_t size = cells.ends[c] < before ? -1 : cells.ends[c] - before;
    const auto* const type = std::ranges::find(cell_types, cells.types[c], &CellType::number);
    const auto fewest =
        static_cast<std::int64_t>(type == std::end(cell_types) ? 0 : fewest_points(*type));
    if (size < 0 || size < fewest || (is_linear(cells.types[c]) && size != fewest)) {
      fail(text, at,
           {.code = "bad_offsets",
            .ids = {static_cast<std::int64_t>(c)},
            .text = fmt::format("cell {} (VTK type {}) ends at offset {}, the one before at {}{}",
                                c, cells.types[c], cells.ends[c], before,
                                size < 0 ? std::string(": offsets must not fall")
                                         : fmt::format(": {} have {} points", type->name, fewest)),
            .remedy = "the file is damaged: write it again"});
    }
    before = cells.ends[c];
  }
}

void add_vtk_cells(Draft& draft, VtkPiece& piece, const VtkCells& cells, std::size_t at) {
  const auto points = static_cast<std::int64_t>(piece.points);
  piece.list_of_cell.reserve(cells.types.size());
  for (const std::int64_t number : cells.types) {
    const CellType& type = cell_type(draft, number, at);
    piece.list_of_cell.push_back(static_cast<std::int8_t>(type.is_simplex ? type.dimension : -1));
    if (type.is_simplex) ++piece.cells[static_cast<std::size_t>(type.dimension)];
  }
  for_each_cell_list(draft.mesh, [&](auto& list, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    piece.first_cell[d] = list.corners.size();
    make_room(list.corners, piece.cells[d]);
  });
  std::size_t begin = 0;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const CellType& type = cell_type(draft, cells.types[c], at);
    const auto end = static_cast<std::size_t>(cells.ends[c]);
    if (!type.is_simplex) {
      add_other_cells(draft, type.name, type.dimension, 1, at);
    } else {
      FileCell cell{.at = at};
      for (std::size_t k = 0; k < fewest_points(type); ++k) {
        const std::int64_t row = cells.points[begin + k];
        cell.numbers[k] = row;
        cell.rows[k] =
            row >= 0 && row < points ? static_cast<std::int64_t>(piece.first_point) + row : -1;
      }
      add_cell(draft, type.dimension, cell);
      if (!is_linear(type.number)) add_curved_cells(draft, type.name, 1, at);
    }
    begin = end;
  }
}

namespace {

/// A column of integers over all cells, from one of each list; none where all lists lack it.
template <class Pick>
void add_own_column(VtkGrid& grid, const FileMesh& mesh, std::string name, NumberType type,
                    Pick pick) {
  bool any = false;
  for_each_cell_list(mesh, [&](const auto& cells, int) { any = any || !pick(cells).empty(); });
  if (!any) return;
  std::vector<std::int64_t> values;
  values.reserve(grid.types.size());
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    const auto& own = pick(cells);
    own.empty() ? values.insert(values.end(), cells.corners.size(), 0)
                : values.insert(values.end(), own.begin(), own.end());
  });
  grid.cell_data.push_back({std::move(name), 1, type, std::move(values)});
}

template <class Value>
void append_rows(std::vector<Value>& out, const DataColumn* column, std::size_t length) {
  if (column == nullptr || !std::holds_alternative<std::vector<Value>>(column->values)) {
    constexpr bool is_real = std::is_floating_point_v<Value>;
    out.insert(out.end(), length,
               is_real ? static_cast<Value>(std::numeric_limits<double>::quiet_NaN()) : Value{});
  } else {
    const auto& values = std::get<std::vector<Value>>(column->values);
    out.insert(out.end(), values.begin(), values.end());
  }
}

/// The data of all lists under their names, in the order in which they come first.
void add_data_columns(VtkGrid& grid, const FileMesh& mesh) {
  for_each_cell_list(mesh, [&](const auto& first_cells, int) {
    for (const DataColumn& like : first_cells.data) {
      const bool is_there =
          std::ranges::find(grid.cell_data, like.name, &DataColumn::name) != grid.cell_data.end();
      if (is_there) continue;
      DataColumn column{like.name, like.components, like.type, {}};
      if (like.values.index() == 1) column.values = std::vector<std::int64_t>{};
      for_each_cell_list(mesh, [&](const auto& cells, int) {
        const auto found = std::ranges::find_if(cells.data, [&](const DataColumn& c) {
          return c.name == like.name && c.components == like.components;
        });
        const DataColumn* part = found == cells.data.end() ? nullptr : &*found;
        std::visit(
            [&](auto& out) { append_rows(out, part, like.components * cells.corners.size()); },
            column.values);
      });
      grid.cell_data.push_back(std::move(column));
    }
  });
}

}  // namespace

VtkGrid vtk_grid(const FileMesh& mesh) {
  constexpr std::uint8_t type_of[] = {1, 3, 5, 10};
  VtkGrid grid;
  for_each_cell_list(mesh, [&](const auto& cells, int dimension) {
    grid.types.insert(grid.types.end(), cells.corners.size(), type_of[dimension]);
    for (const auto& corners : cells.corners) {
      grid.connectivity.insert(grid.connectivity.end(), corners.begin(), corners.end());
      grid.ends.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    }
  });
  add_own_column(
      grid, mesh, "region", NumberType::int32,
      [](const auto& cells) -> const auto& { return cells.region; });
  add_own_column(
      grid, mesh, "entity", NumberType::int32,
      [](const auto& cells) -> const auto& { return cells.entity; });
  add_own_column(
      grid, mesh, "source_cell_id", NumberType::int64,
      [](const auto& cells) -> const auto& { return cells.source_id; });
  add_data_columns(grid, mesh);
  if (!mesh.source_point_id.empty()) {
    grid.point_data.push_back({"source_point_id", 1, NumberType::int64, mesh.source_point_id});
  }
  if (!mesh.point_region.empty()) {
    grid.point_data.push_back(
        {"point_region", 1, NumberType::int32,
         std::vector<std::int64_t>(mesh.point_region.begin(), mesh.point_region.end())});
  }
  for (const DataColumn& column : mesh.point_data) {
    const auto same = std::ranges::find(grid.point_data, column.name, &DataColumn::name);
    if (same == grid.point_data.end()) grid.point_data.push_back(column);
  }
  return grid;
}

namespace {

/// The columns of each name that came first; null for our own.
using FirstColumns = std::map<std::string_view, const DataColumn*>;

void judge_names(const std::vector<DataColumn>& columns, FirstColumns& first,
                 std::vector<std::string>& clashes) {
  std::set<std::string_view> here;
  for (const DataColumn& column : columns) {
    const DataColumn* const like = first.emplace(column.name, &column).first->second;
    const bool is_second = !here.insert(column.name).second;
    if (is_second || like == nullptr || like->components != column.components ||
        like->type != column.type) {
      clashes.push_back(column.name);
    }
  }
}

}  // namespace

std::vector<std::string> vtk_clashes(const FileMesh& mesh) {
  std::vector<std::string> clashes;
  FirstColumns of_points, of_cells;
  if (!mesh.source_point_id.empty()) of_points["source_point_id"] = nullptr;
  if (!mesh.point_region.empty()) of_points["point_region"] = nullptr;
  judge_names(mesh.point_data, of_points, clashes);
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    if (!cells.region.empty()) of_cells["region"] = nullptr;
    if (!cells.entity.empty()) of_cells["entity"] = nullptr;
    if (!cells.source_id.empty()) of_cells["source_cell_id"] = nullptr;
  });
  for_each_cell_list(mesh,
                     [&](const auto& cells, int) { judge_names(cells.data, of_cells, clashes); });
  return clashes;
}

}  // namespace sunder::io

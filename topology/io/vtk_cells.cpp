// SPDX-License-Identifier: MIT
// Between VTK's one list of cells of any type and ours of simplices by dimension.
#include "topology/io/vtk_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
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

/// Integer cell arrays that mean a region or an entity, ours first; the others as Gmsh, meshio,
/// CGAL and FEniCS name them.
constexpr std::string_view region_names[] = {"region", "gmsh:physical", "medit:ref",
                                             "CellEntityIds", "cell_tags"};
constexpr std::string_view entity_names[] = {"entity", "gmsh:geometrical"};
constexpr std::string_view point_region_names[] = {"point_region"};
constexpr std::string_view id_names[] = {"source_cell_id", "source_tetrahedron_id"};

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

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

template <class Value>
void append(std::vector<Value>& to, const std::vector<std::int64_t>& values, const VtkPiece& piece,
            int dimension) {
  for (std::size_t c = 0; c < piece.list_of_cell.size(); ++c) {
    if (piece.list_of_cell[c] == dimension) to.push_back(static_cast<Value>(values[c]));
  }
}

void check_label(const Draft& draft, const std::vector<std::int64_t>& values, std::size_t at) {
  for (const std::int64_t value : values) {
    if (value >= std::numeric_limits<std::int32_t>::min() &&
        value <= std::numeric_limits<std::int32_t>::max()) {
      continue;
    }
    fail(draft.text, at,
         {.code = "number_out_of_range",
          .text = fmt::format("region {} has more than 32 bits", value),
          .remedy = "number the regions from -2147483648 to 2147483647"});
  }
}

/// Appends the rows `picked` of `column` to the column of that name. What earlier pieces lack is
/// found out at the end.
void append_data(std::vector<DataColumn>& columns, const DataColumn& column,
                 const std::vector<std::size_t>& picked) {
  const auto found = std::ranges::find(columns, column.name, &DataColumn::name);
  DataColumn* to = found == columns.end() ? nullptr : &*found;
  if (to == nullptr) {
    columns.push_back({column.name, column.components, column.type, {}});
    to = &columns.back();
    if (column.values.index() == 1) to->values = std::vector<std::int64_t>{};
  }
  if (to->components != column.components || to->values.index() != column.values.index()) return;
  std::visit(
      [&](auto& out) {
        const auto& in = std::get<std::remove_reference_t<decltype(out)>>(column.values);
        for (const std::size_t row : picked) {
          const auto first = in.begin() + static_cast<std::ptrdiff_t>(row * column.components);
          out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(column.components));
        }
      },
      to->values);
}

std::size_t length_of(const DataColumn& column) {
  return std::visit([](const auto& v) { return v.size(); }, column.values);
}

void drop_incomplete(Draft& draft, std::vector<DataColumn>& columns, std::size_t rows) {
  std::erase_if(columns, [&](const DataColumn& column) {
    if (length_of(column) == rows * column.components) return false;
    draft.findings.push_back(
        {.code = "column_incomplete",
         .severity = Severity::warning,
         .text = fmt::format("the data {} are not given alike in all pieces: left out",
                             in_quotes(column.name)),
         .remedy = "write the file again, with this array in every piece or as one piece"});
    return true;
  });
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
    const std::int64_t size = cells.ends[c] - before;
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
  std::size_t begin = 0;
  piece.list_of_cell.reserve(cells.types.size());
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const CellType& type = cell_type(draft, cells.types[c], at);
    const auto end = static_cast<std::size_t>(cells.ends[c]);
    piece.list_of_cell.push_back(static_cast<std::int8_t>(type.is_simplex ? type.dimension : -1));
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

void add_vtk_cell_column(Draft& draft, const VtkPiece& piece, const DataColumn& column,
                         std::size_t at) {
  const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values);
  const bool is_scalar = integers != nullptr && column.components == 1;
  const bool is_region = is_scalar && is_one_of(region_names, column.name);
  const bool is_entity = is_scalar && is_one_of(entity_names, column.name);
  if (is_region || is_entity) check_label(draft, *integers, at);
  std::array<std::vector<std::size_t>, 4> picked;
  for (std::size_t c = 0; c < piece.list_of_cell.size(); ++c) {
    if (piece.list_of_cell[c] >= 0) {
      picked[static_cast<std::size_t>(piece.list_of_cell[c])].push_back(c);
    }
  }
  for_each_cell_list(draft.mesh, [&](auto& cells, int dimension) {
    const auto& rows = picked[static_cast<std::size_t>(dimension)];
    if (rows.empty()) return;
    const std::size_t before = cells.corners.size() - rows.size();
    if (is_region && cells.region.size() == before) {
      append(cells.region, *integers, piece, dimension);
    } else if (is_entity && cells.entity.size() == before) {
      append(cells.entity, *integers, piece, dimension);
    } else if (is_scalar && is_one_of(id_names, column.name)) {
      append(cells.source_id, *integers, piece, dimension);
    } else {
      append_data(cells.data, column, rows);
    }
  });
}

void add_vtk_point_column(Draft& draft, const VtkPiece& piece, DataColumn&& column,
                          std::size_t at) {
  FileMesh& mesh = draft.mesh;
  auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values);
  const bool is_scalar = integers != nullptr && column.components == 1;
  if (is_scalar && column.name == "source_point_id") {
    mesh.source_point_id.insert(mesh.source_point_id.end(), integers->begin(), integers->end());
    return;
  }
  if (is_scalar && is_one_of(point_region_names, column.name)) {
    check_label(draft, *integers, at);
    mesh.point_region.insert(mesh.point_region.end(), integers->begin(), integers->end());
    return;
  }
  if (piece.first_point == 0) {  // the usual file of one piece: nothing is copied
    const bool is_new =
        std::ranges::find(mesh.point_data, column.name, &DataColumn::name) == mesh.point_data.end();
    if (is_new) return mesh.point_data.push_back(std::move(column));
  }
  std::vector<std::size_t> rows(piece.points);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  append_data(mesh.point_data, column, rows);
}

namespace {

/// What a writer had to put where cells of some dimension have no such column.
void drop_fillings(FileMesh& mesh) {
  int kinds = 0;
  for_each_cell_list(mesh, [&](const auto& cells, int) { kinds += !cells.corners.empty(); });
  if (kinds < 2) return;
  const auto drop_zeros = [](auto& labels) {
    if (std::ranges::all_of(labels, [](auto x) { return x == 0; })) labels.clear();
  };
  for_each_cell_list(mesh, [&](auto& cells, int) {
    drop_zeros(cells.region);
    drop_zeros(cells.entity);
    drop_zeros(cells.source_id);
    std::erase_if(cells.data, [](const DataColumn& column) {
      const auto* const values = std::get_if<std::vector<double>>(&column.values);
      return values != nullptr && std::ranges::all_of(*values, [](double x) { return x != x; });
    });
  });
}

}  // namespace

void finish_vtk_columns(Draft& draft) {
  FileMesh& mesh = draft.mesh;
  if (mesh.source_point_id.size() != mesh.points.size()) mesh.source_point_id.clear();
  if (mesh.point_region.size() != mesh.points.size()) mesh.point_region.clear();
  drop_incomplete(draft, mesh.point_data, mesh.points.size());
  for_each_cell_list(mesh, [&](auto& cells, int) {
    const std::size_t rows = cells.corners.size();
    if (cells.region.size() != rows) cells.region.clear();
    if (cells.entity.size() != rows) cells.entity.clear();
    if (cells.source_id.size() != rows) cells.source_id.clear();
    drop_incomplete(draft, cells.data, rows);
  });
  drop_fillings(mesh);
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
  grid.point_data.insert(grid.point_data.end(), mesh.point_data.begin(), mesh.point_data.end());
  return grid;
}

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// Between VTK's one list of cells of any type and ours by kind.
#include "topology/io/vtk/vtk_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "topology/base/sort_unique.hpp"
#include "topology/io/text/scan.hpp"
#include "topology/mesh/kinds/column_order.hpp"

namespace sunder::io {
namespace {

constexpr std::int8_t no_kind = -1;
constexpr std::int8_t place(CellKind kind) { return static_cast<std::int8_t>(kind); }

/// VTK's cell types: number, plural name, dimension (vtkCellType.h).
struct CellType {
  std::int64_t number;
  std::string_view name;
  int dimension;
  /// The kind of the cell, or the kind with corners that are its first points.
  std::int8_t kind = no_kind;
  /// Whether it has more points than the kind.
  bool is_higher = false;
};
constexpr CellType cell_types[] = {
    {0, "empty cells", 0},
    {1, "vertices", 0, place(CellKind::vertex)},
    {2, "poly-vertices", 0},
    {3, "lines", 1, place(CellKind::edge)},
    {4, "polylines", 1},
    {5, "triangles", 2, place(CellKind::triangle)},
    {6, "triangle strips", 2},
    {7, "polygons", 2, place(CellKind::polygon)},
    {8, "pixels", 2, place(CellKind::quad4)},
    {9, "quadrilaterals", 2, place(CellKind::quad4)},
    {10, "tetrahedra", 3, place(CellKind::tetrahedron)},
    {11, "voxels", 3, place(CellKind::hexahedron8)},
    {12, "hexahedra", 3, place(CellKind::hexahedron8)},
    {13, "wedges", 3, place(CellKind::prism6)},
    {14, "pyramids", 3, place(CellKind::pyramid5)},
    {15, "pentagonal prisms", 3},
    {16, "hexagonal prisms", 3},
    {21, "quadratic edges", 1, place(CellKind::edge3)},
    {22, "quadratic triangles", 2, place(CellKind::triangle6)},
    {23, "quadratic quadrilaterals", 2, place(CellKind::quad8)},
    {24, "quadratic tetrahedra", 3, place(CellKind::tetrahedron10)},
    {25, "quadratic hexahedra", 3, place(CellKind::hexahedron20)},
    {26, "quadratic wedges", 3, place(CellKind::prism15)},
    {27, "quadratic pyramids", 3, place(CellKind::pyramid13)},
    {28, "biquadratic quadrilaterals", 2, place(CellKind::quad9)},
    {29, "triquadratic hexahedra", 3, place(CellKind::hexahedron27)},
    {30, "quadratic-linear quadrilaterals", 2, place(CellKind::quad4), true},
    {31, "quadratic-linear wedges", 3, place(CellKind::prism6), true},
    {32, "biquadratic-quadratic wedges", 3, place(CellKind::prism18)},
    {33, "biquadratic-quadratic hexahedra", 3, place(CellKind::hexahedron8), true},
    {34, "biquadratic triangles", 2, place(CellKind::triangle7)},
    {35, "cubic lines", 1, place(CellKind::edge), true},
    {36, "quadratic polygons", 2},
    {37, "triquadratic pyramids", 3, place(CellKind::pyramid5), true},
    {41, "convex point sets", 3},
    {42, "polyhedra", 3},
    {68, "Lagrange curves", 1, place(CellKind::edge), true},
    {69, "Lagrange triangles", 2, place(CellKind::triangle), true},
    {70, "Lagrange quadrilaterals", 2, place(CellKind::quad4), true},
    {71, "Lagrange tetrahedra", 3, place(CellKind::tetrahedron), true},
    {72, "Lagrange hexahedra", 3, place(CellKind::hexahedron8), true},
    {73, "Lagrange wedges", 3, place(CellKind::prism6), true},
    {74, "Lagrange pyramids", 3, place(CellKind::pyramid5), true},
    {75, "Bezier curves", 1, place(CellKind::edge), true},
    {76, "Bezier triangles", 2, place(CellKind::triangle), true},
    {77, "Bezier quadrilaterals", 2, place(CellKind::quad4), true},
    {78, "Bezier tetrahedra", 3, place(CellKind::tetrahedron), true},
    {79, "Bezier hexahedra", 3, place(CellKind::hexahedron8), true},
    {80, "Bezier wedges", 3, place(CellKind::prism6), true},
    {81, "Bezier pyramids", 3, place(CellKind::pyramid5), true},
};
constexpr std::int64_t poly_vertex_type = 2, polyline_type = 4, strip_type = 6, polygon_type = 7,
                       pixel_type = 8, voxel_type = 11;

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

/// How many points a cell has, of higher ones at least.
std::size_t fewest_points(const CellType& type) {
  return type.kind == no_kind ? 0 : traits_of(static_cast<CellKind>(type.kind)).nodes;
}

/// The kind of a cell with so many points; no_kind for those that are left out.
std::int8_t kind_of(const CellType& type, std::size_t points) {
  if (type.number == polygon_type)
    return points < 3 || points > most_corners ? no_kind : place(kind_of_face(points));
  return type.kind;
}

/// The result of reading a cell: one cell of a kind, or several parts that it is cut into; no_kind
/// if it is left out.
struct Parts {
  std::int8_t kind = no_kind;
  std::size_t count = 1;
};

Parts parts_of(const CellType& type, std::size_t points) {
  const auto cut = [points](CellKind kind) {
    const std::size_t nodes = traits_of(kind).nodes;
    return points < nodes ? Parts{} : Parts{place(kind), points - nodes + 1};
  };
  if (type.number == poly_vertex_type) return cut(CellKind::vertex);
  if (type.number == polyline_type) return cut(CellKind::edge);
  if (type.number == strip_type) return cut(CellKind::triangle);
  return {kind_of(type, points), 1};
}

bool is_cut(std::int64_t type) {
  return type == poly_vertex_type || type == polyline_type || type == strip_type;
}

/// Parts that no real body has, of points that repeat, would fill memory.
void check_parts(const Draft& draft, const VtkPiece& piece, std::size_t at) {
  constexpr std::size_t always = 1000, most_a_point = 8;
  if (piece.more_parts <= always || piece.more_parts / most_a_point <= piece.points) return;
  fail(draft.text, at,
       {.code = "count_too_big",
        .text = fmt::format("strips and polylines have {} parts on {} points", piece.more_parts,
                            piece.points),
        .remedy = "save the surface as triangles"});
}

}  // namespace

void count_copies(const Draft& draft, VtkPiece& piece, std::size_t components, std::size_t at) {
  if (piece.more_parts == 0 || components == 0) return;
  if (piece.more_parts <= piece.copies_left / components) {
    piece.copies_left -= piece.more_parts * components;
    return;
  }
  fail(draft.text, at,
       {.code = "count_too_big",
        .text = fmt::format("the data of strips and polylines are too many to be given to each of "
                            "their {} parts",
                            piece.more_parts),
        .remedy = "save the surface as triangles, or with fewer data"});
}

void check_vtk_cells(const VtkCells& cells, std::string_view text, std::size_t at) {
  std::int64_t before = 0;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    // Numbers of a file: their difference may need more than 64 bits.
    const std::int64_t size = cells.ends[c] < before ? -1 : cells.ends[c] - before;
    const auto* const type = std::ranges::find(cell_types, cells.types[c], &CellType::number);
    const bool is_known = type != std::end(cell_types);
    const auto fewest = static_cast<std::int64_t>(is_known ? fewest_points(*type) : 0);
    const bool is_exact = is_known && fewest > 0 && !type->is_higher;
    if (size < 0 || size < fewest || (is_exact && size != fewest)) {
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
  if (cells.types.empty()) return;
  piece.cells.resize(cell_kinds);
  piece.first_cell.resize(cell_kinds);
  piece.list_of_cell.reserve(cells.types.size());
  const bool has_parts = std::ranges::any_of(cells.types, is_cut);
  if (has_parts) piece.parts_of_cell.reserve(cells.types.size());
  std::size_t begin = 0;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const auto end = static_cast<std::size_t>(cells.ends[c]);
    const Parts parts = parts_of(cell_type(draft, cells.types[c], at), end - begin);
    piece.list_of_cell.push_back(parts.kind);
    if (has_parts) piece.parts_of_cell.push_back(static_cast<std::uint32_t>(parts.count));
    if (parts.kind != no_kind) piece.cells[static_cast<std::size_t>(parts.kind)] += parts.count;
    piece.more_parts += parts.count - 1;
    begin = end;
  }
  constexpr std::size_t always = 16'000;
  piece.copies_left = always + cells.points.size();
  check_parts(draft, piece, at);
  for (const CellKind kind : all_cell_kinds) {
    piece.first_cell[index_of(kind)] = rows_of(draft.mesh, kind).count;
  }
  for_each_cell_list(draft.mesh, [&](auto& list, int dimension) {
    make_room(list.corners, piece.cells[index_of(simplex_of(dimension))]);
  });
  constexpr std::uint8_t rows_of_pixels[] = {0, 1, 3, 2, 4, 5, 7, 6};
  FileCell& cell = draft.cell;
  const auto take_node = [&](FileCell& to, std::size_t k, std::size_t place) {
    const std::int64_t row = cells.points[place];
    to.numbers[k] = row;
    to.rows[k] = row >= 0 && row < points ? static_cast<std::int64_t>(piece.first_point) + row : -1;
  };
  begin = 0;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const CellType& type = cell_type(draft, cells.types[c], at);
    const auto end = static_cast<std::size_t>(cells.ends[c]);
    const std::int8_t kind = piece.list_of_cell[c];
    if (kind == no_kind) {
      add_other_cells(draft, type.name, type.dimension, 1, at);
    } else if (is_cut(type.number)) {
      const auto part = static_cast<CellKind>(kind);
      const std::size_t nodes = traits_of(part).nodes;
      for (std::size_t first = begin; first + nodes <= end; ++first) {
        cell.begin(nodes, at);
        // Every second triangle of a strip is turned.
        const bool is_turned = nodes == 3 && (first - begin) % 2 == 1;
        for (std::size_t k = 0; k < nodes; ++k) {
          take_node(cell, k, first + (is_turned && k < 2 ? 1 - k : k));
        }
        add_cell(draft, part, cell);
      }
    } else {
      const std::size_t nodes = type.number == polygon_type ? end - begin : fewest_points(type);
      const bool is_pixel = type.number == pixel_type || type.number == voxel_type;
      cell.begin(nodes, at);
      for (std::size_t k = 0; k < nodes; ++k) {
        take_node(cell, k, begin + (is_pixel ? rows_of_pixels[k] : k));
      }
      add_cell(draft, static_cast<CellKind>(kind), cell);
      const bool is_higher = type.is_higher && end - begin > nodes;
      if (is_higher) add_curved_cells(draft, type.name, 1, at);
    }
    begin = end;
  }
}

namespace {

/// A column of integers over all cells, from one of each list; none where all lists lack it.
template <class Values>
void add_own_column(VtkGrid& grid, const FileMesh& mesh, std::string name, NumberType type,
                    Values CellColumns::*member) {
  const auto is_empty = [&](CellKind kind) { return (columns_of(mesh, kind).*member).empty(); };
  if (std::ranges::all_of(all_cell_kinds, is_empty)) return;
  std::vector<std::int64_t> values;
  values.reserve(grid.types.size());
  for (const CellKind kind : all_cell_kinds) {
    const auto& own = columns_of(mesh, kind).*member;
    own.empty() ? values.insert(values.end(), rows_of(mesh, kind).count, 0)
                : values.insert(values.end(), own.begin(), own.end());
  }
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

/// The column of a kind of cells that is `like` this one by name and components, or null.
const DataColumn* part_of(const FileMesh& mesh, CellKind kind, const DataColumn& like) {
  for (const DataColumn& c : columns_of(mesh, kind).data) {
    if (c.name == like.name && c.components == like.components) return &c;
  }
  return nullptr;
}

/// The data of all lists under their names, but those that are our own.
void add_data_columns(VtkGrid& grid, const FileMesh& mesh) {
  for (const DataColumn* const like : ordered_cell_columns(mesh)) {
    const bool is_there =
        std::ranges::find(grid.cell_data, like->name, &DataColumn::name) != grid.cell_data.end();
    if (is_there) continue;
    DataColumn column{like->name, like->components, like->type, {}};
    if (like->values.index() == 1) column.values = std::vector<std::int64_t>{};
    for (const CellKind kind : all_cell_kinds) {
      const DataColumn* const part = part_of(mesh, kind, *like);
      const std::size_t length = like->components * rows_of(mesh, kind).count;
      std::visit([&](auto& out) { append_rows(out, part, length); }, column.values);
    }
    grid.cell_data.push_back(std::move(column));
  }
}

}  // namespace

std::uint8_t vtk_type_of(CellKind kind) {
  if (kind == CellKind::quad4) return 9;  // pixels come before
  for (const CellType& type : cell_types) {
    const bool is_it = type.kind == place(kind) && !type.is_higher && type.number != voxel_type;
    if (is_it) return static_cast<std::uint8_t>(type.number);
  }
  return 0;
}

VtkGrid vtk_grid(const FileMesh& mesh) {
  VtkGrid grid;
  for (const CellKind kind : all_cell_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    grid.types.insert(grid.types.end(), rows.count, vtk_type_of(kind));
    for (std::size_t i = 0; i < rows.count; ++i) {
      const auto nodes = rows[i];
      grid.connectivity.insert(grid.connectivity.end(), nodes.begin(), nodes.end());
      grid.ends.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    }
  }
  add_own_column(grid, mesh, "region", NumberType::int32, &CellColumns::region);
  add_own_column(grid, mesh, "entity", NumberType::int32, &CellColumns::entity);
  add_own_column(grid, mesh, "source_cell_id", NumberType::int64, &CellColumns::source_id);
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
  for (const CellKind kind : all_cell_kinds) {
    const CellColumns& cells = columns_of(mesh, kind);
    if (!cells.region.empty()) of_cells["region"] = nullptr;
    if (!cells.entity.empty()) of_cells["entity"] = nullptr;
    if (!cells.source_id.empty()) of_cells["source_cell_id"] = nullptr;
  }
  for (const CellKind kind : all_cell_kinds) {
    judge_names(columns_of(mesh, kind).data, of_cells, clashes);
  }
  return clashes;
}

std::vector<std::string> vtk_fillings(const FileMesh& mesh) {
  std::vector<std::string> names;
  for (const DataColumn* const like : ordered_cell_columns(mesh)) {
    if (like->values.index() == 0) continue;
    const bool lacks = std::ranges::any_of(all_cell_kinds, [&](CellKind kind) {
      return rows_of(mesh, kind).count > 0 && part_of(mesh, kind, *like) == nullptr;
    });
    if (lacks) names.push_back(like->name);
  }
  sort_unique(names);
  return names;
}

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// Columns of one list of cells into those of the lists by kind: labels by name, data by row.
#include "topology/io/vtk/vtk_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "topology/io/text/scan.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {
namespace {

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

/// The column of that name, made where there is none; null where there is one of another kind.
template <class Value>
std::vector<Value>* column_of(std::vector<DataColumn>& columns, const VtkArrayHead& head) {
  const auto found = std::ranges::find(columns, head.name, &DataColumn::name);
  if (found == columns.end()) {
    columns.push_back({head.name, head.components, head.type, std::vector<Value>{}});
    return &std::get<std::vector<Value>>(columns.back().values);
  }
  return found->components == head.components ? std::get_if<std::vector<Value>>(&found->values)
                                              : nullptr;
}

template <class Value>
void append(std::vector<Value>& to, const std::vector<std::int64_t>& values, const VtkPiece& piece,
            CellKind kind) {
  make_room(to, piece.cells[index_of(kind)]);
  for (std::size_t c = 0; c < piece.list_of_cell.size(); ++c) {
    if (piece.list_of_cell[c] != static_cast<std::int8_t>(kind)) continue;
    to.insert(to.end(), piece.parts_of_cell.empty() ? 1 : piece.parts_of_cell[c],
              static_cast<Value>(values[c]));
  }
}

void add_point_label(Draft& draft, const VtkArrayHead& head,
                     const std::vector<std::int64_t>& values) {
  FileMesh& mesh = draft.mesh;
  if (!is_one_of(point_region_names, head.name)) {
    make_room(mesh.source_point_id, values.size());
    mesh.source_point_id.insert(mesh.source_point_id.end(), values.begin(), values.end());
    return;
  }
  check_label(draft, values, head.at);
  make_room(mesh.point_region, values.size());
  mesh.point_region.insert(mesh.point_region.end(), values.begin(), values.end());
}

std::size_t length_of(const DataColumn& column) {
  return std::visit([](const auto& v) { return v.size(); }, column.values);
}

void drop_incomplete(Draft& draft, std::vector<DataColumn>& columns, std::size_t rows) {
  std::erase_if(columns, [&](const DataColumn& column) {
    if (length_of(column) == rows * column.components) return false;
    add_counted(draft, "column_incomplete", [&] {
      return Finding{
          .severity = Severity::warning,
          .text = fmt::format("the data {} are not given alike in all pieces: left out",
                              in_quotes(column.name)),
          .remedy = "write the file again, with this array in every piece or as one piece"};
    });
    return true;
  });
}

}  // namespace

bool is_region_name(std::string_view name) { return is_one_of(region_names, name); }
bool is_entity_name(std::string_view name) { return is_one_of(entity_names, name); }
bool is_cell_id_name(std::string_view name) { return is_one_of(id_names, name); }

bool is_new_name(Draft& draft, VtkNames& names, const VtkArrayHead& head) {
  constexpr std::size_t most = 1024;
  auto& known = head.of_cells ? names.cells : names.points;
  if (known.size() >= most) {
    fail(draft.text, head.at,
         {.code = "count_too_big",
          .text =
              fmt::format("more than {} arrays of {} data", most, head.of_cells ? "cell" : "point"),
          .remedy = "leave out the arrays that are not needed, or split the file"});
  }
  if (known.insert(head.name).second) return true;
  add_counted(draft, "duplicate_name", [&] {
    return Finding{.severity = Severity::warning,
                   .text = fmt::format("a second array {} is left out", in_quotes(head.name)),
                   .remedy = "give every array its own name",
                   .line = draft.text.empty() ? 0 : line_of(draft.text, head.at)};
  });
  return false;
}

bool is_vtk_label(const VtkArrayHead& head) {
  if (is_real(head.type) || head.components != 1) return false;
  if (!head.of_cells) {
    return head.name == "source_point_id" || is_one_of(point_region_names, head.name);
  }
  return is_region_name(head.name) || is_entity_name(head.name) || is_cell_id_name(head.name);
}

void add_vtk_label(Draft& draft, VtkPiece& piece, const VtkArrayHead& head,
                   const std::vector<std::int64_t>& values) {
  if (!head.of_cells) return add_point_label(draft, head, values);
  count_copies(draft, piece, 1, head.at);
  const bool is_region = is_region_name(head.name);
  const bool is_entity = is_entity_name(head.name);
  if (is_region || is_entity) check_label(draft, values, head.at);
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t first = piece.first_cell[index_of(kind)];
    if (piece.cells[index_of(kind)] == 0) continue;
    CellColumns& cells = columns_of(draft.mesh, kind);
    if (is_region && cells.region.size() == first) {
      append(cells.region, values, piece, kind);
    } else if (is_entity && cells.entity.size() == first) {
      append(cells.entity, values, piece, kind);
    } else if (!is_region && !is_entity && cells.source_id.size() == first) {
      append(cells.source_id, values, piece, kind);
    } else if (auto* const column = column_of<std::int64_t>(cells.data, head)) {
      append(*column, values, piece, kind);
    }
  }
}

template <class Value>
VtkSink<Value> begin_vtk_data(Draft& draft, VtkPiece& piece, const VtkArrayHead& head,
                              std::size_t most_numbers) {
  VtkSink<Value> sink{.components = head.components};
  const auto begin = [&](std::vector<DataColumn>& columns, std::size_t d, std::size_t rows) {
    sink.lists[d] = column_of<Value>(columns, head);
    if (sink.lists[d] == nullptr) return;
    if (sink.lists[d]->empty()) {
      const bool fits = rows <= most_numbers / head.components;
      sink.lists[d]->reserve(fits ? rows * head.components : most_numbers);
    }
  };
  if (!head.of_cells) {
    if (piece.points > 0) begin(draft.mesh.point_data, 0, draft.mesh.points.size());
    return sink;
  }
  count_copies(draft, piece, head.components, head.at);
  sink.list_of_row = piece.list_of_cell;
  sink.parts_of_row = piece.parts_of_cell;
  for (const CellKind kind : all_cell_kinds) {
    if (piece.cells[index_of(kind)] == 0) continue;
    begin(columns_of(draft.mesh, kind).data, index_of(kind), rows_of(draft.mesh, kind).count);
  }
  return sink;
}

template VtkSink<double> begin_vtk_data(Draft&, VtkPiece&, const VtkArrayHead&, std::size_t);
template VtkSink<std::int64_t> begin_vtk_data(Draft&, VtkPiece&, const VtkArrayHead&, std::size_t);

namespace {

/// Drops the values that a writer had to fill in where cells of some kind have no such column.
void drop_fillings(FileMesh& mesh) {
  int kinds = 0;
  for (const CellKind kind : all_cell_kinds) kinds += rows_of(mesh, kind).count > 0;
  if (kinds < 2) return;
  for (const CellKind kind : all_cell_kinds) drop_filling(columns_of(mesh, kind));
}

}  // namespace

void finish_vtk_columns(Draft& draft) {
  FileMesh& mesh = draft.mesh;
  if (mesh.source_point_id.size() != mesh.points.size()) mesh.source_point_id.clear();
  if (mesh.point_region.size() != mesh.points.size()) mesh.point_region.clear();
  drop_incomplete(draft, mesh.point_data, mesh.points.size());
  for (const CellKind kind : all_cell_kinds) {
    CellColumns& cells = columns_of(mesh, kind);
    const std::size_t rows = rows_of(mesh, kind).count;
    if (cells.region.size() != rows) cells.region.clear();
    if (cells.entity.size() != rows) cells.entity.clear();
    if (cells.source_id.size() != rows) cells.source_id.clear();
    drop_incomplete(draft, cells.data, rows);
  }
  drop_fillings(mesh);
}

}  // namespace sunder::io

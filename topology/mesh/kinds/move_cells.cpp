// SPDX-License-Identifier: MIT
// Lists of cells joined: nodes, labels, numbers, data.
#include "topology/mesh/kinds/move_cells.hpp"

#include <algorithm>
#include <limits>

namespace sunder {
namespace {

template <class Value>
void append(std::vector<Value>& to, std::size_t had, std::vector<Value>&& from, std::size_t more,
            Value filling) {
  if (to.empty() && from.empty()) return;
  if (had == 0) {
    to = std::move(from);
  } else {
    to.resize(had, filling);
    to.insert(to.end(), from.begin(), from.end());
  }
  to.resize(had + more, filling);
}

void append_data(DataColumn& to, std::size_t had, DataColumn&& from, std::size_t more) {
  const std::size_t n = to.components;
  if (auto* const reals = std::get_if<std::vector<double>>(&to.values)) {
    append(*reals, had * n, std::move(std::get<std::vector<double>>(from.values)), more * n,
           std::numeric_limits<double>::quiet_NaN());
  } else {
    append(std::get<std::vector<std::int64_t>>(to.values), had * n,
           std::move(std::get<std::vector<std::int64_t>>(from.values)), more * n, std::int64_t{0});
  }
}

/// The rows of a column that went to one list.
template <class Value>
std::vector<Value> part_of(const std::vector<Value>& all, const std::vector<CellKind>& kind_of_row,
                           CellKind kind, std::size_t components = 1) {
  std::vector<Value> values;
  if (all.empty()) return values;
  values.reserve(components * static_cast<std::size_t>(std::ranges::count(kind_of_row, kind)));
  for (std::size_t i = 0; i < kind_of_row.size(); ++i) {
    if (kind_of_row[i] != kind) continue;
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(i * components);
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(components));
  }
  return values;
}

/// A column as `like`, without rows.
DataColumn column_like(const DataColumn& like) {
  DataColumn column{like.name, like.components, like.type, {}};
  if (like.values.index() == 1) column.values = std::vector<std::int64_t>{};
  return column;
}

bool has_no_number(const DataColumn& column) {
  const auto* const values = std::get_if<std::vector<double>>(&column.values);
  return values != nullptr && std::ranges::all_of(*values, [](double x) { return x != x; });
}

}  // namespace

void append_columns(CellColumns& columns, std::size_t rows, CellColumns&& others,
                    std::size_t more) {
  append(columns.region, rows, std::move(others.region), more, 0);
  append(columns.entity, rows, std::move(others.entity), more, 0);
  append(columns.source_id, rows, std::move(others.source_id), more, std::int64_t{0});
  if (rows == 0) {
    columns.data = std::move(others.data);
    return;
  }
  std::vector<bool> is_taken(others.data.size(), false);
  for (DataColumn& column : columns.data) {
    std::size_t i = 0;
    while (i < others.data.size() &&
           (is_taken[i] || others.data[i].name != column.name ||
            others.data[i].components != column.components || others.data[i].type != column.type)) {
      ++i;
    }
    const bool is_there = i < others.data.size();
    if (is_there) is_taken[i] = true;
    append_data(column, rows, is_there ? std::move(others.data[i]) : column_like(column), more);
  }
  for (std::size_t i = 0; i < others.data.size(); ++i) {
    if (is_taken[i]) continue;
    DataColumn& column = columns.data.emplace_back(column_like(others.data[i]));
    append_data(column, rows, std::move(others.data[i]), more);
  }
}

void move_cells(FileMesh& mesh, CellKind from, CellKind to) {
  const CellRows moved = rows_of(mesh, from);
  const std::size_t had = rows_of(mesh, to).count, more = moved.count;
  if (more == 0) return;
  const std::size_t nodes = traits_of(to).nodes;
  for (std::size_t i = 0; i < more; ++i) {
    const auto row = moved[i];
    append_cell(mesh, to, nodes == 0 ? row : row.first(nodes));
  }
  append_columns(columns_of(mesh, to), had, std::move(columns_of(mesh, from)), more);
  drop_cells(mesh, from);
}

void drop_cells(FileMesh& mesh, CellKind kind) {
  switch (kind) {
    case CellKind::vertex:
      mesh.vertices = {};
      return;
    case CellKind::edge:
      mesh.edges = {};
      return;
    case CellKind::triangle:
      mesh.triangles = {};
      return;
    case CellKind::tetrahedron:
      mesh.tetrahedra = {};
      return;
    default:
      other_cells(mesh, kind) = {};
  }
}

void deal_columns(FileMesh& mesh, CellColumns&& all, const std::vector<CellKind>& kind_of_row) {
  std::vector<CellKind> kinds;
  for (const CellKind kind : all_cell_kinds) {
    if (std::ranges::find(kind_of_row, kind) != kind_of_row.end()) kinds.push_back(kind);
  }
  for (const CellKind kind : kinds) {
    CellColumns& cells = columns_of(mesh, kind);
    cells.region = part_of(all.region, kind_of_row, kind);
    cells.entity = part_of(all.entity, kind_of_row, kind);
    cells.source_id = part_of(all.source_id, kind_of_row, kind);
  }
  for (DataColumn& c : all.data) {  // one after the other: there is no room for all of them twice
    for (const CellKind kind : kinds) {
      DataColumn& part =
          columns_of(mesh, kind).data.emplace_back(DataColumn{c.name, c.components, c.type, {}});
      std::visit(
          [&](const auto& values) {
            part.values = part_of(values, kind_of_row, kind, c.components);
          },
          c.values);
    }
    c = {};
  }
  for (const CellKind kind : kinds) drop_filling(columns_of(mesh, kind));
}

void drop_filling(CellColumns& cells) {
  const auto drop_zeros = [](auto& labels) {
    if (std::ranges::all_of(labels, [](auto x) { return x == 0; })) labels.clear();
  };
  drop_zeros(cells.region);
  drop_zeros(cells.entity);
  drop_zeros(cells.source_id);
  std::erase_if(cells.data, has_no_number);
}

void make_linear(FileMesh& mesh) {
  for (const CellKind kind : all_cell_kinds) {
    if (linear_kind(kind) != kind) move_cells(mesh, kind, linear_kind(kind));
  }
}

}  // namespace sunder

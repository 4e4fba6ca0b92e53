// SPDX-License-Identifier: MIT
// Cells and their columns taken row by row: the parts of twins of the code for many kinds.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include "topology/mesh/file_mesh.hpp"

namespace sunder::test {

using Rows = std::vector<std::uint32_t>;

/// `rows` of a column; where it is empty, nothing.
template <class Value>
std::vector<Value> some_of(const std::vector<Value>& all, const Rows& rows,
                           std::size_t components) {
  std::vector<Value> out;
  for (std::size_t i = 0; i < rows.size() * components && !all.empty(); ++i) {
    out.push_back(all.at(rows[i / components] * components + i % components));
  }
  return out;
}

inline std::vector<DataColumn> some_of(std::vector<DataColumn> columns, const Rows& rows) {
  for (DataColumn& c : columns) {
    std::visit([&](auto& values) { values = some_of(values, rows, c.components); }, c.values);
  }
  return columns;
}

inline CellColumns some_of(const CellColumns& cells, const Rows& rows) {
  return {some_of(cells.region, rows, 1), some_of(cells.entity, rows, 1),
          some_of(cells.source_id, rows, 1), some_of(cells.data, rows)};
}

template <class Value>
std::vector<Value> joined(std::vector<Value> a, std::size_t rows, std::vector<Value> b,
                          std::size_t more, Value filling) {
  if (a.empty() && b.empty()) return {};
  if (a.empty()) a.assign(rows, filling);
  if (b.empty()) b.assign(more, filling);
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Columns of the same name, size and type one after the other; each is used once.
inline CellColumns joined(const CellColumns& a, std::size_t rows, const CellColumns& b,
                          std::size_t more) {
  if (rows == 0) return b;
  CellColumns out{joined(a.region, rows, b.region, more, 0),
                  joined(a.entity, rows, b.entity, more, 0),
                  joined(a.source_id, rows, b.source_id, more, std::int64_t{0}),
                  {}};
  std::vector<DataColumn> left = b.data;
  const auto add = [&](const DataColumn& like, const DataColumn* first, const DataColumn* second) {
    DataColumn c{like.name, like.components, like.type, {}};
    std::visit(
        [&](const auto& sample) {
          using Values = std::decay_t<decltype(sample)>;
          const auto filling = static_cast<typename Values::value_type>(
              std::is_same_v<Values, std::vector<double>> ? std::numeric_limits<double>::quiet_NaN()
                                                          : 0);
          const auto of = [](const DataColumn* from) {
            return from == nullptr ? Values{} : std::get<Values>(from->values);
          };
          c.values =
              joined(of(first), rows * c.components, of(second), more * c.components, filling);
        },
        like.values);
    out.data.push_back(c);
  };
  for (const DataColumn& c : a.data) {
    const auto at = std::ranges::find_if(left, [&](const DataColumn& d) {
      return d.name == c.name && d.components == c.components && d.type == c.type;
    });
    add(c, &c, at == left.end() ? nullptr : &*at);
    if (at != left.end()) left.erase(at);
  }
  for (const DataColumn& c : left) add(c, nullptr, &c);
  return out;
}

inline std::vector<Rows> cells_of(const FileMesh& mesh, CellKind kind) {
  std::vector<Rows> cells;
  const CellRows rows = rows_of(mesh, kind);
  for (std::size_t i = 0; i < rows.count; ++i) cells.emplace_back(rows[i].begin(), rows[i].end());
  return cells;
}

/// Replaces the cells of a kind and their columns.
inline void put(FileMesh& mesh, CellKind kind, const std::vector<Rows>& cells,
                CellColumns columns) {
  if (kind == CellKind::vertex) mesh.vertices.corners.clear();
  if (kind == CellKind::edge) mesh.edges.corners.clear();
  if (kind == CellKind::triangle) mesh.triangles.corners.clear();
  if (kind == CellKind::tetrahedron) mesh.tetrahedra.corners.clear();
  if (!is_simplex(kind)) other_cells(mesh, kind) = {};
  for (const Rows& nodes : cells) append_cell(mesh, kind, nodes);
  columns_of(mesh, kind) = std::move(columns);
}

}  // namespace sunder::test

// SPDX-License-Identifier: MIT
// Rows of columns in a new order.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "topology/mesh/file_mesh.hpp"

namespace sunder {

/// Rows of a column with `components` numbers each, in the order of `rows`; empty ones stay empty.
template <class Value>
void take_rows(std::vector<Value>& column, const std::vector<std::uint32_t>& rows,
               std::size_t components = 1) {
  if (column.empty()) return;
  std::vector<Value> taken;
  taken.reserve(rows.size() * components);
  for (const std::uint32_t row : rows) {
    const auto first = column.begin() + static_cast<std::ptrdiff_t>(row * components);
    taken.insert(taken.end(), first, first + static_cast<std::ptrdiff_t>(components));
  }
  column = std::move(taken);
}

inline void take_rows(std::vector<DataColumn>& columns, const std::vector<std::uint32_t>& rows) {
  for (DataColumn& column : columns) {
    std::visit([&](auto& values) { take_rows(values, rows, column.components); }, column.values);
  }
}

inline void take_rows(CellColumns& cells, const std::vector<std::uint32_t>& rows) {
  take_rows(cells.region, rows);
  take_rows(cells.entity, rows);
  take_rows(cells.source_id, rows);
  take_rows(cells.data, rows);
}

/// Numbers rows that have no numbers, so that rows that move keep their original numbers.
inline void number_rows(std::vector<std::int64_t>& ids, std::size_t rows, std::size_t first) {
  if (!ids.empty()) return;
  ids.resize(rows);
  std::iota(ids.begin(), ids.end(), static_cast<std::int64_t>(first));
}

/// Points become `rows` of the old ones, and nodes of cells are renumbered by `new_row`.
void take_points(FileMesh& mesh, const std::vector<std::uint32_t>& rows,
                 const std::vector<std::uint32_t>& new_row);

/// The cells of a kind become `rows` of the old ones.
void take_cells(FileMesh& mesh, CellKind kind, const std::vector<std::uint32_t>& rows);

}  // namespace sunder

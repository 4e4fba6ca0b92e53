// SPDX-License-Identifier: MIT
// Random meshes of cells of every kind with all that may be said of them, and all of a mesh in
// words.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "topology/mesh/file_mesh.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {

/// A column of data: one of three shapes that share a name, or one of its own.
inline DataColumn random_column(std::mt19937_64& random, std::size_t rows) {
  using suite::below;
  const std::size_t which = below(random, 5);
  if (which >= 3) {
    std::vector<std::int64_t> values;
    const std::size_t components = 1 + below(random, 2);
    for (std::size_t i = 0; i < rows * components; ++i) {
      values.push_back(static_cast<std::int64_t>(below(random, 9)) - 4);
    }
    return {"a", components, which == 3 ? NumberType::int32 : NumberType::int16, values};
  }
  std::vector<double> values;
  const std::size_t components = which == 2 ? 3 : 1;
  const bool says_nothing = below(random, 4) == 0;
  for (std::size_t i = 0; i < rows * components; ++i) {
    const bool is_none = says_nothing || below(random, 3) == 0;
    values.push_back(is_none ? std::numeric_limits<double>::quiet_NaN() : suite::unit(random));
  }
  return {which == 0 ? "b" : "a", components, NumberType::float64, values};
}

/// Labels, numbers and data of `rows` cells, each by chance.
inline CellColumns random_columns(std::mt19937_64& random, std::size_t rows) {
  using suite::below;
  CellColumns cells;
  const bool has[] = {below(random, 2) == 0, below(random, 2) == 0, below(random, 2) == 0};
  const std::size_t labels = below(random, 4);  // 1: all are 0
  for (std::size_t i = 0; i < rows; ++i) {
    if (has[0]) cells.region.push_back(static_cast<std::int32_t>(below(random, labels + 1)));
    if (has[1]) cells.entity.push_back(static_cast<std::int32_t>(below(random, labels + 1)));
    if (has[2]) cells.source_id.push_back(static_cast<std::int64_t>(below(random, 900)));
  }
  for (std::size_t i = below(random, 4); i > 0; --i) {
    cells.data.push_back(random_column(random, rows));
  }
  return cells;
}

/// Cells of some kinds between `n` points, with and without optional columns.
inline FileMesh mesh_of_kinds(std::mt19937_64& random, std::size_t n = 32) {
  using suite::below;
  FileMesh mesh;
  for (std::size_t i = 0; i < n; ++i) {
    mesh.points.push_back({suite::unit(random), suite::unit(random), suite::unit(random)});
  }
  for (const CellKind kind : all_cell_kinds) {
    if (below(random, 2) == 0) continue;
    const std::size_t rows = 1 + below(random, 4);
    for (std::size_t i = 0; i < rows; ++i) {
      std::vector<std::uint32_t> nodes(n);
      std::iota(nodes.begin(), nodes.end(), 0U);
      std::shuffle(nodes.begin(), nodes.end(), random);
      nodes.resize(kind == CellKind::polygon ? 3 + below(random, 6) : traits_of(kind).nodes);
      if (below(random, 8) == 0) nodes.back() = nodes[0];
      append_cell(mesh, kind, nodes);
    }
    columns_of(mesh, kind) = random_columns(random, rows);
  }
  if (below(random, 2) == 0) mesh.point_data = random_columns(random, n).data;
  if (below(random, 2) == 0) {
    for (std::size_t i = 0; i < n; ++i)
      mesh.source_point_id.push_back(static_cast<std::int64_t>(7 * i));
  }
  if (below(random, 2) == 0) mesh.point_region = random_columns(random, n).region;
  return mesh;
}

inline std::string words(const std::vector<DataColumn>& columns) {
  std::string text;
  for (const DataColumn& c : columns) {
    text += fmt::format(" {} x {} {}:", c.name, c.components, static_cast<int>(c.type));
    std::visit(
        [&](const auto& values) {
          for (const auto x : values) text += fmt::format(" {}", x);
        },
        c.values);
  }
  return text;
}

inline std::string words(const CellColumns& cells) {
  return fmt::format("region {} entity {} id {} data{}", fmt::join(cells.region, " "),
                     fmt::join(cells.entity, " "), fmt::join(cells.source_id, " "),
                     words(cells.data));
}

/// All of a mesh: equal where two are the same, not-a-number being itself.
inline std::string words(const FileMesh& mesh) {
  std::string text = "points";
  for (const Point& p : mesh.points) text += fmt::format(" {}", fmt::join(p, ","));
  text += fmt::format("\nregion {} id {} data{}\n", fmt::join(mesh.point_region, " "),
                      fmt::join(mesh.source_point_id, " "), words(mesh.point_data));
  for (const CellKind kind : all_cell_kinds) {
    text += traits_of(kind).name;
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i)
      text += fmt::format(" ({})", fmt::join(rows[i], " "));
    text += fmt::format(" {}\n", words(columns_of(mesh, kind)));
  }
  return text;
}

}  // namespace sunder::test

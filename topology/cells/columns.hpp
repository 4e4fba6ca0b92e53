// SPDX-License-Identifier: MIT
// Columns with the rows of a map follow operations on cells and split faces, by named
// rules.
#pragma once

#include <array>
#include <concepts>
#include <vector>

#include "topology/cells/subdivide.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// Values of the children of a tetrahedron.
enum class CellRule {
  /// The value of the parent: regions, materials, component labels, densities, stresses.
  copy,
  /// A share of the parent's value by volume: masses, volumes, energies. For numbers.
  share
};

/// Value of a vertex on an edge.
enum class VertexRule {
  /// Linear interpolation between the ends of the edge: displacements, temperatures.
  ///
  /// For numbers and arrays of them.
  interpolate,
  /// The value of the nearer end, of the first one at the middle: labels, strengths.
  nearest
};

/// The earlier content of an extended column, which restores the same bytes.
template <class T>
struct ColumnBefore {
  std::size_t rows = 0;
  std::vector<std::pair<std::size_t, T>> values;
};

template <class T>
void take_back(std::vector<T>& column, const ColumnBefore<T>& before) {
  column.resize(before.rows);
  for (const auto& [row, value] : before.values) column[row] = value;
}

/// Extends a column with a row per tetrahedron. Requires: a row for each tetrahedron before the
/// operation.
template <class T>
ColumnBefore<T> extend_cells(std::vector<T>& column, const CellEdit& edit, CellRule rule) {
  ColumnBefore<T> before{column.size(), {}};
  for (std::size_t i = 0, end = 0; i < edit.cells.size(); i = end) {
    const std::size_t parent = edit.cells[i].parent.index();
    const T value = column[parent];
    before.values.emplace_back(parent, value);
    for (; end < edit.cells.size() && edit.cells[end].parent.index() == parent; ++end) {
      const auto& [child, of, share, face] = edit.cells[end];
      if (child.index() >= column.size()) column.resize(child.index() + 1);
      column[child.index()] = value;
      if constexpr (std::floating_point<T>) {
        if (rule == CellRule::share) column[child.index()] = share * value;
      }
    }
  }
  return before;
}

/// Extends a column with a row per face of each tetrahedron (4 t + p). Parts of a face get its
/// value, and faces inside the parent get `inside`. Use: crack labels and sets of faces.
template <class T>
ColumnBefore<T> extend_faces(std::vector<T>& column, const CellEdit& edit, const T& inside = {}) {
  ColumnBefore<T> before{column.size(), {}};
  for (std::size_t i = 0, end = 0; i < edit.cells.size(); i = end) {
    const std::size_t parent = edit.cells[i].parent.index();
    std::array<T, 4> values;
    for (std::size_t p = 0; p < 4; ++p) {
      values[p] = column[4 * parent + p];
      before.values.emplace_back(4 * parent + p, values[p]);
    }
    for (; end < edit.cells.size() && edit.cells[end].parent.index() == parent; ++end) {
      const ChildCell& child = edit.cells[end];
      const std::size_t first = 4 * child.tetrahedron.index();
      if (first >= column.size()) column.resize(first + 4);
      for (std::size_t q = 0; q < 4; ++q) {
        column[first + q] = child.face[q] < 4 ? values[child.face[q]] : inside;
      }
    }
  }
  return before;
}

namespace detail {

template <class T>
T between(const T& a, const T& b, double weight) {
  if constexpr (std::floating_point<T>) {
    return static_cast<T>((1 - weight) * a + weight * b);
  } else {
    T value = a;
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = between(a[i], b[i], weight);
    return value;
  }
}

template <class T>
concept Interpolated = std::floating_point<T> || requires(const T& a, double w) {
  between(a[0], a[0], w);
  a.size();
};

}  // namespace detail

/// Extends a column with a row per vertex. Requires: a row for each vertex before the operation.
template <class T>
ColumnBefore<T> extend_vertices(std::vector<T>& column, const CellEdit& edit, VertexRule rule) {
  ColumnBefore<T> before{column.size(), {}};
  for (const auto& [vertex, ends, weight] : edit.vertices) {
    const T a = column[ends[0].index()], b = column[ends[1].index()];
    T value = weight <= 0.5 ? a : b;
    if constexpr (detail::Interpolated<T>) {
      if (rule == VertexRule::interpolate) value = detail::between(a, b, weight);
    }
    if (vertex.index() >= column.size()) column.resize(vertex.index() + 1);
    column[vertex.index()] = value;
  }
  return before;
}

/// Extends a column with a row per vertex after a face split. A vertex that split has its value on
/// both sides (the rule copy). Columns of tetrahedra and of their faces stay as they are.
template <class T>
ColumnBefore<T> extend_vertices(std::vector<T>& column, const FaceSplit& split) {
  const ColumnBefore<T> before{column.size(), {}};
  for (int i = 0; i < split.vertex_count; ++i) {
    const VertexCopy& copy = split.split_vertices[static_cast<std::size_t>(i)];
    const T value = column[copy.old_row.index()];
    if (copy.new_row.index() >= column.size()) column.resize(copy.new_row.index() + 1);
    column[copy.new_row.index()] = value;
  }
  return before;
}

/// For each of `split.split_vertices`, the new row's share of the rest volume of the star.
/// Requires: the map directly after this split. O(stars).
template <Kernel K>
std::array<double, 3> parted_shares(const K& map, const FaceSplit& split);

/// Extends a column by the rule share: each side gets its share by volume, as with masses.
/// `shares`: result of `parted_shares`.
template <std::floating_point T>
ColumnBefore<T> share_vertices(std::vector<T>& column, const FaceSplit& split,
                               const std::array<double, 3>& shares) {
  ColumnBefore<T> before = extend_vertices(column, split);
  for (std::size_t i = 0; i < static_cast<std::size_t>(split.vertex_count); ++i) {
    const auto& [old_row, new_row] = split.split_vertices[i];
    const T value = column[old_row.index()];
    before.values.emplace_back(old_row.index(), value);
    column[new_row.index()] = static_cast<T>(shares[i] * value);
    column[old_row.index()] = static_cast<T>((1 - shares[i]) * value);
  }
  return before;
}

}  // namespace sunder

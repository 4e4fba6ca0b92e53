// SPDX-License-Identifier: MIT
// New row numbers for everything in a state that names a row.
#pragma once

#include <cstdint>
#include <vector>

#include "fracture/simulation/state.hpp"

namespace sunder {

/// New rows of old ones: all moved up by the same number, or each by a list.
struct RowShift {
  static constexpr std::uint32_t gone = 0xffffffffU;
  std::uint32_t by = 0;
  std::vector<std::uint32_t> to;  ///< if not empty: the new row of each old one, or `gone`

  std::uint32_t operator()(std::uint32_t row) const {
    if (row == gone) return gone;
    return to.empty() ? row + by : to[row];
  }
};

/// The shift that closes the gaps of rows without `kept`; ascending rows stay ascending.
RowShift closing_gaps(const std::vector<char>& kept);

/// Number of rows that are left.
std::size_t rows_left(const RowShift& shift, std::size_t before);

/// Row numbers of one state, by kind.
struct Renumbering {
  RowShift vertex, tetrahedron, point, component, material, motion, crack;
  RowShift tied_vertex;    ///< of `Pieces::map`, which has vertices of its own
  RowShift label, anchor;  ///< of `CrackLabels`

  VertexId of(VertexId v) const { return shifted(vertex, v); }
  TetId of(TetId t) const { return shifted(tetrahedron, t); }
  ComponentId of(ComponentId c) const { return shifted(component, c); }
  MaterialId of(MaterialId m) const { return shifted(material, m); }
  MotionId of(MotionId m) const { return shifted(motion, m); }
  CrackId of(CrackId k) const { return shifted(crack, k); }
  HalfFaceId of(HalfFaceId f) const { return of_corner(f); }
  CornerId of(CornerId c) const { return of_corner(c); }

 private:
  template <class T>
  static T shifted(const RowShift& shift, T id) {
    id.value = shift(id.value);
    return id;
  }
  /// Four of them to a tetrahedron.
  template <class T>
  T of_corner(T id) const {
    if (id.is_none()) return id;
    const std::uint32_t t = tetrahedron(id.value / 4);
    return t == RowShift::gone ? T::none() : T{4 * std::size_t{t} + id.value % 4};
  }
};

/// The rows of a map, outside of it.
struct LooseMap {
  MapRows rows;
  std::vector<TetId> incident;
};

LooseMap loose(const DenseMap& map);

/// New numbers in the rows of a map; `vertex`: of that map.
void renumber(LooseMap& map, const Renumbering& by, const RowShift& vertex);

/// New numbers in everything else of a state. Requires: no list names a row that is gone.
void renumber(SimulationState& state, const Renumbering& by);

}  // namespace sunder

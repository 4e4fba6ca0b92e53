// SPDX-License-Identifier: MIT
// Strong types for the rows of cells and for their parts inside a tetrahedron; no mesh here.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace sunder {

/// A row number that cannot be mixed up with the row of another kind of cell.
/// A default-constructed id is `none()`.
template <class Tag>
struct Id {
  std::uint32_t value = std::numeric_limits<std::uint32_t>::max();

  constexpr Id() = default;
  constexpr explicit Id(std::size_t row) : value(static_cast<std::uint32_t>(row)) {}

  static constexpr Id none() { return {}; }
  constexpr bool is_none() const { return value == std::numeric_limits<std::uint32_t>::max(); }
  constexpr std::size_t index() const { return value; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

/// Row of a vertex: an orbit of the 3-map, not a point of a file.
using VertexId = Id<struct VertexTag>;
/// Row of a tetrahedron.
using TetId = Id<struct TetTag>;
/// Connected component; ids grow and are never reused.
using ComponentId = Id<struct ComponentTag>;
/// A face seen from one tetrahedron: 4 * tetrahedron + the corner opposite to it.
using HalfFaceId = Id<struct HalfFaceTag>;
/// A vertex seen from one tetrahedron: 4 * tetrahedron + its place (0 to 3) there.
using CornerId = Id<struct CornerTag>;
/// A dart: 12 * tetrahedron + its place there (`dart_order` has the order).
using DartId = Id<struct DartTag>;

constexpr HalfFaceId half_face(TetId t, int opposite_corner) {
  return HalfFaceId{4 * t.index() + static_cast<std::size_t>(opposite_corner)};
}
constexpr TetId tetrahedron_of(HalfFaceId f) { return TetId{f.index() / 4}; }
constexpr int place_of(HalfFaceId f) { return static_cast<int>(f.index() % 4); }

constexpr CornerId corner(TetId t, int place) {
  return CornerId{4 * t.index() + static_cast<std::size_t>(place)};
}
constexpr TetId tetrahedron_of(CornerId c) { return TetId{c.index() / 4}; }
constexpr int place_of(CornerId c) { return static_cast<int>(c.index() % 4); }

/// The places of the two ends of each of the six edges of a tetrahedron.
inline constexpr std::array<std::array<int, 2>, 6> edge_ends = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Place of the edge between the corners at places `i` and `j` (i != j).
constexpr int edge_between(int i, int j) {
  const int low = i < j ? i : j, high = i + j - low;
  return low == 0 ? high - 1 : low + high;
}

}  // namespace sunder

template <class Tag>
struct std::hash<sunder::Id<Tag>> {
  std::size_t operator()(sunder::Id<Tag> id) const noexcept { return id.index(); }
};

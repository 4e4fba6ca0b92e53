// SPDX-License-Identifier: MIT
// The kinds of cells that mesh files hold, as a table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace sunder {

/// Kinds of cells in the order of their dimension. Within a shape, fewer nodes come first.
enum class CellKind : std::uint8_t {
  vertex,
  edge,
  edge3,
  triangle,
  triangle6,
  triangle7,
  quad4,
  quad8,
  quad9,
  polygon,
  tetrahedron,
  tetrahedron10,
  hexahedron8,
  hexahedron20,
  hexahedron27,
  prism6,
  prism15,
  prism18,
  pyramid5,
  pyramid13,
  pyramid14
};
inline constexpr std::size_t cell_kinds = 21;

constexpr std::size_t index_of(CellKind kind) { return static_cast<std::size_t>(kind); }

/// All kinds in their order.
inline constexpr auto all_cell_kinds = [] {
  std::array<CellKind, cell_kinds> all{};
  for (std::size_t i = 0; i < cell_kinds; ++i) all[i] = static_cast<CellKind>(i);
  return all;
}();

/// Properties of a kind. Nodes stand in VTK's order: corners, then midpoints of edges, of faces,
/// and of the cell. Prisms follow Gmsh and meshio: if the volume is positive, the normal of the
/// first three corners points to the other three.
struct CellKindTraits {
  /// Name of one cell and of several, as messages print them.
  std::string_view name, plural;
  int dimension;
  /// 0 for polygons, because their number varies.
  std::size_t corners, nodes;
  /// The same shape with only the first nodes; the kind itself if there is no such kind.
  CellKind lower;
};
inline constexpr CellKindTraits cell_kind_traits[cell_kinds] = {
    {"vertex", "vertices", 0, 1, 1, CellKind::vertex},
    {"edge", "edges", 1, 2, 2, CellKind::edge},
    {"second-order edge", "second-order edges", 1, 2, 3, CellKind::edge},
    {"triangle", "triangles", 2, 3, 3, CellKind::triangle},
    {"second-order triangle", "second-order triangles", 2, 3, 6, CellKind::triangle},
    {"7-node triangle", "7-node triangles", 2, 3, 7, CellKind::triangle6},
    {"quadrilateral", "quadrilaterals", 2, 4, 4, CellKind::quad4},
    {"8-node quadrilateral", "8-node quadrilaterals", 2, 4, 8, CellKind::quad4},
    {"9-node quadrilateral", "9-node quadrilaterals", 2, 4, 9, CellKind::quad8},
    {"polygon", "polygons", 2, 0, 0, CellKind::polygon},
    {"tetrahedron", "tetrahedra", 3, 4, 4, CellKind::tetrahedron},
    {"second-order tetrahedron", "second-order tetrahedra", 3, 4, 10, CellKind::tetrahedron},
    {"hexahedron", "hexahedra", 3, 8, 8, CellKind::hexahedron8},
    {"20-node hexahedron", "20-node hexahedra", 3, 8, 20, CellKind::hexahedron8},
    {"27-node hexahedron", "27-node hexahedra", 3, 8, 27, CellKind::hexahedron20},
    {"prism", "prisms", 3, 6, 6, CellKind::prism6},
    {"15-node prism", "15-node prisms", 3, 6, 15, CellKind::prism6},
    {"18-node prism", "18-node prisms", 3, 6, 18, CellKind::prism15},
    {"pyramid", "pyramids", 3, 5, 5, CellKind::pyramid5},
    {"13-node pyramid", "13-node pyramids", 3, 5, 13, CellKind::pyramid5},
    {"14-node pyramid", "14-node pyramids", 3, 5, 14, CellKind::pyramid13},
};

constexpr const CellKindTraits& traits_of(CellKind kind) {
  return cell_kind_traits[index_of(kind)];
}

/// True for vertices, edges, triangles and tetrahedra. They have lists of their own.
constexpr bool is_simplex(CellKind kind) {
  return kind == CellKind::vertex || kind == CellKind::edge || kind == CellKind::triangle ||
         kind == CellKind::tetrahedron;
}

/// The kind of first order with the same corners.
constexpr CellKind linear_kind(CellKind kind) {
  while (traits_of(kind).lower != kind) kind = traits_of(kind).lower;
  return kind;
}

/// The simplex of a dimension.
constexpr CellKind simplex_of(int dimension) {
  constexpr CellKind simplices[] = {CellKind::vertex, CellKind::edge, CellKind::triangle,
                                    CellKind::tetrahedron};
  return simplices[dimension];
}

/// A set of kinds.
using KindSet = std::uint32_t;

constexpr KindSet kind_set(std::initializer_list<CellKind> kinds) {
  KindSet set = 0;
  for (const CellKind kind : kinds) set |= KindSet{1} << index_of(kind);
  return set;
}
constexpr bool contains(KindSet set, CellKind kind) { return (set >> index_of(kind) & 1) != 0; }
inline constexpr KindSet all_kinds = (KindSet{1} << cell_kinds) - 1;

/// The first of `kind` and its lower kinds that the set contains; `kind` itself if there is none.
constexpr CellKind held_kind(KindSet set, CellKind kind) {
  for (CellKind k = kind;; k = traits_of(k).lower) {
    if (contains(set, k)) return k;
    if (traits_of(k).lower == k) return kind;
  }
}

/// Corners of a face.
using FaceCorners = std::array<std::uint8_t, 4>;
/// Corners of the faces of a volume cell of first order; empty for other kinds. The normals point
/// outward if the volume is positive. A face of three corners repeats the last one.
std::span<const FaceCorners> faces_of(CellKind linear);

/// Corners of an edge.
using EdgeCorners = std::array<std::uint8_t, 2>;
/// Corners at the ends of the edges of a kind of first order; empty for vertices and polygons. The
/// order is that of the midpoints in the kind of second order.
std::span<const EdgeCorners> edges_of(CellKind linear);

/// The kind with one more node in the middle of each edge; `kind` itself for vertices, polygons and
/// kinds of second order.
constexpr CellKind raised_kind(CellKind kind) {
  for (const CellKind k : all_cell_kinds) {
    if (k != kind && traits_of(k).lower == kind && linear_kind(kind) == kind) return k;
  }
  return kind;
}

}  // namespace sunder

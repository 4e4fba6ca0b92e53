// SPDX-License-Identifier: MIT
// Internal to topology/io: Gmsh's element types as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "topology/mesh/kinds/cell_kinds.hpp"

namespace sunder::io {

/// Gmsh's element types: number, kind, nodes (Gmsh reference manual, 9.1). Those with other nodes
/// than their kind are of higher order: their corners, which come first, are read. `name`: of
/// several of these.
struct ElementType {
  int number;
  CellKind kind;
  std::size_t nodes;
  std::string_view name = {};
};
inline constexpr ElementType element_types[] = {
    {1, CellKind::edge, 2},
    {2, CellKind::triangle, 3},
    {3, CellKind::quad4, 4},
    {4, CellKind::tetrahedron, 4},
    {5, CellKind::hexahedron8, 8},
    {6, CellKind::prism6, 6},
    {7, CellKind::pyramid5, 5},
    {8, CellKind::edge3, 3},
    {9, CellKind::triangle6, 6},
    {10, CellKind::quad9, 9},
    {11, CellKind::tetrahedron10, 10},
    {12, CellKind::hexahedron27, 27},
    {13, CellKind::prism18, 18},
    {14, CellKind::pyramid14, 14},
    {15, CellKind::vertex, 1},
    {16, CellKind::quad8, 8},
    {17, CellKind::hexahedron20, 20},
    {18, CellKind::prism15, 15},
    {19, CellKind::pyramid13, 13},
    {20, CellKind::triangle, 9, "9-node triangles"},
    {21, CellKind::triangle, 10, "third-order triangles"},
    {22, CellKind::triangle, 12, "12-node triangles"},
    {23, CellKind::triangle, 15, "fourth-order triangles"},
    {24, CellKind::triangle, 15, "15-node incomplete triangles"},
    {25, CellKind::triangle, 21, "fifth-order triangles"},
    {26, CellKind::edge, 4, "third-order edges"},
    {27, CellKind::edge, 5, "fourth-order edges"},
    {28, CellKind::edge, 6, "fifth-order edges"},
    {29, CellKind::tetrahedron, 20, "third-order tetrahedra"},
    {30, CellKind::tetrahedron, 35, "fourth-order tetrahedra"},
    {31, CellKind::tetrahedron, 56, "fifth-order tetrahedra"},
    {36, CellKind::quad4, 16, "third-order quadrilaterals"},
    {37, CellKind::quad4, 25, "fourth-order quadrilaterals"},
    {38, CellKind::quad4, 36, "fifth-order quadrilaterals"},
    {39, CellKind::quad4, 12, "12-node quadrilaterals"},
    {90, CellKind::prism6, 40, "third-order prisms"},
    {91, CellKind::prism6, 75, "fourth-order prisms"},
    {92, CellKind::hexahedron8, 64, "third-order hexahedra"},
    {93, CellKind::hexahedron8, 125, "fourth-order hexahedra"},
    {118, CellKind::pyramid5, 30, "third-order pyramids"},
    {119, CellKind::pyramid5, 55, "fourth-order pyramids"},
};

/// Whether its nodes besides the corners are no kind of ours.
constexpr bool is_curved(const ElementType& type) { return !type.name.empty(); }

/// Gmsh's type of a kind; none for polygons.
constexpr const ElementType* element_type_of(CellKind kind) {
  for (const ElementType& type : element_types) {
    if (type.kind == kind && !is_curved(type)) return &type;
  }
  return nullptr;
}

inline constexpr std::uint8_t msh_tetrahedron[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
inline constexpr std::uint8_t msh_hexahedron[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                  11, 16, 9,  17, 10, 18, 19, 12, 15,
                                                  13, 14, 24, 22, 20, 21, 23, 25, 26};
inline constexpr std::uint8_t msh_prism[] = {0, 1,  2,  3, 4,  5,  6,  8,  12,
                                             7, 13, 14, 9, 11, 10, 15, 17, 16};
inline constexpr std::uint8_t msh_pyramid[] = {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12, 13};

/// For each node as Gmsh lists it, its place in our order; empty where the two are the same.
constexpr std::span<const std::uint8_t> msh_order(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron10:
      return msh_tetrahedron;
    case CellKind::hexahedron20:
      return std::span(msh_hexahedron).first(20);
    case CellKind::hexahedron27:
      return msh_hexahedron;
    case CellKind::prism15:
      return std::span(msh_prism).first(15);
    case CellKind::prism18:
      return msh_prism;
    case CellKind::pyramid13:
      return std::span(msh_pyramid).first(13);
    case CellKind::pyramid14:
      return msh_pyramid;
    default:
      return {};
  }
}

}  // namespace sunder::io

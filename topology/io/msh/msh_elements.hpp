// SPDX-License-Identifier: MIT
// Internal to topology/io: Gmsh's element types as a table.
#pragma once

#include <cstddef>
#include <string_view>

namespace sunder::io {

/// Gmsh's element types: number, plural name, dimension, nodes (Gmsh reference manual, 9.1).
struct ElementType {
  int number;
  std::string_view name;
  int dimension;
  std::size_t nodes;
};
inline constexpr ElementType element_types[] = {
    {1, "lines", 1, 2},
    {2, "triangles", 2, 3},
    {3, "quadrangles", 2, 4},
    {4, "tetrahedra", 3, 4},
    {5, "hexahedra", 3, 8},
    {6, "prisms", 3, 6},
    {7, "pyramids", 3, 5},
    {8, "second-order lines", 1, 3},
    {9, "second-order triangles", 2, 6},
    {10, "second-order quadrangles", 2, 9},
    {11, "second-order tetrahedra", 3, 10},
    {12, "second-order hexahedra", 3, 27},
    {13, "second-order prisms", 3, 18},
    {14, "second-order pyramids", 3, 14},
    {15, "points", 0, 1},
    {16, "8-node quadrangles", 2, 8},
    {17, "20-node hexahedra", 3, 20},
    {18, "15-node prisms", 3, 15},
    {19, "13-node pyramids", 3, 13},
    {20, "9-node triangles", 2, 9},
    {21, "third-order triangles", 2, 10},
    {22, "12-node triangles", 2, 12},
    {23, "fourth-order triangles", 2, 15},
    {24, "15-node incomplete triangles", 2, 15},
    {25, "fifth-order triangles", 2, 21},
    {26, "third-order lines", 1, 4},
    {27, "fourth-order lines", 1, 5},
    {28, "fifth-order lines", 1, 6},
    {29, "third-order tetrahedra", 3, 20},
    {30, "fourth-order tetrahedra", 3, 35},
    {31, "fifth-order tetrahedra", 3, 56},
    {36, "third-order quadrangles", 2, 16},
    {37, "fourth-order quadrangles", 2, 25},
    {92, "third-order hexahedra", 3, 64},
    {93, "fourth-order hexahedra", 3, 125},
};

/// Whether it is a simplex, whose corners are its first nodes.
constexpr bool is_simplex(const ElementType& type) {
  for (const std::string_view kind : {"points", "lines", "triangles", "tetrahedra"}) {
    if (type.name.ends_with(kind)) return true;
  }
  return false;
}

/// Whether it has nodes beside its corners.
constexpr bool is_curved(const ElementType& type) {
  return is_simplex(type) && type.nodes > static_cast<std::size_t>(type.dimension) + 1;
}

/// The number of the element type of first-order simplices of a dimension.
inline constexpr int simplex_type[] = {15, 1, 2, 4};

}  // namespace sunder::io

// SPDX-License-Identifier: MIT
// Faces of volume cells, edges of all.
#include "topology/mesh/kinds/cell_kinds.hpp"

namespace sunder {
namespace {

constexpr FaceCorners of_tetrahedron[] = {{1, 2, 3, 3}, {0, 3, 2, 2}, {0, 1, 3, 3}, {0, 2, 1, 1}};
constexpr FaceCorners of_hexahedron[] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                         {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
constexpr FaceCorners of_prism[] = {
    {0, 2, 1, 1}, {3, 4, 5, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr FaceCorners of_pyramid[] = {
    {0, 3, 2, 1}, {0, 1, 4, 4}, {1, 2, 4, 4}, {2, 3, 4, 4}, {3, 0, 4, 4}};

constexpr EdgeCorners of_edge[] = {{0, 1}};
constexpr EdgeCorners of_triangle[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr EdgeCorners of_quad[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr EdgeCorners edges_of_tetrahedron[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
constexpr EdgeCorners edges_of_hexahedron[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                               {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr EdgeCorners edges_of_prism[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                          {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr EdgeCorners edges_of_pyramid[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                            {0, 4}, {1, 4}, {2, 4}, {3, 4}};

}  // namespace

std::span<const EdgeCorners> edges_of(CellKind linear) {
  switch (linear) {
    case CellKind::edge:
      return of_edge;
    case CellKind::triangle:
      return of_triangle;
    case CellKind::quad4:
      return of_quad;
    case CellKind::tetrahedron:
      return edges_of_tetrahedron;
    case CellKind::hexahedron8:
      return edges_of_hexahedron;
    case CellKind::prism6:
      return edges_of_prism;
    case CellKind::pyramid5:
      return edges_of_pyramid;
    default:
      return {};
  }
}

std::span<const FaceCorners> faces_of(CellKind linear) {
  switch (linear) {
    case CellKind::tetrahedron:
      return of_tetrahedron;
    case CellKind::hexahedron8:
      return of_hexahedron;
    case CellKind::prism6:
      return of_prism;
    case CellKind::pyramid5:
      return of_pyramid;
    default:
      return {};
  }
}

}  // namespace sunder

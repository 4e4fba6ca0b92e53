// SPDX-License-Identifier: MIT
// Thin rectangular plates with slits: grids of squares, and Delaunay sheets that know no direction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder::accuracy {

/// How the plane of a plate is cut into triangles.
enum class PlateCells {
  kuhn,      ///< squares with one diagonal, all the same way
  cross,     ///< squares with a point in the middle
  delaunay,  ///< a triangular lattice, turned and shaken
};

/// A line of edges at y = `height` from `from` to `to`, m, in the plate's plane.
struct PlateLine {
  double from = 0, to = 0, height = 0;
};

/// The box [0, length] x [0, height] x [0, layers thickness].
struct PlateShape {
  double length = 0.1, height = 0.04;  ///< m
  double cell = 0.0025;                ///< m, edge of the squares, and mean edge of Delaunay cells
  double thickness = 0.0025;           ///< m, of one layer
  int layers = 1;
  PlateCells cells = PlateCells::kuhn;
  std::uint64_t seed = 1;        ///< Delaunay: turns the lattice by any angle, and shakes it
  double shake = 0.2;            ///< Delaunay: farthest move of a point along an axis, over `cell`
  std::vector<PlateLine> lines;  ///< Delaunay: where edges have to be; grids have them if they fit
};

using Triangle = std::array<std::uint32_t, 3>;

/// Delaunay triangles of points in the plane, counterclockwise [Bowyer 1981; Watson 1981]. Flat
/// triangles on the hull are left out. O(n^2).
std::vector<Triangle> delaunay(const std::vector<std::array<double, 2>>& points);

/// The plate's tetrahedra: three per triangle and layer, the diagonals of the sides from the point
/// of lower number. Errors: throws std::runtime_error where the triangles do not fill the
/// rectangle.
TetMesh plate_mesh(const PlateShape& shape);

}  // namespace sunder::accuracy

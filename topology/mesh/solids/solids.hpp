// SPDX-License-Identifier: MIT
// Simple solids as meshes of tetrahedra: boxes, cylinders, tubes, balls.
#pragma once

#include <array>
#include <cstdint>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

// All have their middle at the origin; axes of cylinders and tubes are z. All tetrahedra are
// positive and neighbours share whole faces. Corners of the surface lie on the true surface, so
// that round solids have less volume than the true ones. The same arguments give the same bytes.
// Needs: lengths > 0, and counts of at least those named.

/// A box. `cells`: bricks along x, y and z, at least 1. Each has 6 tetrahedra around a diagonal;
/// neighbours are mirror images, so that no direction is preferred.
TetMesh box_solid(const std::array<double, 3>& size, const std::array<std::uint32_t, 3>& cells);

/// A cylinder. `rings`: rings of triangles around the axis, at least 1: 6 rings^2 of them in each
/// of `layers` layers, at least 1, and three tetrahedra above each triangle.
TetMesh cylinder_solid(double radius, double height, std::uint32_t rings, std::uint32_t layers);

/// Counts of bricks of a tube.
struct TubeCells {
  std::uint32_t through = 1;  ///< through the wall, at least 1
  std::uint32_t around = 8;   ///< even, at least 4
  std::uint32_t layers = 1;   ///< along the axis, at least 1
};

/// A tube. Each brick has 6 tetrahedra. Needs: 0 < inner < outer.
TetMesh tube_solid(double inner, double outer, double height, const TubeCells& cells);

/// A ball of `shells` shells around its centre, at least 1: 20 shells^3 tetrahedra, those of an
/// icosahedron that is divided evenly and blown up to the sphere.
TetMesh ball_solid(double radius, std::uint32_t shells);

}  // namespace sunder

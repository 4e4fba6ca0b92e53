// SPDX-License-Identifier: MIT
// Families of bodies for random runs: each draws bodies of one topology or sort, of many sizes.
#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::suite {

struct BodyFamily {
  std::string name;
  /// Its part of all fans of a run, in proportion to those of the other families.
  std::size_t share = 1;
  std::function<TetMesh(std::mt19937_64&)> draw;
};

/// Fans, stars, boxes, polycubes, rings, shells, channels, pinched bars, closed spheres, scattered
/// tetrahedra, several bodies at once; 1 to 6 000 tetrahedra, most of them below 400. Rings and
/// stars of 64 to 10 000 tetrahedra round one edge or vertex. All can be built; many are pinched,
/// some are closed or disconnected. `largest` leaves out families with bodies of possibly more
/// tetrahedra than that.
std::vector<BodyFamily> body_families(std::size_t largest);

/// The same body in another guise, at random: points moved, all names and corners permuted, some
/// tetrahedra turned inside out in the file, or everything pressed flat. None of this changes the
/// connections in the body.
TetMesh disguised(TetMesh mesh, std::mt19937_64& random);

}  // namespace sunder::suite

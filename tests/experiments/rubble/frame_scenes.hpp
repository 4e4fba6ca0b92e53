// SPDX-License-Identifier: MIT
// Scenes of rigid pieces for measurements through the library, and the figures of their frames.
#pragma once

#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "tests/experiments/rubble/outside_judge.hpp"

namespace sunder::test {

/// 200 boxes of six tetrahedra, 2 cm and up to twice as long, that cannot break, turned at random,
/// falling in a loose column on a floor; lengths times `scale`, speeds times its root.
Scene boxes_scene(unsigned seed, double scale);

/// A wall in running bond, 40 bricks by 25 courses, each of six tetrahedra that cannot break,
/// struck by a free ball of 2 kg at 6 m/s.
Scene wall_scene();

/// All tetrahedra of all pieces where they are now.
std::vector<SeenPart> seen_parts(const Simulation& sim);

/// Pieces there are, how many of them sleep, and their mass, kg.
struct PieceCount {
  std::size_t pieces = 0, asleep = 0;
  double mass = 0;
};
PieceCount count_pieces(const Simulation& sim);

/// The deepest vertex behind any plane of the scene.
struct BelowPlanes {
  double depth = 0;         ///< m; negative: none is
  std::size_t pieces = 0;   ///< with a vertex behind one by more than `allowed`
  std::uint32_t piece = 0;  ///< of the deepest
};
BelowPlanes below_planes(const Simulation& sim, double allowed);

/// Whether all places and velocities are numbers.
bool all_finite(const Simulation& sim);

}  // namespace sunder::test

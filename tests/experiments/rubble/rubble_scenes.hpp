// SPDX-License-Identifier: MIT
// Heaps of rigid bodies for measurements and tests of the rubble solver.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/rubble/rubble.hpp"

namespace sunder::test {

/// Bodies with their shapes; row 0 is the ground, z <= 0.
struct RubbleScene {
  std::vector<RubbleBody> bodies;
  std::vector<RubbleShape> shapes;
  RubbleMemory memory;
};

/// Ground alone.
RubbleScene ground(double friction = 0.5);

/// A tetrahedron of `density` kg/m^3 as a body of the solid, or of the lumped corners as the
/// simulation has it.
void add_tetrahedron(RubbleScene& scene, const std::array<Vec3, 4>& corners, double density,
                     bool lumped = true);

/// A box by centre, turn and half sides.
void add_box(RubbleScene& scene, const Vec3& centre, const Eigen::Quaterniond& turn,
             const Vec3& half, double density);

/// A ball.
void add_ball(RubbleScene& scene, const Vec3& centre, double radius, double density);

/// A block of cubes, each of six tetrahedra, all apart: its lower corner at `low`, falling at
/// `speed` m/s; turned by `seed` about its middle where that is not 0.
RubbleScene broken_block(std::array<int, 3> cubes, double cell, const Vec3& low, double speed,
                         unsigned seed = 0);

/// What somebody sees who knows places alone.
struct Overlaps {
  double deepest = 0, mean = 0;  ///< m, over all pairs of solids that touch
  double below = 0;              ///< m, deepest below z = 0
  std::size_t touching = 0;
};

/// By exact separating axes of all pairs: of tetrahedra and boxes.
Overlaps overlaps_of(const RubbleScene& scene);

/// Momentum and angular momentum about the origin, energy of motion and height (about z = 0).
struct Sums {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double kinetic = 0, potential = 0;
};
Sums sums_of(const RubbleScene& scene, const Vec3& gravity);

}  // namespace sunder::test

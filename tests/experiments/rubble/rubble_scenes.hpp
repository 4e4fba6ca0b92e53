// SPDX-License-Identifier: MIT
// Heaps of rigid bodies for measurements and tests of the rubble solver.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/rubble/rubble.hpp"
#include "tests/experiments/rubble/outside_judge.hpp"

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

/// The tetrahedra and boxes as the outside judge knows them: a body's are one piece.
std::vector<SeenPart> parts_of(const RubbleScene& scene);

/// Deepest corner of a tetrahedron or box below z = 0, m; 0: none is.
double below_ground(std::span<const SeenPart> parts);

/// Momentum and angular momentum about the origin, energy of motion and height (about z = 0).
struct Sums {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double kinetic = 0, potential = 0;
};
Sums sums_of(const RubbleScene& scene, const Vec3& gravity);

}  // namespace sunder::test

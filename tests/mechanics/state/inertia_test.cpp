// SPDX-License-Identifier: MIT
// Inertia of points against the angular momentum and energy of their turning.
#include "mechanics/state/inertia.hpp"

#include <catch2/catch.hpp>

#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("the inertia of points gives their angular momentum and energy", "[mechanics][state]") {
  std::mt19937 random(9);
  const Vec3 spin = random_vector(random);
  Mat3 inertia = Mat3::Zero();
  Vec3 momentum = Vec3::Zero();
  double energy = 0;
  for (int k = 1; k < 20; ++k) {
    const Vec3 x = random_vector(random), v = spin.cross(x);
    add_inertia(inertia, k, x);
    momentum += k * x.cross(v);
    energy += 0.5 * k * v.squaredNorm();
  }
  CHECK((inertia * spin - momentum).norm() < 1e-12 * momentum.norm());
  CHECK(0.5 * spin.dot(inertia * spin) == Approx(energy));
}

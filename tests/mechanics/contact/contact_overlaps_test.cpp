// SPDX-License-Identifier: MIT
// Pieces that spin into each other, pass each other in a step, or begin in each other.
#include "mechanics/contact/detection/contact_overlaps.hpp"

#include <catch2/catch.hpp>

#include "tests/experiments/contact/random_pairs.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A long rotor that spins about z, and a peg that its end comes to.
ContactScene rotor_and_peg(double turn_per_step, double step) {
  Body peg = kuhn_block({1, 1, 1}, {0.1, 0.1, 0.5});
  for (Vec3& x : peg.rest) x += Vec3(0, 0.45, 0);
  const SeveralBodies all = together({kuhn_block({8, 1, 1}, {1, 0.05, 0.1}), peg});
  ContactScene scene{all.body, state_of(all, material_of(1e10))};
  scene.integrator.time_step = step;
  for (std::size_t k = 0; k < 2; ++k) scene.state.components[k].rigid = true;
  place(scene.state, ComponentId{0}, {.spin = Vec3(0, 0, turn_per_step / step)});
  return scene;
}

}  // namespace

TEST_CASE("a rotor does not pass a peg, however far it turns in a step", "[mechanics][contact]") {
  const double turn = GENERATE(0.1, 0.5, 1.0, 2.0);
  INFO(turn << " rad");
  ContactScene scene = rotor_and_peg(turn, 1e-3);
  const Vec3 angular = scene.total_angular_momentum();
  double turned = 0;
  bool has_met = false;
  for (int k = 0; k < 40 && !has_met; ++k) {
    const Eigen::Quaterniond before = scene.state.components[0].orientation;
    has_met = scene.step_in_parts().report.contacts > 0;
    turned += before.angularDistance(scene.state.components[0].orientation);
  }
  CHECK(has_met);
  CHECK(turned < pi / 2 + turn);
  CHECK((scene.total_angular_momentum() - angular).norm() < 1e-9 * angular.norm());
}

TEST_CASE("a step in which pieces pass is not taken, and leaves nothing behind",
          "[mechanics][contact]") {
  ContactScene scene = rotor_and_peg(2.0, 1e-3);
  const std::vector<Vec3> before = scene.state.vertices.position;
  const Vec3 momentum = scene.state.components[0].angular_momentum;
  const ContactStepResult result = scene.step({.divides = true});
  CHECK(result.passing_way > 0);
  CHECK_FALSE(result.adopted);
  CHECK(scene.state.vertices.position == before);
  CHECK(scene.state.components[0].angular_momentum == momentum);
}

TEST_CASE("random pairs of solids do not pass each other", "[mechanics][contact]") {
  // An independent judge looks at every step (tests/experiments/contact).
  for (std::uint64_t seed = 20001; seed <= 20150; ++seed) {
    const RandomPair pair = run_random_pair(seed);
    INFO("seed " << seed << ": " << pair.kinds << ", " << pair.speed << " m/s");
    CHECK_FALSE(pair.passed);
    CHECK(pair.deepest < 0.02);
  }
}

TEST_CASE("a small plate that grazes a large cube for long does not pass it",
          "[mechanics][contact][long]") {
  // The cube is 948 times as large. Within a turn of half a radian per step a verdict takes many
  // looks.
  const RandomPair pair = run_random_pair(1043419);
  CHECK(pair.met);
  CHECK_FALSE(pair.passed);
}

// SPDX-License-Identifier: MIT
// Impulses by their source add up to the change of momentum, in scenes that have them all.
#include "fracture/simulation/momentum_ledger.hpp"

#include <catch2/catch.hpp>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

BodySettings box(const Vec3& place, const Vec3& velocity) {
  BodySettings body;
  body.mesh = suite::kuhn_box({2, 2, 2}, 0.05);
  body.translation = place;
  body.velocity = velocity;
  return body;
}

/// All of them together over a run, and what is left over.
struct Sums {
  MomentumLedger ledger;
  Vec3 loads = Vec3::Zero(), residual = Vec3::Zero();
  double passed = 0;  ///< N s, in all

  Sums(Simulation& sim, int steps) {
    const Vec3 start = momentum(sim.state->mechanics.vertices);
    for (int i = 0; i < steps; ++i) {
      const StepReport report = advance(sim);
      add_step(ledger, report.momentum);
      loads += report.load_impulse;
      passed += report.momentum.gravity.norm() + report.momentum.obstacles.norm();
    }
    residual = momentum(sim.state->mechanics.vertices) - start - ledger.gravity - ledger.obstacles -
               ledger.supports - ledger.sleep - loads;
  }
};

}  // namespace

TEST_CASE("bodies that fall, collide, rest and fall asleep: no momentum is lost unnamed",
          "[momentum]") {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.bodies.push_back(box({0, 0, 0.02}, {0, 0, 0}));
  scene.bodies.push_back(box({0.3, 0, 0.001}, {-0.4, 0, 0}));
  scene.fracture.mode = FractureMode::off;
  scene.contact.method = GENERATE(ContactMethod::impulses, ContactMethod::penalty);
  scene.contact.penalty_stiffness = 1e4;
  scene.contact.penalty_damping = 8;
  Simulation sim = built(std::move(scene));
  const Sums sums(sim, 1500);
  std::size_t asleep = 0;
  for (const Component& c : sim.state->mechanics.components) asleep += c.rung == Rung::asleep;
  CHECK(asleep == 2);
  CHECK(sums.residual.norm() < 1e-10 * sums.passed);
  CHECK(sums.ledger.supports.norm() == 0);
  CHECK(sums.ledger.obstacles.z() > 0);
}

TEST_CASE("a held body: its supports bear its weight", "[momentum]") {
  Scene scene;
  scene.bodies.push_back(box({0, 0, 1}, {0, 0, 0}));
  // kuhn_box stands with a corner at the origin of its coordinates: its lowest layer.
  scene.bodies[0].held.push_back({.minimum = {-1, -1, -1e-6}, .maximum = {1, 1, 1e-6}});
  scene.fracture.mode = FractureMode::off;
  Simulation sim = built(std::move(scene));
  const Sums sums(sim, 200);
  CHECK(sums.residual.norm() < 1e-10 * sums.passed);
  CHECK(sums.ledger.supports.z() == Approx(-sums.ledger.gravity.z()).epsilon(0.05));
}

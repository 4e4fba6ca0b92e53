// SPDX-License-Identifier: MIT
// Impulses by their source add up to the change of momentum, in scenes that have them all.
#include "fracture/simulation/ledger/momentum_ledger.hpp"

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

/// All terms together over a run, and the residual: of momentum (0) and angular momentum (3).
struct Sums {
  MomentumLedger ledger;
  Impulse residual = Impulse::Zero();
  double passed = 0, turned = 0;  ///< N s, N m s, in all

  Sums(Simulation& sim, int steps) {
    const Impulse start = total_momentum(*sim.state);
    for (int i = 0; i < steps; ++i) {
      const StepReport report = advance(sim);
      add_step(ledger, report.momentum);
      for_each_counter<MomentumLedger>([&](const auto& counter) {
        passed += (report.momentum.*counter.member).template head<3>().norm();
        turned += (report.momentum.*counter.member).template tail<3>().norm();
      });
    }
    residual = total_momentum(*sim.state) - start;
    for_each_counter<MomentumLedger>(
        [&](const auto& counter) { residual -= ledger.*counter.member; });
  }

  void check() const {
    CHECK(residual.head<3>().norm() < 1e-10 * passed);
    CHECK(residual.tail<3>().norm() < 1e-10 * turned);
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
  sums.check();
  CHECK(sums.ledger.supports.norm() == 0);
  CHECK(sums.ledger.obstacles[2] > 0);
}

TEST_CASE("a held body: its supports bear its weight", "[momentum]") {
  Scene scene;
  scene.bodies.push_back(box({0, 0, 1}, {0, 0, 0}));
  // kuhn_box stands with a corner at the origin of its coordinates: its lowest layer.
  scene.bodies[0].held.push_back({.minimum = {-1, -1, -1e-6}, .maximum = {1, 1, 1e-6}});
  scene.fracture.mode = FractureMode::off;
  Simulation sim = built(std::move(scene));
  const Sums sums(sim, 200);
  sums.check();
  CHECK(sums.ledger.supports[2] == Approx(-sums.ledger.gravity[2]).epsilon(0.05));
}

/// A heap that breaks, with a free ball and pieces that spin: every momentum is accounted for.
void check_heap(double time_step) {
  Scene scene;
  scene.integrator.time_step = time_step;
  scene.obstacles.push_back({Plane{}});
  scene.obstacles.push_back({.shape = Sphere{{0.05, 0.02, 0.4}, 0.05}, .mass = 3.0});
  scene.obstacles[1].velocity = {0, 0.3, -4};
  scene.obstacles[1].spin = {3, 1, -2};
  scene.bodies.push_back(box({0, 0, 0.02}, {0.5, 0, -3}));
  scene.bodies.push_back(box({0.02, 0.03, 0.15}, {-0.4, 0, -1}));
  scene.bodies[0].spin = {4, -7, 2};
  for (BodySettings& body : scene.bodies) body.material.tensile_strength = 2e5;
  const int steps = static_cast<int>(0.1 / scene.integrator.time_step) + 1;
  Simulation sim = built(std::move(scene));
  const Sums sums(sim, steps);
  CHECK(sim.state->mechanics.components.size() > 3);
  sums.check();
}

TEST_CASE("a heap that breaks keeps its momenta at a step of a display", "[momentum]") {
  check_heap(1.0 / 60);
}

TEST_CASE("a heap that breaks keeps its momenta at shorter steps", "[momentum][long]") {
  check_heap(GENERATE(1e-4, 1e-3, 4e-3));
}

TEST_CASE("loads on a free body that turns: their moments are named", "[momentum]") {
  Scene scene;
  scene.bodies.push_back(box({0.3, -0.2, 1}, {1, 0, 0}));
  scene.bodies[0].spin = {0, 2, 1};
  LoadBox push;
  push.minimum = {-1, -1, -1e-6};
  push.maximum = {1, 1, 1e-6};
  push.force = {20, 5, 0};
  scene.bodies[0].loads = {push};
  scene.fracture.mode = FractureMode::off;
  Simulation sim = built(std::move(scene));
  const Sums sums(sim, 200);
  CHECK(sums.residual.head<3>().norm() < 1e-10 * sums.passed);
  CHECK(sums.residual.tail<3>().norm() < 1e-6 * sums.turned);
  CHECK(sums.ledger.loads.tail<3>().norm() > 0.1);
}

// SPDX-License-Identifier: MIT
// Load curves of slow tests: forces on the obstacles that press, over how far they have come.
#include <catch2/catch.hpp>

#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A body of concrete that does not break, without friction and weight.
Scene pressed(TetMesh mesh) {
  Scene scene;
  BodySettings body;
  body.mesh = std::move(mesh);
  body.order = 1;
  scene.bodies = {body};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.contact.friction = 0;
  scene.integrator.time_step = 1e-3;
  return scene;
}

/// N along z on an obstacle, the mean over the last of so many steps.
double force_after(Scene scene, std::size_t obstacle, int steps) {
  for (Obstacle& o : scene.obstacles) o.friction = 0;
  Simulation sim = built(std::move(scene));
  sim.reports_forces = true;
  const double step = sim.scene.integrator.time_step;
  StepReport report;
  for (int k = 0; k < steps; ++k) report = advance(sim);
  return report.forces.obstacle[obstacle][2] / step;
}

}  // namespace

TEST_CASE("a block pressed between two planes bears E A times its strain", "[accuracy][contact]") {
  const double size = 0.1, speed = 0.01;
  Scene scene = pressed(suite::kuhn_box({2, 2, 4}, 0.05));
  scene.obstacles = {{.shape = Plane{}}, {.shape = Plane{-Vec3::UnitZ(), -0.2}}};
  scene.obstacles[1].velocity = {0, 0, -speed};
  const int steps = 20;
  const double force = force_after(scene, 1, steps);
  const double strain = speed * 1e-3 * steps / 0.2;
  CHECK(force == Approx(Material{}.young_modulus * size * size * strain).epsilon(1e-4));
}

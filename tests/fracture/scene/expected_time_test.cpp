// SPDX-License-Identifier: MIT
// The expected time of a run: times of contact, blows that break, and their cost.
#include "fracture/scene/expected_time.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// A cube of 0.1 m and 384 tetrahedra, `height` over a floor, which falls at `speed` (m/s).
Scene falling(double height, double speed) {
  Scene scene;
  BodySettings body;
  body.mesh = suite::kuhn_box({4, 4, 4}, 0.025);
  body.translation = {0, 0, height};
  body.velocity = {0, 0, -speed};
  scene.bodies = {body};
  scene.obstacles = {{.shape = Plane{}}};
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.duration = 1;
  return scene;
}

}  // namespace

TEST_CASE("a step in flight is expected to take time by its tetrahedra", "[fracture][expected]") {
  Scene scene = falling(1, 0);
  const double one = flight_ms(scene);
  CHECK(one > 0);
  scene.bodies.push_back(scene.bodies[0]);
  CHECK(flight_ms(scene) == Approx(2 * one).epsilon(0.2));
  scene.bodies.pop_back();
  scene.bodies[0].order = 2;
  CHECK(flight_ms(scene) > 10 * one);
}

TEST_CASE("a body that flies alone takes the time of its steps", "[fracture][expected]") {
  Scene scene = falling(1, 0);
  scene.obstacles.clear();
  const ExpectedTime flight = expected_time(scene);
  REQUIRE(flight.phases.size() == 1);
  CHECK(flight.between(0, 1) == Approx(1e-3 * flight_ms(scene) / scene.integrator.time_step));
}

TEST_CASE("a fall is expected to end where the floor is, whatever it falls on",
          "[fracture][expected]") {
  // 0.1 m at 2 m/s and gravity, to a four hundredth of the run.
  const double met = (std::sqrt(4 + 2 * 9.81 * 0.1) - 2) / 9.81;
  const auto first = [](const Scene& scene) { return expected_time(scene).phases.at(1).begin; };
  Scene scene = falling(0.1, 2);
  CHECK(first(scene) == Approx(met).margin(0.003));
  scene.obstacles = {{.shape = Box{.center = {0.05, 0.05, -0.5}, .half_extent = {1, 1, 0.5}}}};
  CHECK(first(scene) == Approx(met).margin(0.003));
  // Another body, held.
  BodySettings floor = scene.bodies[0];
  floor.translation = {0, 0, -0.1};
  floor.velocity = Vec3::Zero();
  floor.held = {{.minimum = Vec3::Constant(-1), .maximum = Vec3::Constant(1)}};
  scene.obstacles.clear();
  scene.bodies.push_back(floor);
  CHECK(first(scene) == Approx(met).margin(0.003));
  // A ball that comes from below.
  scene.bodies.pop_back();
  scene.gravity.acceleration = Vec3::Zero();
  scene.bodies[0].velocity = Vec3::Zero();
  scene.obstacles = {
      {.shape = Sphere{.center = {0.05, 0.05, -0.9}, .radius = 0.5}, .velocity = {0, 0, 2}}};
  CHECK(first(scene) == Approx(0.25).margin(0.003));
  // One that flies past meets nothing.
  scene.obstacles[0].velocity = {2, 0, 0};
  CHECK(expected_time(scene).phases.size() == 1);
}

TEST_CASE("a held body is expected to ring out after a blow that nothing repeats",
          "[fracture][expected]") {
  Scene scene = falling(0, 0);
  scene.bodies[0].held = {{.minimum = Vec3::Constant(-1), .maximum = {1, 1, 0.01}}};
  Obstacle ball{.shape = Sphere{.center = {0.05, -0.3, 0.05}, .radius = 0.05},
                .velocity = {0, 10, 0}};
  ball.mass = 1;
  scene.obstacles = {ball};
  const ExpectedTime struck = expected_time(scene);
  // The ball arrives after 25 ms.
  CHECK(struck.between(0.02, 0.03) > 4 * struck.between(0.03, 0.04));
  CHECK(struck.between(0.03, 0.04) == Approx(struck.between(0.9, 0.91)));
  // One that is driven goes on through the body for 10 ms.
  scene.obstacles[0].mass.reset();
  const ExpectedTime driven = expected_time(scene);
  CHECK(driven.between(0.03, 0.035) > 4 * struck.between(0.03, 0.035));
}

TEST_CASE("a blow above the strength is expected to take sub-steps to the end",
          "[fracture][expected]") {
  Scene scene = falling(0.1, 5);
  const double breaking = expected_time(scene).between(0, 1);
  Scene strong = scene;
  strong.bodies[0].material.tensile_strength = 1e9;
  const double whole = expected_time(strong).between(0, 1);
  CHECK(breaking > 20 * whole);
  // Bodies at rest fall asleep.
  CHECK(expected_time(strong).between(0.9, 1) == Approx(100 * 1e-3 * flight_ms(scene)));
  Scene off = scene;
  off.fracture.mode = FractureMode::off;
  CHECK(expected_time(off).between(0, 1) == Approx(whole));
  Scene rigid = scene;
  rigid.bodies[0].rigid = true;
  CHECK(expected_time(rigid).between(0, 1) < breaking / 20);
  Scene coarse = scene;
  coarse.impact.window = false;
  CHECK(expected_time(coarse).between(0, 1) < breaking / 20);
}

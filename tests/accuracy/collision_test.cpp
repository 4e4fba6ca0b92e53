// SPDX-License-Identifier: MIT
// Case 11, second half: equal bars that meet end to end swap their speeds.
#include <catch2/catch.hpp>

#include <cmath>

#include "fracture/simulation.hpp"
#include "topology/suite/shapes.hpp"

using namespace sunder;

TEST_CASE("case 11: two equal bars that meet end to end swap their speeds", "[accuracy][case11]") {
  const double speed = 0.5, length = 1;
  BodySettings left;
  left.mesh = suite::kuhn_box({20, 2, 2}, length / 20);
  left.material = {.young_modulus = 30e9, .poisson_ratio = 0};
  left.velocity = {speed, 0, 0};
  BodySettings right = left;
  right.velocity.setZero();
  right.translation = {length + 0.05, 0, 0};
  Scene scene;
  scene.bodies = {left, right};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.time_step = GENERATE(1e-4, 1e-3);
  Result<Simulation> sim = build_simulation(std::move(scene));
  REQUIRE(sim);
  const auto& components = sim->state.mechanics.components;
  const auto velocity = [&](int k) { return components[k].momentum.x() / components[k].mass; };
  const int steps = static_cast<int>(std::lround(0.15 / sim->scene.time_step));
  for (int i = 0; i < steps; ++i) REQUIRE(advance(*sim).status.outcome == StepOutcome::fine);
  INFO("step " << sim->scene.time_step << ": " << velocity(0) / speed << " and "
               << velocity(1) / speed << " of the speed");
  CHECK(velocity(0) + velocity(1) == Approx(speed).epsilon(1e-12));
  // Exactly 0 and 1; the fronts that theta and viscosity spread leave a tenth behind.
  CHECK(velocity(0) < 0.15 * speed);
  CHECK(velocity(0) > -0.02 * speed);
}

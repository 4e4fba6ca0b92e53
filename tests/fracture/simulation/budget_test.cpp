// SPDX-License-Identifier: MIT
// Budgets of fans and pieces for a span of time; waiting fans come later.
#include <catch2/catch.hpp>

#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A bar that falls on a sphere and breaks over it.
Scene breaking_scene() {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back({.name = "bar",
                          .mesh = suite::jittered(suite::kuhn_box({6, 2, 2}, 0.1), 0.01, 4),
                          .material = {.young_modulus = 1e8, .tensile_strength = 2e5},
                          .translation = {-0.3, -0.1, 0.21},
                          .velocity = {0, 0, -4}});
  scene.obstacles = {Obstacle{Sphere{{0, 0, 0.1}, 0.1}}, Obstacle{Plane{}}};
  scene.integrator.time_step = 1e-3;
  return scene;
}

/// Most fans and new pieces in any so many steps from a multiple of them, all fans, and all that
/// waited in some step.
struct Made {
  std::size_t fans = 0, pieces = 0, all = 0, waiting = 0;
};

Made run(Scene scene, std::uint64_t steps, std::uint64_t period) {
  Simulation sim = built(std::move(scene));
  Made most;
  std::size_t fans = 0, pieces = 0;
  for (std::uint64_t k = 0; k < steps; ++k) {
    if (k % period == 0) fans = pieces = 0;
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    fans += report.fracture.fans.size();
    pieces += report.new_components.size();
    most.all += report.fracture.fans.size();
    most.waiting += report.fracture.waiting;
    most.fans = std::max(most.fans, fans);
    most.pieces = std::max(most.pieces, pieces);
  }
  return most;
}

}  // namespace

TEST_CASE("a budget holds for its time, and what waits is made later", "[fracture][budget]") {
  const Made free = run(breaking_scene(), 60, 20);
  REQUIRE(free.fans > 12);
  REQUIRE(free.pieces > 4);

  Scene few = breaking_scene();
  few.fracture.mode = FractureMode::budget;
  few.fracture.max_fans = 12;
  few.fracture.budget_time = 0.02;
  const Made fans = run(few, 60, 20);
  CHECK(fans.fans == 12);
  CHECK(fans.all > 12);
  CHECK(fans.waiting > 0);

  Scene apart = breaking_scene();
  apart.fracture.mode = FractureMode::budget;
  apart.fracture.max_fans = 100000;
  apart.fracture.max_new_pieces = 2;
  apart.fracture.budget_time = 0.02;
  const Made pieces = run(apart, 60, 20);
  // Ties of one stress are made together.
  CHECK(pieces.pieces >= 2);
  CHECK(pieces.pieces <= 4);
  CHECK(pieces.waiting > 0);
}

TEST_CASE("a budget that nothing reaches changes nothing", "[fracture][budget]") {
  Scene roomy = breaking_scene();
  roomy.fracture.mode = FractureMode::budget;
  roomy.fracture.max_fans = 100000;
  roomy.fracture.budget_time = 0.02;
  Simulation a = built(breaking_scene()), b = built(roomy);
  for (int k = 0; k < 40; ++k) {
    advance(a);
    advance(b);
  }
  CHECK(a.state->fans == b.state->fans);
  CHECK(a.state->mechanics.vertices.position == b.state->mechanics.vertices.position);
}

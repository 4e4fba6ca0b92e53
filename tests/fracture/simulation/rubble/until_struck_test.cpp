// SPDX-License-Identifier: MIT
// Pieces that are rubble until a blow could break them, against pieces that deform in every step.
#include <catch2/catch.hpp>

#include <random>

#include "fracture/simulation/rubble/rubble_tick.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Two halves of a block, that came apart before, fall turned on a floor.
Scene halves(RubbleMode rubble, double speed, const Vec3& axis) {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.ladder.rubble = rubble;
  scene.integrator.time_step = 1.0 / 240;
  BodySettings block;
  block.mesh = suite::kuhn_box({4, 4, 4}, 0.02);
  block.material = {.young_modulus = 1e9, .tensile_strength = 2e5};
  block.cuts = {{.faces = CutPlane{.point = {0.04, 0, 0}, .normal = {1, 0, 0}}}};
  block.translation = {0, 0, 0.12};
  block.rotation = Eigen::AngleAxisd(0.6, axis.normalized());
  block.velocity = {0, 0, -speed};
  scene.bodies.push_back(block);
  return scene;
}

struct Outcome {
  std::size_t fans = 0, rubble_steps = 0;
  std::uint32_t struck = 0, sub_steps = 0;
  double residual = 0, moved = 0;
};

Outcome outcome_of(const Scene& scene, int steps) {
  Simulation sim = built(scene);
  REQUIRE(sim.state->mechanics.components.size() == 2);
  // A cut that is there from the start makes whole bodies; these came apart.
  sim.state->cells.labels.parent[1] = ComponentId{0};
  Outcome outcome;
  for (int k = 0; k < steps; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    outcome.fans += report.fracture.fans.size();
    outcome.struck += report.rubble.struck;
    outcome.sub_steps += report.impact.sub_steps;
    outcome.residual += std::abs(report.energy.residual);
    outcome.moved += report.energy.moved;
    for (const Component& c : sim.state->mechanics.components) {
      outcome.rubble_steps += c.rung == Rung::rubble;
    }
  }
  return outcome;
}

}  // namespace

TEST_CASE("pieces that come down slowly are rubble and open no window", "[rubble]") {
  Scene scene = halves(RubbleMode::until_struck, 0, {1, 0, 0});
  scene.bodies[0].rotation = Eigen::Quaterniond::Identity();
  scene.bodies[0].translation = {0, 0, 1e-4};
  scene.impact.negligible = 1;
  const Outcome outcome = outcome_of(scene, 40);
  CHECK(outcome.struck == 0);
  CHECK(outcome.sub_steps == 0);
  CHECK(outcome.fans == 0);
  CHECK(outcome.rubble_steps > 0);
  CHECK(outcome.residual < 1e-6 * outcome.moved);
}

TEST_CASE("a blow that breaks pieces which always deform breaks them as rubble too", "[rubble]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-1, 1);
  int broke = 0, stayed = 0;
  for (int k = 0; k < 12; ++k) {
    const double speed = 4 * std::pow(10, part(random) - 1);
    const Vec3 axis(part(random), part(random), 0.5);
    const Outcome always = outcome_of(halves(RubbleMode::off, speed, axis), 24);
    const Outcome watched = outcome_of(halves(RubbleMode::until_struck, speed, axis), 24);
    INFO("speed " << speed << " case " << k << " fans " << always.fans << " " << watched.fans);
    if (always.fans > 0) {
      CHECK(watched.fans > 0);
      CHECK(watched.struck + watched.sub_steps > 0);
    }
    broke += always.fans > 0;
    stayed += watched.fans == 0;
  }
  CHECK(broke > 2);
  CHECK(stayed > 0);
}

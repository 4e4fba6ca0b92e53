// SPDX-License-Identifier: MIT
#include "fracture/simulation/changes/actions.hpp"

#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/queries/poses.hpp"
#include "fracture/simulation/rows.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

Simulation floating(double strength = 1e9) {
  Scene scene;
  scene.bodies.push_back({.name = "bar",
                          .mesh = suite::kuhn_box({6, 2, 2}, 0.05),
                          .material = {.tensile_strength = strength},
                          .held = {}});
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-3;
  return built(std::move(scene));
}

}  // namespace

TEST_CASE("a ball that is shot gives its momentum, and its contact is an event", "[actions]") {
  Simulation sim = floating();
  REQUIRE_FALSE(shoot(sim, {{0.15, 0.05, 0.13}, 0.02}, {0, 0, -5}, 0.5));
  Vec3 impulse = Vec3::Zero();
  std::size_t events = 0;
  for (int i = 0; i < 20; ++i) {
    REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
    for (const ContactEvent& event : contact_events(sim)) {
      ++events;
      const bool ball_is_a = event.a.obstacle.has_value();
      CHECK((ball_is_a ? event.a : event.b).obstacle == 0u);
      CHECK((ball_is_a ? event.b : event.a).piece == ComponentId{0});
      CHECK(event.duration > 0);
      CHECK(event.place.z() == Approx(0.1).margin(0.02));
      impulse += ball_is_a ? event.impulse : Vec3(-event.impulse);
    }
  }
  CHECK(events > 0);
  CHECK(impulse.z() > 0);
  const PiecePose pose = piece_poses(sim).front();
  CHECK(pose.velocity.z() < -0.1);
  CHECK(pose.mass * pose.velocity.z() + 0.5 * (sim.state->obstacles[0].velocity.z() + 5) ==
        Approx(0).margin(1e-9));
}

TEST_CASE("a cut makes two pieces with poses of their own", "[actions]") {
  Simulation sim = floating();
  const auto event = cut(sim, {0.15, 0, 0}, {2, 0, 0});
  REQUIRE(event);
  CHECK(event->normal.isApprox(Vec3(1, 0, 0)));
  const std::vector<PiecePose> poses = piece_poses(sim);
  REQUIRE(poses.size() == 2);
  CHECK(poses[1].parent == poses[0].id);
  CHECK(poses[0].mass == Approx(poses[1].mass));
  for (const PiecePose& pose : poses) {
    CHECK(pose.body == 0);
    CHECK(pose.drawn.centre.isApprox(pose.rest_centre));
    CHECK(pose.reference.centre.isApprox(pose.rest_centre));
  }
  CHECK(cut(sim, {0.15, 0, 0}, {2, 0, 0}).findings.front().code == "nothing_cut");
  CHECK(cut(sim, {0.15, 0, 0}, {0, 0, 0}).findings.front().code == "bad_action");
}

TEST_CASE("a pull leads a body to its end, and forces and saved states leave it out", "[actions]") {
  Simulation sim = floating();
  sim.reports_forces = true;
  const VertexId corner{0};
  REQUIRE_FALSE(pull(sim, corner, {0.2, 0, 0}));
  const std::size_t loads = sim.state->loads.size();
  for (int i = 0; i < 600; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    REQUIRE(report.forces.load_work.empty());
  }
  CHECK(sim.state->loads.size() == loads);
  CHECK((rows_of(sim).position[0] - Vec3(0.2, 0, 0)).norm() < 0.02);
  const auto again = restore(saved_state(sim));
  REQUIRE(again);
  CHECK_FALSE(again->spring);
  release(sim);
  CHECK_FALSE(sim.spring);
}

TEST_CASE("an impossible action is refused, and nothing has changed", "[actions]") {
  Simulation sim = floating();
  const std::string before = saved_state(sim);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(shoot(sim, {{0, 0, 1}, 0}, {0, 0, -5}, 1)->code == "bad_action");
  CHECK(shoot(sim, {{0, 0, 1}, 0.1}, {0, 0, nan}, 1)->code == "bad_action");
  CHECK(shoot(sim, {{0, 0, 1}, 0.1}, {0, 0, 1}, 0)->code == "bad_action");
  CHECK(pull(sim, VertexId{1000}, {0, 0, 0})->code == "bad_action");
  CHECK(pull(sim, VertexId{0}, {0, nan, 0})->code == "bad_action");
  CHECK_FALSE(sim.spring);
  CHECK(saved_state(sim) == before);
}

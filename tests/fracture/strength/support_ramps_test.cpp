// SPDX-License-Identifier: MIT
// Supports with rising velocity: positions, velocities, waves, ledgers, cracks, states.
#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "mechanics/state/supports.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr double wide = 1e3;

/// A bar of 0.6 x 0.2 x 0.1 m that does not break, its end at x = 0.6 led at (3, 1, 0) m/s over
/// `ramp` s, whole or along x alone with z held everywhere.
Scene led_bar(double ramp, bool whole) {
  Scene scene;
  BodySettings bar{.mesh = suite::kuhn_box({6, 2, 1}, 0.1)};
  bar.material = {.young_modulus = 1e9, .poisson_ratio = 0.3, .density = 1000};
  HeldBox led{.minimum = {0.6 - 1e-6, -wide, -wide},
              .maximum = {wide, wide, wide},
              .velocity = {3, whole ? 1.0 : 0.0, 0},
              .axes = {},
              .ramp_time = ramp};
  if (!whole) {
    led.axes = {Axis::x};
    bar.held = {
        {.minimum = {-wide, -wide, -wide}, .maximum = {wide, wide, wide}, .axes = {Axis::z}}};
  }
  bar.held.push_back(led);
  scene.bodies = {bar};
  scene.fracture.mode = FractureMode::off;
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-4;
  return scene;
}

double share_of_way(double time, double ramp) {
  return time < ramp ? time * time / (2 * ramp) : time - ramp / 2;
}

bool is_led(const VertexColumns& v, std::size_t row) {
  return v.rest_position[row].x() > 0.6 - 1e-6;
}

}  // namespace

TEST_CASE("mean velocities of supports are their ways over their times",
          "[fracture][support_ramp]") {
  PrescribedMotion motion{.velocity = {7, 0, 0}};
  CHECK(mean_velocity(motion, 2, 3) == Vec3(7, 0, 0));
  motion.raised = {{{4, 0, 0}, 2.0}, {{0, 1, 0}, 0.0}};
  CHECK(mean_velocity(motion, 0, 0) == Vec3(0, 1, 0));
  CHECK(mean_velocity(motion, 0, 1) == Vec3(1, 1, 0));
  CHECK(mean_velocity(motion, 1, 1) == Vec3(2, 1, 0));
  CHECK(mean_velocity(motion, 2, 2) == Vec3(4, 1, 0));
  CHECK(mean_velocity(motion, 2, 9) == Vec3(4, 1, 0));
  CHECK((mean_velocity(motion, 1, 3) - Vec3(3.5, 1, 0)).norm() < 1e-15);
}

TEST_CASE("held vertices go where a velocity that is raised takes them, and ledgers close",
          "[fracture][support_ramp]") {
  const bool whole = GENERATE(true, false);
  const bool far_end = GENERATE(true, false);
  const bool ladder = GENERATE(true, false);
  const double ramp = 40.5e-4;
  INFO("whole " << whole << ", far end held " << far_end << ", ladder " << ladder);
  Scene scene = led_bar(ramp, whole);
  if (far_end) {
    scene.bodies[0].held.push_back(
        {.minimum = {-wide, -wide, -wide}, .maximum = {1e-6, wide, wide}});
  }
  if (!ladder) scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  Simulation sim = built(scene);
  const VertexColumns& v = sim.state->mechanics.vertices;
  const Vec3 full = scene.bodies[0].held[whole ? 0 : 1].velocity;
  double residual = 0, moved = 0;
  Impulse given = Impulse::Zero();
  const Impulse before = total_momentum(*sim.state);
  for (std::size_t row = 0; row < v.size(); ++row) CHECK(v.velocity[row].isZero(0));
  for (int k = 0; k < 100; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    residual += report.energy.residual;
    moved += report.energy.moved;
    given += report.momentum.supports + report.momentum.gravity;
    const Vec3 way = share_of_way(report.time, ramp) * full;
    const double mean =
        (share_of_way(report.time, ramp) - share_of_way(report.time - 1e-4, ramp)) / 1e-4;
    for (std::size_t row = 0; row < v.size(); ++row) {
      if (!is_led(v, row)) continue;
      const Vec3 gone = v.position[row] - v.rest_position[row];
      REQUIRE(std::abs(gone.x() - way.x()) < 1e-14);
      REQUIRE(std::abs(v.velocity[row].x() - mean * full.x()) < 1e-11);
      if (whole) REQUIRE((gone - way).norm() < 1e-14);
      if (report.time > ramp + 1e-4) REQUIRE(std::abs(v.velocity[row].x() - full.x()) < 1e-11);
    }
  }
  CHECK(moved > 1);
  CHECK(std::abs(residual) < 1e-9 * moved);
  const Impulse change = total_momentum(*sim.state) - before;
  CHECK((change - given).norm() < 1e-9 * change.norm());
}

TEST_CASE("a ramp sends its wave down a bar", "[fracture][support_ramp]") {
  // v = V (t - x / c) / T at the way x from the led end, c^2 = E / rho without cross contraction.
  Scene scene = led_bar(1e-3, true);
  BodySettings& bar = scene.bodies[0];
  bar.mesh = suite::kuhn_box({120, 1, 1}, 0.005);
  bar.material.poisson_ratio = 0;
  bar.held[0].velocity = {3, 0, 0};
  scene.integrator.time_step = 2.5e-6;
  scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  Simulation sim = built(scene);
  while (sim.state->mechanics.time < 4e-4 * (1 - 1e-9)) advance(sim);
  const VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t row = 0; row < v.size(); ++row) {
    const double late = (0.6 - v.rest_position[row].x()) / 1e3;
    const double expected = 3e3 * std::max(0.0, 4e-4 - late);
    REQUIRE(std::abs(v.velocity[row].x() - expected) < 0.02 * 1.2);
  }
}

TEST_CASE("statics go as far as a velocity that is raised does", "[fracture][support_ramp]") {
  Scene scene = led_bar(0.02, true);
  scene.bodies[0].held.push_back({.minimum = {-wide, -wide, -wide}, .maximum = {1e-6, wide, wide}});
  scene.duration = 0.03;
  Simulation sim = built(scene);
  REQUIRE(solve_scene(sim));
  const VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t row = 0; row < v.size(); ++row) {
    if (is_led(v, row)) CHECK((v.displacement[row] - 0.02 * Vec3(3, 1, 0)).norm() < 1e-12);
  }
}

TEST_CASE("a bar that a ramp tears goes on to the same bytes from any step of it",
          "[fracture][support_ramp]") {
  const CrackMode crack = GENERATE(CrackMode::cohesive, CrackMode::object, CrackMode::paper);
  Scene scene = led_bar(2e-3, false);
  BodySettings& bar = scene.bodies[0];
  bar.material = {.fracture_energy = 33};
  bar.held[1].velocity = {1, 0, 0};
  bar.held.push_back(
      {.minimum = {-wide, -wide, -wide}, .maximum = {1e-6, wide, wide}, .axes = {Axis::x}});
  bar.cuts = {{.faces = CutPlane{.point = {0.3, 0, 0}, .normal = {1, 0, 0}},
               .box = RestBox{{-1, -1, -1}, {9, 0.1 + 1e-6, 9}},
               .ball = {}}};
  scene.fracture.mode = FractureMode::all;
  scene.fracture.crack = crack;
  Simulation sim = built(scene), again = built(scene);
  const VertexColumns& v = sim.state->mechanics.vertices;
  double residual = 0, moved = 0;
  std::size_t fans = 0, in_ramp = 0, sub_steps = 0;
  for (int k = 0; k < 40; ++k) {
    const StepReport report = advance(sim), other = advance(again);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    REQUIRE(first_difference(sim, again).empty());
    CHECK(other.energy.supports == report.energy.supports);
    if (k % 3 == 0) again = std::move(*restore(saved_state(sim)));
    fans += report.fracture.fans.size();
    if (report.time < 2e-3) in_ramp += report.fracture.fans.size();
    sub_steps += report.impact.sub_steps;
    if (report.components == 1) {
      residual += report.energy.residual;
      moved += report.energy.moved;
    }
    const double way = share_of_way(report.time, 2e-3);
    for (std::size_t row = 0; row < v.size(); ++row) {
      if (!is_led(v, row)) continue;
      REQUIRE(std::abs(v.position[row].x() - v.rest_position[row].x() - way) < 1e-14);
    }
  }
  CHECK(in_ramp > 0);
  CHECK((crack == CrackMode::paper || sub_steps > 0));
  CHECK(fans > 0);
  CHECK(std::abs(residual) < 1e-9 * moved);
}

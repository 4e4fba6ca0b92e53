// SPDX-License-Identifier: MIT
// The rung rubble in a simulation: laws, sleep, its members, and the same bytes after a pause.
#include "fracture/simulation/rubble/rubble_tick.hpp"

#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/rubble/islands.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Single tetrahedra over a floor, as bodies: `count` of them in a grid, turned and thrown.
Scene chips(int count) {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.ladder.rubble = RubbleMode::certified;
  scene.integrator.time_step = 1e-3;
  const TetMesh box = suite::kuhn_box({1, 1, 1}, 0.02);
  for (int k = 0; k < count; ++k) {
    BodySettings body;
    body.mesh.points = {box.points[box.tetrahedra[0][0]], box.points[box.tetrahedra[0][1]],
                        box.points[box.tetrahedra[0][2]], box.points[box.tetrahedra[0][3]]};
    body.mesh.tetrahedra = {{0, 1, 2, 3}};
    body.translation = {0.03 * (k % 3), 0.03 * (k / 3 % 3), 0.01 + 0.03 * (k / 9)};
    body.rotation = Eigen::AngleAxisd(0.7 * k, Vec3(1, 0.3 * (k % 5), 0.2).normalized());
    body.velocity = {0.2 * (k % 2), 0.1, -0.5};
    body.spin = {1.0 * (k % 4), 2, 0};
    scene.bodies.push_back(body);
  }
  return scene;
}

/// A block that breaks when it meets the floor.
BodySettings weak_block(const Vec3& place) {
  BodySettings block;
  block.mesh = suite::kuhn_box({4, 4, 4}, 0.02);
  block.material = {.young_modulus = 1e9, .tensile_strength = 2e5};
  block.translation = place;
  block.rotation = Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized());
  block.velocity = {0, 0, -6};
  return block;
}

std::size_t on_rung(const Simulation& sim, Rung rung) {
  std::size_t count = 0;
  for (const Component& c : sim.state->mechanics.components) count += c.rung == rung;
  return count;
}

}  // namespace

TEST_CASE("a tick is the multiple or fraction of the step nearest to 1/240 s", "[rubble]") {
  CHECK(rubble_clock(2e-4).steps == 21);
  CHECK(rubble_clock(2e-4).tick == Approx(4.2e-3));
  CHECK(rubble_clock(1.0 / 240).steps == 1);
  CHECK(rubble_clock(1.0 / 240).ticks == 1);
  CHECK(rubble_clock(1.0 / 60).ticks == 4);
  CHECK(rubble_clock(1.0 / 60).tick == Approx(1.0 / 240));
  CHECK(rubble_clock(3e-3).steps == 1);
}

TEST_CASE("chips that fall on each other are rubble, keep the ledgers, and sleep", "[rubble]") {
  Simulation sim = built(chips(27));
  const Impulse start = total_momentum(*sim.state);
  Impulse given = Impulse::Zero();
  double moved = 0, left = 0, worst = 0;
  std::size_t rubble_steps = 0;
  for (int k = 0; k < 1500; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    for_each_counter<MomentumLedger>(
        [&](const auto& counter) { given += report.momentum.*counter.member; });
    moved += report.energy.moved;
    left += std::abs(report.energy.residual);
    // Some overlap at the start.
    if (k > 200) worst = std::max(worst, report.rubble.deepest);
    rubble_steps += on_rung(sim, Rung::rubble);
  }
  CHECK(rubble_steps > 27 * 300);
  CHECK(on_rung(sim, Rung::asleep) == 27);
  const Impulse residual = total_momentum(*sim.state) - start - given;
  CHECK(residual.norm() < 1e-10 * given.norm());
  CHECK(left < 1e-6 * moved);
  CHECK(worst < 2e-3);
  for (const Vec3& x : sim.state->mechanics.vertices.position) CHECK(x[2] > -1e-4);
  // Asleep nothing moves.
  const std::vector<Vec3> at = sim.state->mechanics.vertices.position;
  for (int k = 0; k < 20; ++k) CHECK(advance(sim).rubble.ticks == 0);
  CHECK(sim.state->mechanics.vertices.position == at);
}

TEST_CASE("a simulation with rubble goes on to the same bytes after a pause", "[rubble][saved]") {
  Simulation whole = built(chips(12)), paused = built(chips(12));
  paused.threads = 2;
  for (int k = 0; k < 300; ++k) {
    advance(whole);
    *paused.scratch = SimulationScratch{};
    advance(paused);
    REQUIRE(test::first_difference(whole, paused) == "");
    if (k % 7 != 3) continue;
    Result<Simulation> restored = restore(saved_state(paused));
    REQUIRE(restored);
    paused = std::move(*restored);
    paused.threads = 2;
  }
  CHECK(saved_state(whole) == saved_state(paused));
  // A clock without a row for everybody would be read beyond its end.
  for (std::vector<char> RubbleState::*rows : {&RubbleState::apart, &RubbleState::ball_apart}) {
    Result<Simulation> other = restore(saved_state(whole));
    REQUIRE(other);
    (other->state->ladder.rubble.*rows).resize(5, 0);
    const Result<Simulation> refused = restore(saved_state(*other));
    REQUIRE_FALSE(refused);
    CHECK(refused.findings[0].code == "damaged");
  }
}

TEST_CASE("an island with a piece that could break is no rubble", "[rubble]") {
  Scene scene = chips(9);
  BodySettings block;
  block.mesh = suite::kuhn_box({2, 2, 2}, 0.02);
  block.translation = {0.02, 0.02, 0.3};
  block.velocity = {0, 0, -6};
  scene.bodies.push_back(block);
  Simulation sim = built(scene);
  std::size_t mixed = 0, together = 0;
  for (int k = 0; k < 100; ++k) {
    const StepReport report = advance(sim);
    mixed += report.rubble.mixed + report.rubble.refused;
    // A piece that meets the block is not on the rung meanwhile.
    const Component& c = sim.state->mechanics.components.back();
    if (c.rung == Rung::rubble) ++together;
  }
  CHECK(mixed > 0);
  CHECK(together < 60);
}

TEST_CASE("pieces that come off within a tick have no part in its rubble", "[rubble]") {
  Scene scene = chips(9);
  scene.integrator.time_step = 5e-4;
  scene.bodies.push_back(weak_block({0.5, 0, 0.1}));
  Simulation sim = built(scene);
  const std::uint64_t steps = rubble_clock(scene.integrator.time_step).steps;
  std::size_t born = 0;
  for (int k = 0; k < 120; ++k) {
    const std::size_t before = sim.state->mechanics.components.size();
    advance(sim);
    const std::vector<char>& apart = sim.state->ladder.rubble.apart;
    const std::size_t pieces = sim.state->mechanics.components.size();
    if (apart.empty() || pieces == before) continue;
    REQUIRE(apart.size() == pieces);
    CHECK(std::count(apart.begin() + static_cast<std::ptrdiff_t>(before), apart.end(), 1) == 0);
    born += sim.state->step % steps != 0;
  }
  CHECK(born > 0);
}

TEST_CASE("a ball wakes rubble that sleeps, and is pushed back", "[rubble]") {
  Scene scene = chips(9);
  scene.obstacles.push_back(
      {.shape = Sphere{{0.03, 0.03, 6.0}, 0.15}, .velocity = {0, 0, 0}, .mass = 5});
  Simulation sim = built(scene);
  std::size_t slept = 0;
  for (int k = 0; k < 1000; ++k) {
    advance(sim);
    slept = std::max(slept, on_rung(sim, Rung::asleep));
  }
  CHECK(slept == 9);
  std::size_t still_asleep = 9;
  for (int k = 0; k < 200; ++k) {
    advance(sim);
    still_asleep = std::min(still_asleep, on_rung(sim, Rung::asleep));
  }
  CHECK(still_asleep < 9);
  const Obstacle& ball = sim.state->obstacles[1];
  CHECK(std::get<Sphere>(ball.shape).center[2] > 0.14);
  CHECK(ball.velocity[2] > -3);
}

TEST_CASE("what is declared never breaks again, and is told", "[rubble]") {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.integrator.time_step = 5e-4;
  scene.bodies.push_back(weak_block({0, 0, 0.05}));
  const auto fans_of = [&](double share) {
    scene.ladder.rubble = RubbleMode::certified;
    scene.ladder.declared_rubble = share;
    Simulation sim = built(scene);
    std::size_t fans = 0;
    std::uint32_t declared = 0;
    for (int k = 0; k < 120; ++k) {
      const StepReport report = advance(sim);
      REQUIRE(report.status.outcome == StepOutcome::fine);
      fans += report.fracture.fans.size();
      declared = std::max(declared, report.rubble.declared);
    }
    return std::pair(fans, declared);
  };
  const auto [all, none] = fans_of(0);
  const auto [fewer, some] = fans_of(0.999);
  CHECK(none == 0);
  CHECK(some > 0);
  CHECK(all > fewer);
  CHECK(fewer > 0);
}

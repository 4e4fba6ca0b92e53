// SPDX-License-Identifier: MIT
// Rigid bodies and declared pieces in the elastic contact solver: six degrees of freedom, no
// windows.
#include "fracture/simulation/rubble/rigid_pieces.hpp"

#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/scene/check_scene.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

BodySettings block(const Vec3& at, const std::array<int, 3>& cells = {2, 2, 2}) {
  BodySettings body;
  body.mesh = suite::kuhn_box(cells, 0.02);
  body.translation = at;
  return body;
}

/// A rigid block and one that can break fall on each other and on a floor, turned and spinning.
Scene falling(double speed) {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.integrator.time_step = 1e-4;
  BodySettings rigid = block({0, 0, 0.01});
  rigid.rigid = true;
  rigid.material.tensile_strength = 1;
  rigid.rotation = Eigen::AngleAxisd(0.4, Vec3(1, 0.4, 0.2).normalized());
  rigid.translation = {0, 0, 0.03};
  rigid.velocity = {0.3, 0, -speed};
  rigid.spin = {3, -2, 5};
  BodySettings soft = block({0.005, 0.003, 0.09});
  soft.material.tensile_strength = 1e12;
  soft.velocity = {0, 0, -speed};
  scene.bodies = {rigid, soft};
  return scene;
}

/// Largest change of the distance of two points of a body against the rest, over that.
double largest_strain(const Simulation& sim, std::size_t component) {
  const VertexColumns& v = sim.state->mechanics.vertices;
  const Component& c = sim.state->mechanics.components[component];
  double largest = 0;
  for (const VertexId a : c.vertices) {
    const VertexId b = c.vertices.front();
    const double rest = (v.rest_position[a.index()] - v.rest_position[b.index()]).norm();
    if (rest == 0) continue;
    const double now = (v.position[a.index()] - v.position[b.index()]).norm();
    largest = std::max(largest, std::abs(now / rest - 1));
  }
  return largest;
}

}  // namespace

TEST_CASE("a rigid body neither deforms nor breaks, and all ledgers are kept", "[rigid]") {
  const double speed = GENERATE(0.5, 8.0);
  Simulation sim = built(falling(speed));
  const Component& rigid = sim.state->mechanics.components[0];
  REQUIRE(rigid.rigid);
  REQUIRE_FALSE(sim.state->mechanics.components[1].rigid);
  const Impulse start = total_momentum(*sim.state);
  Impulse given = Impulse::Zero();
  double moved = 0, left = 0;
  for (int k = 0; k < 1200; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    CHECK(report.fracture.fans.empty());
    CHECK(report.rubble.rigid == 1);
    for_each_counter<MomentumLedger>(
        [&](const auto& counter) { given += report.momentum.*counter.member; });
    moved += report.energy.moved;
    left += std::abs(report.energy.residual);
  }
  CHECK(largest_strain(sim, 0) < 1e-12);
  CHECK(largest_strain(sim, 1) > 1e-9);
  CHECK(sim.state->mechanics.elements.stress[0].isZero(0));
  const Impulse residual = total_momentum(*sim.state) - start - given;
  CHECK(residual.norm() < 1e-10 * given.norm());
  CAPTURE(left, moved);
  CHECK(left < 1e-3 * moved);
  for (const VertexId v : sim.state->mechanics.components[0].vertices) {
    CHECK(sim.state->mechanics.vertices.position[v.index()].z() > -1e-4);
  }
}

TEST_CASE("a rigid body opens no window and has no factor", "[rigid]") {
  Scene scene = falling(8);
  scene.bodies.pop_back();
  Simulation sim = built(scene);
  std::uint32_t opened = 0;
  for (int k = 0; k < 100; ++k) opened += advance(sim).impact.opened;
  CHECK(opened == 0);
  const auto& systems = sim.state->mechanics.systems.present;
  CHECK((systems.empty() || !systems[0]));
}

TEST_CASE("a rigid block slides down an incline if and only if tan a > mu", "[rigid]") {
  const double mu = 0.4;
  const double ratio = GENERATE(0.97, 1.03);
  const double angle = std::atan(ratio * mu);
  Scene scene;
  scene.gravity.acceleration = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
  scene.obstacles.push_back({.shape = Plane{}, .friction = mu});
  scene.contact.friction = mu;
  scene.integrator.time_step = 1e-3;
  scene.ladder.sleep = false;
  BodySettings body = block({0, 0, 0});
  body.rigid = true;
  scene.bodies = {body};
  Simulation sim = built(scene);
  const double from = sim.state->mechanics.components[0].centre.x();
  for (int k = 0; k < 500; ++k) advance(sim);
  const double way = sim.state->mechanics.components[0].centre.x() - from;
  const double free = 0.5 * 0.25 * 9.81 * (std::sin(angle) - mu * std::cos(angle));
  CHECK(way == Approx(std::max(0.0, free)).margin(2e-5 + 0.02 * std::abs(free)));
}

TEST_CASE("a rigid body cannot be held", "[rigid][settings]") {
  Scene scene = falling(1);
  scene.bodies[0].held.push_back({.minimum = {0, 0, 0}, .maximum = {1, 1, 0}});
  const std::vector<SettingFinding> found = check_scene(scene);
  REQUIRE(found.size() == 1);
  CHECK(found[0].finding.code == "rigid_and_held");
  CHECK(found[0].place == "bodies.0.rigid");
}

TEST_CASE("declared pieces are rigid beside one that can break", "[rigid][rubble]") {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.integrator.time_step = 2e-4;
  scene.ladder.rubble = RubbleMode::certified;
  scene.ladder.declared_rubble = 0.4;
  // A quarter of the block is cut off before the start, and lies upon the rest.
  BodySettings body = block({0, 0, 1e-3}, {2, 2, 4});
  body.material.tensile_strength = 1e6;
  body.cuts.push_back({.faces = CutPlane{{0, 0, 0.06}, {0, 0, 1}}});
  body.velocity = {0, 0, -0.05};
  scene.bodies = {body};
  Simulation sim = built(scene);
  std::size_t rigid = 0, together = 0;
  for (const Component& c : sim.state->mechanics.components) rigid += c.rigid;
  CHECK(rigid == 1);
  const Impulse start = total_momentum(*sim.state);
  Impulse given = Impulse::Zero();
  for (int k = 0; k < 300; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    for_each_counter<MomentumLedger>(
        [&](const auto& counter) { given += report.momentum.*counter.member; });
    together += report.rubble.mixed > 0 || report.rubble.refused > 0;
    CHECK(report.rubble.declared == 1);
    CHECK(report.rubble.rigid == 1);
  }
  CHECK(together > 0);
  CHECK((total_momentum(*sim.state) - start - given).norm() < 1e-10 * given.norm());
  // It still lies upon the other.
  double lowest = 1;
  for (const Component& c : sim.state->mechanics.components) {
    if (!c.rigid) continue;
    for (const VertexId v : c.vertices) {
      lowest = std::min(lowest, sim.state->mechanics.vertices.position[v.index()].z());
    }
  }
  CHECK(lowest > 0.0598);
}

TEST_CASE("a simulation with rigid bodies goes on to the same bytes after a pause",
          "[rigid][saved]") {
  Simulation whole = built(falling(3)), paused = built(falling(3));
  for (int k = 0; k < 60; ++k) {
    advance(whole);
    *paused.scratch = SimulationScratch{};
    advance(paused);
    REQUIRE(test::first_difference(whole, paused) == "");
    if (k % 7 != 3) continue;
    Result<Simulation> restored = restore(saved_state(paused));
    REQUIRE(restored);
    paused = std::move(*restored);
  }
  CHECK(saved_state(whole) == saved_state(paused));
}

// SPDX-License-Identifier: MIT
// Boxes and meshes that move freely, meshes that are driven, and corners against large faces.
#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

Eigen::Quaterniond turn(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

BodySettings block(const Vec3& at, const std::array<int, 3>& cells = {2, 2, 2},
                   double size = 0.02) {
  BodySettings body;
  body.mesh = suite::kuhn_box(cells, size);
  body.material.tensile_strength = 1e12;
  body.translation = at;
  return body;
}

/// A box of twelve triangles about its middle.
Solid box_mesh(const Vec3& half_extent, const Vec3& center = Vec3::Zero(),
               const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity()) {
  const Shape box = Box{Vec3::Zero(), Eigen::Quaterniond::Identity(), half_extent};
  TriangleSurface s;
  for (std::uint32_t k = 0; k < 8; ++k) s.points.push_back(corner_at(box, k));
  for (const auto& f : {std::array<std::uint32_t, 4>{0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 2, 3, 1},
                        {4, 5, 7, 6}}) {
    s.triangles.push_back({f[0], f[1], f[2]});
    s.triangles.push_back({f[0], f[2], f[3]});
  }
  Result<SolidSurface> made = make_solid_surface(std::move(s));
  REQUIRE(made);
  return {std::make_shared<const SolidSurface>(std::move(*made)), center, orientation};
}

constexpr double mass = 0.4;
const Vec3 half(0.04, 0.03, 0.02);

Obstacle free_box(bool as_mesh, const Vec3& at, const Eigen::Quaterniond& orientation) {
  Obstacle o;
  o.shape = as_mesh ? Shape(box_mesh(half, at, orientation)) : Shape(Box{at, orientation, half});
  o.mass = mass;
  return o;
}

/// A block on a floor, a free box that is thrown on it, a wall.
Scene thrown(bool as_mesh) {
  Scene scene;
  scene.integrator.time_step = 5e-4;
  scene.bodies = {block({0, 0, 0})};
  scene.obstacles.push_back({Plane{}});
  scene.obstacles.push_back({.shape = Box{{0.3, 0, 0.1}, turn(0.1, {0, 0, 1}), {0.05, 0.2, 0.1}}});
  Obstacle box = free_box(as_mesh, {0.02, 0.01, 0.11}, turn(0.5, {1, 2, 0.3}));
  box.velocity = {0.8, 0, -1};
  box.spin = {2, 9, -3};
  scene.obstacles.push_back(box);
  return scene;
}

double height(const Obstacle& o) {
  double lowest = 1e9;
  for (std::uint32_t k = 0; k < corner_count(o.shape); ++k) {
    lowest = std::min(lowest, corner_at(o.shape, k).z());
  }
  return lowest;
}

}  // namespace

TEST_CASE("a free box in flight keeps energy and angular momentum as it tumbles", "[free]") {
  const bool as_mesh = GENERATE(false, true);
  Scene scene;
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-3;
  scene.bodies = {block({0, 0, 10})};
  scene.obstacles = {free_box(as_mesh, {0, 0, 0}, turn(0.3, {1, 1, 0}))};
  scene.obstacles[0].spin = {0.1, 12, 0.2};  // about the middle axis: it turns over
  Simulation sim = built(scene);
  const Obstacle& box = sim.state->obstacles[0];
  const Mat3 solid = own_inertia(box);
  CHECK(solid(0, 0) == Approx(mass / 3 * (half.y() * half.y() + half.z() * half.z())));
  CHECK(solid(1, 1) == Approx(mass / 3 * (half.x() * half.x() + half.z() * half.z())));
  const Vec3 L = angular_momentum_of(box);
  const double energy = kinetic_energy(box);
  double least = 1;
  for (int k = 0; k < 2000; ++k) {
    advance(sim);
    const Vec3 own = pose_of(box.shape).orientation.conjugate() * box.spin;
    least = std::min(least, own.normalized().y());
  }
  CHECK(least < -0.9);
  CHECK((angular_momentum_of(box) - L).norm() < 1e-11 * L.norm());
  CHECK(kinetic_energy(box) == Approx(energy).epsilon(1e-10));
}

TEST_CASE("a free box among a body, a floor and a wall: no momentum is lost unnamed, no energy won",
          "[free][momentum]") {
  const bool as_mesh = GENERATE(false, true);
  const RubbleMode rubble = GENERATE(RubbleMode::off, RubbleMode::certified);
  Scene scene = thrown(as_mesh);
  scene.ladder.rubble = rubble;
  Simulation sim = built(scene);
  const Impulse start = total_momentum(*sim.state);
  Impulse given = Impulse::Zero();
  const Obstacle& box = sim.state->obstacles[2];
  const auto energy = [&] {
    double sum = kinetic_energy(box) + 9.81 * mass * pose_of(box.shape).centre.z();
    const VertexColumns& v = sim.state->mechanics.vertices;
    for (std::size_t k = 0; k < v.size(); ++k) {
      sum += v.mass[k] * (0.5 * v.velocity[k].squaredNorm() + 9.81 * v.position[k].z());
    }
    return sum;
  };
  const double before = energy();
  for (int k = 0; k < 2000; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    for_each_counter<MomentumLedger>(
        [&](const auto& counter) { given += report.momentum.*counter.member; });
    CHECK(energy() < before * (1 + 1e-3));
  }
  const Impulse residual = total_momentum(*sim.state) - start - given;
  CHECK(residual.norm() < 1e-9 * given.norm());
  // It lies, on the floor or the block.
  CHECK(height(box) > -2e-4);
  CHECK(box.velocity.norm() < 0.02);
  CHECK(box.spin.norm() < 0.5);
}

TEST_CASE("a free box slides down an incline if and only if tan a > mu", "[free]") {
  const bool as_mesh = GENERATE(false, true);
  const double mu = 0.5, ratio = GENERATE(0.98, 1.02), angle = std::atan(ratio * mu);
  Scene scene;
  scene.gravity.acceleration = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
  scene.integrator.time_step = 1e-3;
  scene.obstacles.push_back({.shape = Plane{}, .friction = mu});
  scene.obstacles.push_back(free_box(as_mesh, {0, 0, half.z()}, turn(0.2, {0, 0, 1})));
  scene.obstacles[1].friction = mu;
  scene.bodies = {block({5, 5, 5})};
  Simulation sim = built(scene);
  for (int k = 0; k < 500; ++k) advance(sim);
  const double way = pose_of(sim.state->obstacles[1].shape).centre.x();
  const double free = 0.5 * 0.25 * 9.81 * (std::sin(angle) - mu * std::cos(angle));
  CHECK(way == Approx(std::max(0.0, free)).margin(2e-5 + 0.02 * std::abs(free)));
}

TEST_CASE("a box as a mesh does what the box does", "[free][solid]") {
  const auto run = [](bool as_mesh, bool driven, double angle = 0.1) {
    Scene scene;
    scene.integrator.time_step = 5e-4;
    scene.contact.max_iterations = 2000;
    scene.contact.tolerance = 1e-8;
    scene.bodies = {block({0, 0, 0}), block({0, 0, 0.0402})};
    scene.obstacles.push_back({Plane{}});
    scene.obstacles.push_back(free_box(as_mesh, {-0.06, 0.02, 0.021}, turn(angle, {0, 0, 1})));
    scene.obstacles[1].velocity = {0.5, 0, 0};
    if (driven) scene.obstacles[1].mass.reset();
    Simulation sim = built(scene);
    for (int k = 0; k < (driven ? 90 : 120); ++k)
      REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
    std::vector<Vec3> places;
    for (const Component& c : sim.state->mechanics.components) places.push_back(c.centre);
    places.push_back(pose_of(sim.state->obstacles[1].shape).centre);
    return places;
  };
  const bool driven = GENERATE(false, true);
  const std::vector<Vec3> boxes = run(false, driven), meshes = run(true, driven);
  CHECK((boxes[0] - Vec3(0.02, 0.02, 0.02)).norm() > 5e-4);
  // Sweeps go by other rows, and two blocks that rub on each other make much of where they end:
  // boxes turned by a little more are as far off.
  double spread = 5e-5;
  for (const double more : {1e-9, -1e-9, 1e-7, -1e-7}) {
    const std::vector<Vec3> turned = run(false, driven, 0.1 + more);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      spread = std::max(spread, 2 * (boxes[k] - turned[k]).norm());
    }
  }
  CHECK(spread < 2e-3);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    INFO(k);
    CHECK((boxes[k] - meshes[k]).norm() < spread);
  }
}

TEST_CASE("a sharp corner does not sink into a large face", "[solid][free]") {
  const bool is_box = GENERATE(true, false);
  Scene scene;
  scene.integrator.time_step = 5e-4;
  // Two prisms' worth of tetrahedra: faces of 0.2 m, and a corner that meets the middle of one.
  scene.bodies = {block({-0.08, -0.03, 0.0501}, {1, 1, 1}, 0.2)};
  scene.bodies[0].velocity = {0, 0, -0.5};
  const Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ());
  const Vec3 side = Vec3::Constant(0.05 / std::sqrt(3));
  scene.obstacles.push_back({.shape = is_box ? Shape(Box{{0, 0, 0}, upright, side})
                                             : Shape(box_mesh(side, {0, 0, 0}, upright))});
  REQUIRE(corner_at(scene.obstacles[0].shape, 7).z() == Approx(0.05));
  Simulation sim = built(scene);
  double deepest = 0;
  for (int k = 0; k < 60; ++k) {
    REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
    const Component& c = sim.state->mechanics.components[0];
    const Vec3 own = c.orientation.conjugate() * (Vec3(0, 0, 0.05) - c.centre) + c.rest_centre;
    const bool over_face = own.x() > 0 && own.x() < 0.2 && own.y() > 0 && own.y() < 0.2;
    if (over_face) deepest = std::max(deepest, own.z());
  }
  CHECK(deepest < 2e-4);
}

TEST_CASE("free boxes and meshes go on to the same bytes after a pause", "[free][saved]") {
  const bool as_mesh = GENERATE(false, true);
  Simulation whole = built(thrown(as_mesh)), paused = built(thrown(as_mesh));
  for (int k = 0; k < 120; ++k) {
    advance(whole);
    *paused.scratch = SimulationScratch{};
    advance(paused);
    REQUIRE(test::first_difference(whole, paused) == "");
    if (k % 20 != 3) continue;
    Result<Simulation> restored = restore(saved_state(paused));
    REQUIRE(restored);
    paused = std::move(*restored);
  }
  CHECK(saved_state(whole) == saved_state(paused));
}

TEST_CASE("what is near a mesh stays with the elastic solver, and the report says so",
          "[solid][rubble]") {
  const bool as_mesh = GENERATE(false, true);
  Scene scene;
  scene.integrator.time_step = 1e-3;
  scene.ladder.rubble = RubbleMode::certified;
  scene.obstacles.push_back(
      {.shape = as_mesh ? Shape(box_mesh({0.2, 0.2, 0.05}, {0, 0, -0.05}))
                        : Shape(Box{{0, 0, -0.05}, {1, 0, 0, 0}, {0.2, 0.2, 0.05}})});
  scene.bodies = {block({0, 0, 0.01})};
  scene.bodies[0].rigid = true;
  Simulation sim = built(scene);
  std::uint32_t solids = 0, ticks = 0;
  for (int k = 0; k < 100; ++k) {
    const StepReport report = advance(sim);
    solids += report.rubble.solids;
    ticks += report.rubble.ticks;
  }
  CHECK((solids > 0) == as_mesh);
  CHECK((ticks > 10) == !as_mesh);
  for (const Vec3& x : sim.state->mechanics.vertices.position) CHECK(x.z() > -1e-4);
}

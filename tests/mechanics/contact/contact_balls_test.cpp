// SPDX-License-Identifier: MIT
// Spheres on faces and edges of pieces, of any size and at any speed.
#include "mechanics/contact/detection/contact_balls.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A block of side 1 about the origin that does not deform, and a free ball.
ContactScene ball_and_block(const Sphere& ball, const Vec3& velocity, std::array<int, 3> cells) {
  const Body block = kuhn_block(cells, {1, 1, 1});
  ContactScene scene{block, state_of(together({block}), material_of(1e10))};
  scene.state.components[0].rigid = true;
  Obstacle free{ball, velocity};
  free.mass = 2400 * 4.0 / 3 * pi * std::pow(ball.radius, 3);
  scene.obstacles = {free};
  return scene;
}

const Sphere& sphere_of(const ContactScene& scene) {
  return std::get<Sphere>(scene.obstacles[0].shape);
}

}  // namespace

TEST_CASE(
    "a ball smaller than a cell rests on a block, on a face, an edge between cells or a vertex",
    "[mechanics][contact]") {
  const double radius = GENERATE(0.5, 0.1, 0.01);
  const Vec3 place =
      GENERATE(Vec3(0.11, 0.23, 0), Vec3(0.2, 0.2, 0), Vec3(0, 0, 0), Vec3(0.3, 0, 0));
  INFO("radius " << radius << " at " << place.transpose());
  // The block is held by a plane below it.
  ContactScene scene =
      ball_and_block({place + Vec3(0, 0, 0.5 + 1.2 * radius), radius}, Vec3(0, 0, -1), {2, 2, 2});
  scene.obstacles.push_back({Plane{Vec3::UnitZ(), -0.5}});
  scene.loads.gravity = {0, 0, -9.81};
  scene.integrator.time_step = 1e-3;
  for (int k = 0; k < 200; ++k) scene.step();
  CHECK(std::abs(sphere_of(scene).center.z() - (0.5 + radius)) < 3e-5);
  CHECK(scene.obstacles[0].velocity.norm() < 1e-3);
}

TEST_CASE("no ball passes a block, whatever its size, its speed and the step",
          "[mechanics][contact]") {
  const unsigned seed = 5;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int met = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = std::pow(10.0, any(-3, 0)), speed = std::pow(10.0, any(-1, 3));
    const Vec3 aim(any(-0.45, 0.45), any(-0.45, 0.45), 0);
    const Vec3 ahead = Vec3(any(-0.5, 0.5), any(-0.5, 0.5), -1).normalized();
    ContactScene scene = ball_and_block(
        {aim + Vec3(0, 0, 0.5) - ahead * (radius / -ahead.z() + any(0.01, 0.5)), radius},
        speed * ahead, {1, 1, 1});
    scene.integrator.time_step = std::pow(10.0, any(-4, -1));
    bool has_met = false;
    const Vec3 momentum = scene.total_momentum();
    for (int k = 0; k < 1000 && !has_met; ++k) {
      has_met = scene.step_in_parts().report.contacts > 0;
      const Vec3 local = scene.state.components[0].orientation.conjugate() *
                         (sphere_of(scene).center - scene.state.components[0].centre);
      const double gap = (local.cwiseAbs() - Vec3::Constant(0.5)).cwiseMax(0).norm() - radius;
      INFO("trial " << trial << ": radius " << radius << ", " << speed << " m/s");
      REQUIRE(gap > -0.02 * radius - 1e-5);
    }
    met += has_met;
    CHECK((scene.total_momentum() - momentum).norm() < 1e-12 * momentum.norm());
  }
  // The others are slow and take short steps.
  CHECK(met > 250);
}

TEST_CASE("a ball meets one feature of a flat surface, and both sides of a groove",
          "[mechanics][contact]") {
  ContactScene flat = ball_and_block({{0.11, 0.23, 0.6}, 0.1}, Vec3(0, 0, -0.1), {3, 3, 3});
  flat.integrator.time_step = 1e-3;
  flat.step();
  const ContactStepResult result = flat.step();
  CHECK(result.report.contacts == 1);

  // Two blocks side by side with tops that slope to each other, as one scene of two pieces.
  Body left = kuhn_block({1, 1, 1}, {1, 1, 1}), right = left;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5, Vec3::UnitY()));
  for (Vec3& x : left.rest) x = turn * (x - Vec3(0.5, 0, 0.5));
  for (Vec3& x : right.rest) x = turn.conjugate() * (x + Vec3(0.5, 0, -0.5));
  const SeveralBodies all = together({left, right});
  ContactScene groove{all.body, state_of(all, material_of(1e10))};
  for (Component& c : groove.state.components) c.rigid = true;
  const double radius = 0.1;
  Obstacle ball{Sphere{{0, 0.01, radius / std::cos(0.5) + 1e-4}, radius}, Vec3(0, 0, -1)};
  ball.mass = 1;
  groove.obstacles = {ball};
  groove.integrator.time_step = 1e-3;
  const ContactStepResult both = groove.step();
  CHECK(std::ranges::count_if(both.contacts, [](const ContactPoint& c) {
          return c.ball == 0 && std::abs(c.normal.x()) > 0.4;
        }) == 2);
  CHECK(std::abs(groove.obstacles[0].velocity.x()) < 1e-3);
}

TEST_CASE("a ball that slides off the face it met overlaps nothing", "[mechanics][contact]") {
  // The step ends below the face, far from the block.
  ContactScene scene = ball_and_block({{0.45, 0, 0.62}, 0.1}, Vec3(100, 0, -20), {2, 2, 2});
  scene.integrator.time_step = 0.05;
  const ContactStepResult result = scene.step();
  CHECK(result.report.contacts > 0);
  CHECK(result.report.deepest < 1e-6);
  const Vec3 local = sphere_of(scene).center - scene.state.components[0].centre;
  CHECK((local.cwiseAbs() - Vec3::Constant(0.5)).cwiseMax(0).norm() > 0.1);
}

TEST_CASE("a step in which a squeezed piece would be thrown into its support is divided",
          "[mechanics][contact]") {
  // A heavy ball on the corner of a thin plate that lies on a plane.
  const Body plate = kuhn_block({4, 4, 1}, {0.01, 0.01, 0.0025});
  ContactScene scene{plate, state_of(together({plate}), material_of(3e10))};
  scene.obstacles = {{.shape = Sphere{Vec3(0.003, 0.002, 0.0115), 0.0088},
                      .velocity = {-10, 5, -114},
                      .mass = 0.02},
                     {Plane{Vec3::UnitZ(), -0.00125}}};
  scene.integrator.time_step = 1e-3;
  double deepest = 0;
  scene.step_in_parts([&] {
    for (const Vec3& x : scene.state.vertices.position) {
      deepest = std::max(deepest, -0.00125 - x.z());
    }
  });
  CHECK(deepest < 0.02 * 0.0025);
}

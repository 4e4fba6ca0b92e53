// SPDX-License-Identifier: MIT
// Flat bodies on edges of boxes, wherever their vertices are.
#include "mechanics/contact/detection/knife_edges.hpp"

#include <catch2/catch.hpp>

#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A box that stands on an edge along y, with another edge on top at a place.
Obstacle knife(double x, double z) {
  const double half = 0.05;
  return {Box{{x, 0, z - half * std::sqrt(2.0)},
              Eigen::Quaterniond(Eigen::AngleAxisd(pi / 4, Vec3::UnitY())),
              {half, 0.3, half}}};
}

/// A plate on two knife edges without friction, `off` (m) from its vertices and `below` (m) it.
ContactScene plate_on_knives(double off, double below = 0) {
  const Body plate = kuhn_block({8, 2, 1}, {0.8, 0.2, 0.05});
  ContactScene scene{plate, state_of(together({plate}), material_of(3e10))};
  scene.obstacles = {knife(-0.3 + off, -0.025 - below), knife(0.3 - off, -0.025 - below)};
  for (Obstacle& o : scene.obstacles) o.friction = 0;
  scene.contact.friction = 0;
  scene.loads.gravity = {0, 0, -9.81};
  scene.integrator.time_step = 1e-3;
  return scene;
}

}  // namespace

TEST_CASE("a plate lies on two knife edges, and no side of them pushes it away",
          "[mechanics][contact]") {
  const double off = GENERATE(0.0, 1e-9, 1e-5, 2e-4, 1e-3, 0.03);
  const bool rigid = GENERATE(false, true);
  INFO(off << " m from its vertices" << (rigid ? ", rigid" : ""));
  ContactScene scene = plate_on_knives(off);
  scene.state.components[0].rigid = rigid;
  double weight = 0;
  for (int k = 0; k < 200; ++k) {
    weight = 0;
    for (const ContactPoint& c : scene.step().contacts) {
      CHECK(c.normal.z() > 0.999);
      weight += c.impulse.z() / scene.integrator.time_step;
    }
  }
  const Component& component = scene.state.components[0];
  CHECK(weight == Approx(9.81 * component.mass).epsilon(1e-3));
  CHECK(std::abs(component.centre.z()) < 2e-5);
  CHECK(std::abs(component.centre.x()) < 1e-6);
}

TEST_CASE("a plate that falls on two knife edges comes to rest on them", "[mechanics][contact]") {
  const double off = GENERATE(0.0, 1e-3, 0.01, 0.03);
  const double step = GENERATE(1e-3, 1.0 / 240);
  INFO(off << " m from its vertices, step " << step);
  ContactScene scene = plate_on_knives(off, 0.02);
  for (Obstacle& o : scene.obstacles) o.friction = 0.5;
  scene.contact.friction = 0.5;
  for (double time = 0; time < 0.6; time += step) scene.step_in_parts();
  CHECK(std::abs(scene.state.components[0].centre.z() + 0.02) < 2e-5);
}

TEST_CASE("the corner of a cube keeps the normal of the side of a box that it touches",
          "[mechanics][contact]") {
  // A vertex below which the cube has nothing fits any side of the edge.
  Body cube = kuhn_block({1, 1, 1}, {0.1, 0.1, 0.1});
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Vec3(-1, -1, -1), -Vec3::UnitZ());
  for (Vec3& x : cube.rest) x = turn * x + Vec3(0.001, 0, 0.05 * std::sqrt(3.0));
  ContactScene scene{cube, state_of(together({cube}), material_of(3e10))};
  scene.state.components[0].rigid = true;
  scene.obstacles = {knife(0, 0)};
  place(scene.state, ComponentId{0}, {.velocity = Vec3(0, 0, -1)});
  scene.integrator.time_step = 0.01;
  const ContactStepResult result = scene.step();
  REQUIRE(result.contacts.size() > 0);
  for (const ContactPoint& c : result.contacts) {
    if (!c.vertex.is_none()) CHECK(c.normal.z() == Approx(std::sqrt(0.5)).epsilon(1e-9));
  }
}

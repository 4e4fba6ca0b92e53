// SPDX-License-Identifier: MIT
// Bodies slide over flush boxes and meshes, and over gaps too narrow to count.
#include <catch2/catch.hpp>

#include "mechanics/contact/shapes/solid_surface.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

Obstacle box_between(double low, double high) {
  Obstacle box{Box{
      {0.5 * (low + high), 0, -0.5}, Eigen::Quaterniond::Identity(), {0.5 * (high - low), 1, 0.5}}};
  box.friction = 0;
  return box;
}

/// The same as a mesh.
Obstacle mesh_between(double low, double high) {
  TriangleSurface surface;
  const Shape box = box_between(low, high).shape;
  for (std::uint32_t k = 0; k < 8; ++k) surface.points.push_back(corner_at(box, k));
  for (const auto& [a, b, c, d] : {std::array{0u, 4u, 6u, 2u},
                                   {1u, 3u, 7u, 5u},
                                   {0u, 1u, 5u, 4u},
                                   {2u, 6u, 7u, 3u},
                                   {0u, 2u, 3u, 1u},
                                   {4u, 5u, 7u, 6u}}) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
  const Result<SolidSurface> made = make_solid_surface(std::move(surface));
  Obstacle obstacle{Solid{std::make_shared<const SolidSurface>(*made)}};
  obstacle.friction = 0;
  return obstacle;
}

/// A cube of 0.1 m on the first of the obstacles; all tops are at z = 0.
ContactScene sliding_cube(double speed, double step, bool rigid) {
  Body cube = kuhn_block({2, 2, 2}, {0.1, 0.1, 0.1});
  for (Vec3& x : cube.rest) x += Vec3(-0.2, 0.03, 0.05);
  ContactScene scene{cube, state_of(together({cube}), material_of(3e10))};
  scene.state.components[0].rigid = rigid;
  place(scene.state, ComponentId{0}, {.velocity = Vec3(speed, 0, 0)});
  scene.integrator.time_step = step;
  scene.contact.friction = 0;
  scene.loads.gravity = {0, 0, -9.81};
  return scene;
}

void check_slide(ContactScene& scene, double speed, double way) {
  const int steps = static_cast<int>(way / (speed * scene.integrator.time_step));
  for (int k = 0; k < steps; ++k) scene.step_in_parts();
  const Component& cube = scene.state.components[0];
  CHECK(std::abs(cube.momentum.x() / cube.mass - speed) < 1e-4 * speed);
  CHECK(std::abs(cube.centre.z() - 0.05) < 2e-5);
  CHECK(cube.angular_momentum.norm() < 1e-6);
}

}  // namespace

TEST_CASE("a cube slides over a seam of two boxes as over one", "[mechanics][contact]") {
  const double speed = GENERATE(0.1, 0.5, 2.0, 5.0);
  const double step = GENERATE(1.0 / 60, 1.0 / 240, 1e-3);
  INFO(speed << " m/s, step " << step);
  ContactScene scene = sliding_cube(speed, step, true);
  scene.obstacles = {box_between(-2, 0), box_between(0, 2)};
  check_slide(scene, speed, 0.5);
}

TEST_CASE("a cube slides over many boxes, and from a box to a mesh", "[mechanics][contact]") {
  const bool rigid = GENERATE(true, false);
  INFO((rigid ? "rigid" : "elastic"));
  SECTION("narrow boxes") {
    ContactScene scene = sliding_cube(2, 1.0 / 240, rigid);
    scene.obstacles = {box_between(-2, 0)};
    for (int k = 0; k < 12; ++k) scene.obstacles.push_back(box_between(0.03 * k, 0.03 * (k + 1)));
    scene.obstacles.push_back(box_between(0.36, 2));
    check_slide(scene, 2, 0.7);
  }
  SECTION("a mesh") {
    ContactScene scene = sliding_cube(1, 1.0 / 240, rigid);
    scene.obstacles = {box_between(-2, 0), mesh_between(0, 2)};
    check_slide(scene, 1, 0.5);
  }
}

TEST_CASE("a wall still stops a cube that slides, and a step up too", "[mechanics][contact]") {
  const double top = GENERATE(0.001, 0.02, 0.5);
  INFO("step up " << top);
  ContactScene scene = sliding_cube(2, 1.0 / 240, true);
  Obstacle wall = box_between(0, 2);
  std::get<Box>(wall.shape).center.z() += top;
  scene.obstacles = {box_between(-2, 0), wall};
  for (int k = 0; k < 60; ++k) scene.step_in_parts();
  // A blow near its lower edge tips it; a wall in front of all of it stops it.
  CHECK(scene.state.components[0].momentum.x() / scene.state.components[0].mass < 1.5);
}

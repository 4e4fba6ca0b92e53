// SPDX-License-Identifier: MIT
// Mistakes of a program that fills a scene itself: refused as a scene file would be.
#include "fracture/scene/check_scene.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

Scene cube() {
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].mesh = suite::kuhn_box({2, 2, 2});
  return scene;
}

/// "code place" of everything that is wrong after `change`.
template <class Change>
std::vector<std::string> wrong(Change change) {
  Scene scene = cube();
  change(scene);
  std::vector<std::string> all;
  for (const SettingFinding& f : check_scene(scene)) all.push_back(f.finding.code + " " + f.place);
  const Result<Simulation> built = build_simulation(scene);
  CHECK_FALSE(built);
  CHECK(built.findings.size() >= all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(all[i].starts_with(built.findings.at(i).code + " "));
  }
  return all;
}

}  // namespace

TEST_CASE("a scene without mistakes has none", "[fracture][settings]") {
  CHECK(check_scene(cube()).empty());
  CHECK(build_simulation(cube()));
}

TEST_CASE("numbers out of range are refused wherever they stand in a scene",
          "[fracture][settings]") {
  using All = std::vector<std::string>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(wrong([](Scene& s) { s.integrator.time_step = 0; }) == All{"out_of_range time_step"});
  CHECK(wrong([&](Scene& s) { s.integrator.time_step = nan; }) == All{"out_of_range time_step"});
  CHECK(wrong([](Scene& s) { s.duration = -1; }) == All{"out_of_range duration"});
  CHECK(wrong([&](Scene& s) { s.gravity.acceleration.y() = nan; }) ==
        All{"out_of_range gravity.acceleration.1"});
  CHECK(wrong([](Scene& s) { s.fracture.smallest_piece = -1; }) ==
        All{"out_of_range fracture.smallest_piece"});
  CHECK(wrong([](Scene& s) { s.contact.tolerance = 0; }) == All{"out_of_range contact.tolerance"});
  CHECK(wrong([&](Scene& s) { s.bodies[0].velocity.x() = nan; }) ==
        All{"out_of_range bodies.0.velocity.0"});
  CHECK(wrong([](Scene& s) { s.bodies[0].rotation.coeffs() *= 2; }) ==
        All{"not_a_rotation bodies.0.rotation"});
  CHECK(wrong([](Scene& s) {
          s.obstacles = {{Sphere{{0, 0, 0}, 0}}};
        }) == All{"out_of_range obstacles.0.sphere.radius"});
}

TEST_CASE("coordinates that reals do not tell apart are refused", "[fracture][settings]") {
  using All = std::vector<std::string>;
  const auto scaled = [](double factor, double offset) {
    return wrong([=](Scene& s) {
      for (Point& p : s.bodies[0].mesh.points) {
        for (double& x : p) x = factor * x + offset;
      }
    });
  };
  CHECK(scaled(1e25, 0) == All{"mesh_size bodies.0.mesh"});
  CHECK(scaled(1e-35, 0) == All{"mesh_size bodies.0.mesh"});
  CHECK(scaled(1, 1e12) == All{"too_far bodies.0.mesh"});
  CHECK(wrong([](Scene& s) {
          s.bodies[0].translation = {0, -1e17, 0};
        }) == All{"too_far bodies.0.translation"});
  CHECK(wrong([](Scene& s) {
          s.bodies[0].translation = {1e300, 0, 0};
        }) == All{"out_of_range bodies.0.translation.0", "too_far bodies.0.translation"});
}

TEST_CASE("more bodies at one place than contact can part are refused, side by side they are not",
          "[fracture][settings]") {
  Scene scene = cube();
  scene.bodies.resize(9, scene.bodies[0]);
  CHECK(build_simulation(scene));
  scene.bodies.resize(300, scene.bodies[0]);
  const Result<Simulation> built = build_simulation(scene);
  REQUIRE_FALSE(built);
  std::size_t errors = 0;
  for (const Finding& f : built.findings) {
    if (f.severity != Severity::error) continue;
    ++errors;
    CHECK(f.code == "bodies_at_one_place");
    CHECK(f.text.starts_with("bodies.9.translation puts the body into more than 8 others"));
  }
  CHECK(errors == 1);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    scene.bodies[b].translation.x() = 3.0 * static_cast<double>(b);
  }
  CHECK(build_simulation(scene));
}

TEST_CASE("what keys say together is refused at its place", "[fracture][settings]") {
  using All = std::vector<std::string>;
  CHECK(wrong([](Scene& s) { s.bodies.clear(); }) == All{"no_body bodies"});
  CHECK(wrong([](Scene& s) { s.integrator.time_step = 1e-12; }) == All{"too_many_steps time_step"});
  CHECK(wrong([](Scene& s) {
          s.integrator.time_step = s.duration = 80;
          s.bodies[0].spin = {0, 0, 100};
        }) == All{"spun_too_far time_step"});
  CHECK(wrong([](Scene& s) {
          s.bodies[0].held = {{.minimum = {5, 5, 5}, .maximum = {6, 6, 6}},
                              {.minimum = {1, 1, 1}, .maximum = {0, 0, 0}}};
        }) == All{"bad_box bodies.0.held.1", "nothing_held bodies.0.held.0"});
  CHECK(wrong([](Scene& s) {
          s.bodies[0].loads = {{.maximum = {1, 1, 1}}};
        }) == All{"no_load bodies.0.loads.0"});
  CHECK(wrong([](Scene& s) {
          s.bodies[0].loads = {{.minimum = {5, 5, 5}, .maximum = {6, 6, 6}, .pressure = 1}};
        }) == All{"nothing_loaded bodies.0.loads.0"});
  CHECK(wrong([](Scene& s) {
          s.contact.method = ContactMethod::penalty;
          s.ladder.rubble = RubbleMode::certified;
        }) == All{"rubble_not_supported ladder.rubble"});
  CHECK(wrong([](Scene& s) {
          s.bodies[0].unbreakable = {{RestBox{{5, 5, 5}, {6, 6, 6}}}, {RegionName{"feet"}}};
        }) == All{"nothing_unbreakable bodies.0.unbreakable.0.box",
                  "unknown_region bodies.0.unbreakable.1.region"});
}

TEST_CASE("a vertex is a point that a tetrahedron uses: boxes round other points hold nothing",
          "[fracture][settings]") {
  CHECK(wrong([](Scene& s) {
          s.bodies[0].mesh.points.push_back({9, 9, 9});
          s.bodies[0].held = {{.minimum = {8, 8, 8}, .maximum = {10, 10, 10}}};
        }) == std::vector<std::string>{"nothing_held bodies.0.held.0"});
}

TEST_CASE("a held box round the middle of an edge holds a node of order 2, and nothing of order 1",
          "[fracture][settings]") {
  const auto hold_middle = [](Scene& s) {
    BodySettings& body = s.bodies[0];
    const auto& t = body.mesh.tetrahedra[0];
    const Vec3 a(body.mesh.points[t[0]].data()), b(body.mesh.points[t[2]].data());
    const Vec3 middle = 0.5 * (a + b), near = Vec3::Constant(0.01 * (a - b).norm());
    body.held = {{.minimum = middle - near, .maximum = middle + near}};
  };
  CHECK(wrong(hold_middle) == std::vector<std::string>{"nothing_held bodies.0.held.0"});
  Scene scene = cube();
  scene.bodies[0].order = 2;
  hold_middle(scene);
  CHECK(check_scene(scene).empty());
  const Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  const auto& support = sim->state->mechanics.vertices.support;
  CHECK(std::ranges::count_if(support, [](MotionId m) { return !m.is_none(); }) == 1);
}

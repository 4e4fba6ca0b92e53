// SPDX-License-Identifier: MIT
// The table of a run's history: columns, rows, and a load curve.
#include "apps/output/history.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Row = std::map<std::string, double>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  line.pop_back();
  const std::vector<std::string> names = cells(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> parts = cells(line);
    REQUIRE(parts.size() == names.size());
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < parts.size(); ++k) row[names[k]] = std::stod(parts[k]);
  }
  return rows;
}

/// A block 0.1 m wide and 0.2 m high on a plane, which a plate presses down.
Scene press(double speed) {
  Scene scene;
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.contact.friction = 0;
  scene.bodies.resize(1);
  scene.bodies[0].mesh = suite::kuhn_box({2, 2, 4}, 0.05);
  scene.bodies[0].material.poisson_ratio = 0.2;
  scene.obstacles.push_back({.shape = Plane{}, .friction = 0});
  scene.obstacles.push_back(
      {.shape = Box{{0.05, 0.05, 0.21}, Eigen::Quaterniond::Identity(), {0.1, 0.1, 0.01}},
       .velocity = {0, 0, -speed},
       .friction = 0});
  scene.duration = 0.02;
  return scene;
}

History history_of(Simulation& sim, int steps, int stride) {
  sim.reports_forces = true;
  History history = begin_history(sim);
  for (int k = 1; k <= steps; ++k) {
    add_step(history, advance(sim));
    if (k % stride == 0) add_row(history, sim);
  }
  return history;
}

}  // namespace

TEST_CASE("columns of the history have distinct names, those of the rows of the scene",
          "[history]") {
  Scene scene = press(0.01);
  scene.obstacles.push_back({.shape = Sphere{{0, 0, 3}, 0.1}, .mass = 2.0});
  scene.bodies[0].held = {{.minimum = {-1, -1, -1}, .maximum = {1, 1, 0.01}}};
  scene.bodies[0].loads.resize(2);
  const std::string heading = history_csv({}, scene);
  std::set<std::string> names;
  for (const std::string& name : cells(heading.substr(0, heading.find('\r')))) {
    INFO(name);
    CHECK(names.insert(name).second);
    CHECK(std::ranges::none_of(name, [](char c) { return c >= 'A' && c <= 'Z'; }));
  }
  // 12 of every run, 2 loads, 3 obstacles, 2 of them driven, 1 held box.
  CHECK(names.size() == 12 + 2 + 3 * 6 + 2 * 3 + 6);
  for (const char* name :
       {"time", "kinetic_energy", "pieces", "body_0_load_1_work", "obstacle_1_force_z",
        "obstacle_0_displacement_x", "obstacle_2_moment_y", "body_0_held_0_force_x"}) {
    INFO(name);
    CHECK(names.contains(name));
  }
  CHECK_FALSE(names.contains("obstacle_2_displacement_x"));  // it is free
}

TEST_CASE("a run without an interval has at most 2 000 rows", "[history]") {
  for (const std::uint64_t steps : {1u, 5u, 1999u, 2000u, 2001u, 3998u, 3999u, 123457u}) {
    const std::uint64_t stride = usual_history_stride(steps);
    const std::uint64_t rows = 1 + (steps + stride - 1) / stride;
    INFO(steps);
    CHECK(rows <= 2000);
    CHECK((steps < 2000) == (stride == 1));
    if (stride > 1) CHECK(1 + (steps + stride - 2) / (stride - 1) > 2000);
  }
}

TEST_CASE("the load curve of a pressed block rises by E A / L", "[history]") {
  const double speed = 0.01;
  Simulation sim = built(press(speed));
  const int stride = 5;
  const History history = history_of(sim, 20, stride);
  const std::vector<Row> rows = rows_of(history_csv(history, sim.scene));
  REQUIRE(rows.size() == 5);
  CHECK(rows[0].at("time") == 0);
  CHECK(rows[0].at("obstacle_1_force_z") == 0);
  const double stiffness = sim.scene.bodies[0].material.young_modulus * 0.01 / 0.2;
  const Row &first = rows[2], &last = rows[4];
  CHECK(last.at("obstacle_1_displacement_z") == Approx(-speed * last.at("time")).epsilon(1e-9));
  CHECK(last.at("obstacle_1_displacement_x") == 0);
  CHECK(last.at("obstacle_0_displacement_z") == 0);
  const double rise = last.at("obstacle_1_force_z") - first.at("obstacle_1_force_z");
  // Forces are means over intervals: those of moments half an interval earlier.
  const double way = -last.at("obstacle_1_displacement_z") + first.at("obstacle_1_displacement_z");
  CHECK(rise / way == Approx(stiffness).epsilon(0.02));
  CHECK(last.at("obstacle_0_force_z") == Approx(-last.at("obstacle_1_force_z")).epsilon(0.02));
  CHECK(last.at("elastic_energy") > 0);
  CHECK(last.at("pieces") == 1);
  CHECK(last.at("largest_piece") ==
        Approx(sim.scene.bodies[0].material.density * 2e-3).epsilon(1e-12));
}

TEST_CASE("forces of rows are means of the forces of shorter ones", "[history]") {
  Simulation fine = built(press(0.05)), coarse = built(press(0.05));
  const std::vector<Row> each = rows_of(history_csv(history_of(fine, 12, 1), fine.scene));
  const std::vector<Row> few = rows_of(history_csv(history_of(coarse, 12, 4), coarse.scene));
  REQUIRE(each.size() == 13);
  REQUIRE(few.size() == 4);
  for (std::size_t k = 1; k < few.size(); ++k) {
    for (const char* name : {"obstacle_0_force_z", "obstacle_1_moment_x"}) {
      double sum = 0;
      for (std::size_t i = 4 * k - 3; i <= 4 * k; ++i) sum += each[i].at(name);
      CHECK(few[k].at(name) == Approx(sum / 4).epsilon(1e-9).margin(1e-9));
    }
    CHECK(few[k].at("kinetic_energy") == each[4 * k].at("kinetic_energy"));
  }
}

TEST_CASE("the support of a loaded bar bears its weight, its load and their moment", "[history]") {
  Scene scene;
  scene.fracture.mode = FractureMode::off;
  scene.gravity = {.acceleration = {0, 0, -9.81}, .ramp_time = 0.1};
  scene.integrator.damping.stiffness_factor = 1e-4;
  scene.ladder.sleep = false;
  scene.bodies.resize(1);
  BodySettings& bar = scene.bodies[0];
  bar.mesh = suite::kuhn_box({8, 2, 2}, 0.05);
  bar.translation = {3, -2, 1};  // the moment is about the held end, not about the origin
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 1, 1}}};
  bar.loads.resize(1);
  bar.loads[0] = {.minimum = {0.4 - 1e-6, -1, -1}, .maximum = {1, 1, 1}, .force = {5000, 0, 0}};
  bar.loads[0].ramp_time = 0.1;
  Simulation sim = built(std::move(scene));
  const double weight = 9.81 * sim.state->mechanics.components[0].mass;
  const History history = history_of(sim, 300, 100);
  const Row last = rows_of(history_csv(history, sim.scene)).back();
  CHECK(last.at("body_0_held_0_force_x") == Approx(-5000).epsilon(1e-3));
  CHECK(std::abs(last.at("body_0_held_0_force_y")) < 1e-3 * weight);
  CHECK(last.at("body_0_held_0_force_z") == Approx(weight).epsilon(1e-3));
  CHECK(last.at("body_0_held_0_moment_y") == Approx(-0.2 * weight).epsilon(1e-3));
  CHECK(std::abs(last.at("body_0_held_0_moment_x")) < 1e-3 * 0.2 * weight);
  CHECK(std::abs(last.at("body_0_held_0_moment_z")) < 1e-3 * 0.2 * weight);
}

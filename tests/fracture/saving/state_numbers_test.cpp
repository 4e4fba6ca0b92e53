// SPDX-License-Identifier: MIT
// A NaN in any column of the state, one at a time: it is named at once and survived for a step.
#include "fracture/saving/state_numbers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <set>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;
using suite::kuhn_box;

namespace {

Simulation stepped(const Scene& scene, int steps) {
  Simulation sim = built(scene);
  for (int k = 0; k < steps; ++k) advance(sim);
  return sim;
}

/// A block that is struck and breaks, one that is held and loaded, a free ball: with matrices,
/// factors, contacts, pieces and windows.
Scene busy_scene() {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back({.name = "block",
                          .mesh = kuhn_box({3, 2, 1}, 0.1),
                          .material = {.young_modulus = 1e8, .tensile_strength = 1e5},
                          .translation = {-0.1, 0, 0},
                          .velocity = {0, 0, -3}});
  scene.bodies.front().strength.weibull = WeibullSettings{};
  scene.bodies.push_back({.mesh = kuhn_box({3, 1, 1}, 0.1),
                          .translation = {3, 0, 1},
                          .held = {{{0, 0, 0}, {0, 1, 1}}},
                          .loads = {{.minimum = {0.29, 0, 0},
                                     .maximum = {1, 1, 1},
                                     .force = {0, 0, -100},
                                     .ramp_time = 0.05}}});
  scene.obstacles = {
      Obstacle{Plane{}},
      Obstacle{.shape = Sphere{{0, 0, 0.4}, 0.05}, .velocity = {0, 0, -5}, .mass = 1}};
  return scene;
}

Scene tied_scene() {
  Scene scene = busy_scene();
  for (BodySettings& body : scene.bodies) body.material.toughness = 2e4;
  scene.fracture.crack = CrackMode::cohesive;
  return scene;
}

Scene object_scene() {
  Scene scene = busy_scene();
  for (BodySettings& body : scene.bodies) body.material.toughness = 2e4;
  scene.fracture.crack = CrackMode::object;
  scene.fracture.criterion = FractureCriterion::energy;
  return scene;
}

/// Rubble: rigid pieces of several tetrahedra on the floor.
Scene rubble_scene() {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.ladder.rubble = RubbleMode::certified;
  scene.ladder.sleep_after = 0.02;
  for (int k = 0; k < 3; ++k) {
    scene.bodies.push_back(
        {.mesh = kuhn_box({1, 1, 1}, 0.1), .translation = {0.05 * k, 0, 0.11 * k}});
    scene.bodies.back().rigid = true;
  }
  scene.obstacles = {Obstacle{Plane{}}};
  return scene;
}

/// The bytes with a NaN at `place` and a checksum that is right for them.
std::string poisoned(std::string bytes, std::size_t place, std::size_t size) {
  if (size == sizeof(float)) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(&bytes[place], &nan, size);
  } else {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::memcpy(&bytes[place], &nan, size);
  }
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) {
    hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
  }
  std::memcpy(&bytes[bytes.size() - 8], &hash, 8);
  return bytes;
}

bool names(const std::vector<Finding>& findings, const std::string& column) {
  return std::ranges::any_of(findings, [&](const Finding& f) {
    return f.code == "not_a_number" && (f.text.find(" " + column + " of ") != std::string::npos);
  });
}

}  // namespace

TEST_CASE("a NaN in any column is named within a step, and no step crashes on it",
          "[fracture][state_numbers]") {
  std::set<std::string> seen;
  const Simulation all[] = {stepped(busy_scene(), 0), stepped(busy_scene(), 12),
                            stepped(tied_scene(), 12), stepped(object_scene(), 12),
                            stepped(rubble_scene(), 30)};
  for (const Simulation& sim : all) {
    CHECK(check_numbers(sim, NumbersOf::everything).empty());
    const std::string bytes = saved_state(sim);
    const std::vector<NumberColumn> evolving = number_columns(sim, NumbersOf::columns);
    for (const NumberColumn& column : number_columns(sim, NumbersOf::everything)) {
      INFO(column.name);
      seen.insert(column.name);
      for (const std::size_t place : {column.first_byte, column.last_byte}) {
        Result<Simulation> sick = restore(poisoned(bytes, place, sizeof(double)));
        // A surface with a NaN, which is made again, is refused.
        if (!sick) continue;
        const std::vector<Finding> found = check_numbers(*sick, NumbersOf::everything);
        CHECK(names(found, column.name));
        const bool evolves =
            std::ranges::find(evolving, column.name, &NumberColumn::name) != evolving.end();
        CHECK(names(check_numbers(*sick, NumbersOf::columns), column.name) == evolves);
        // A step with a NaN may have any result but a crash or a hang.
        if (column.name.starts_with("scene.")) continue;  // settings have been judged when read
        advance(*sick);
      }
    }
  }
  for (const char* column : {"mechanics.vertices.rest_position",
                             "mechanics.vertices.position",
                             "mechanics.vertices.velocity",
                             "mechanics.vertices.mass",
                             "mechanics.vertices.displacement",
                             "mechanics.vertices.displacement_rate",
                             "mechanics.vertices.displacement_acceleration",
                             "mechanics.elements.shape_gradient",
                             "mechanics.elements.rest_volume",
                             "mechanics.elements.mass",
                             "mechanics.elements.stress",
                             "mechanics.components.centre",
                             "mechanics.components.orientation",
                             "mechanics.components.momentum",
                             "mechanics.time",
                             "cells.strength",
                             "cells.map.points",
                             "display.orientation",
                             "loads.force",
                             "mechanics.systems.present.step.factor.panels"}) {
    INFO(column);
    CHECK(seen.contains(column));
  }
  CHECK(seen.size() >= 150);
}

TEST_CASE("columns are listed as the saved state has them", "[fracture][state_numbers]") {
  const Simulation sim = stepped(busy_scene(), 12);
  const std::string bytes = saved_state(sim);
  const std::vector<Vec3>& position = sim.state->mechanics.vertices.position;
  const std::vector<NumberColumn> columns = number_columns(sim, NumbersOf::everything);
  const auto found = std::ranges::find(columns, "mechanics.vertices.position", &NumberColumn::name);
  REQUIRE(found != columns.end());
  CHECK(found->numbers == 3 * position.size());
  double first = 0, last = 0;
  std::memcpy(&first, &bytes[found->first_byte], sizeof first);
  std::memcpy(&last, &bytes[found->last_byte], sizeof last);
  CHECK(first == position.front()[0]);
  CHECK(last == position.back()[2]);
}

TEST_CASE("step, column and first row are said", "[fracture][state_numbers]") {
  Simulation sim = stepped(busy_scene(), 12);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  sim.state->mechanics.vertices.velocity[7][1] = nan;
  sim.state->mechanics.vertices.velocity[9][1] = nan;
  sim.state->mechanics.elements.stress[4](2, 2) = nan;
  const std::vector<Finding> found = check_numbers(sim, NumbersOf::columns);
  REQUIRE(found.size() == 1);
  CHECK(found[0].count == 3);
  CHECK(found[0].text.starts_with("after step 12 (t = "));
  CHECK(
      found[0].text.ends_with("these are not numbers: mechanics.vertices.velocity of vertex 7, "
                              "mechanics.elements.stress of tetrahedron 4"));
}

// SPDX-License-Identifier: MIT
// Whole steps: a body pulled apart, one cut at rest, gravity's ramp, mistakes in a scene.
#include "fracture/simulation/simulation_state.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/living.hpp"
#include "tests/support/simulation.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

Scene bar_scene() {
  Scene scene;
  scene.bodies.push_back({.name = "bar",
                          .mesh = jittered(kuhn_box({6, 2, 2}, 0.1), 0.01, 4),
                          .material = {},
                          .held = {}});
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-3;
  return scene;
}

double total_mass(const Simulation& sim) {
  const auto& m = sim.state->mechanics.vertices.mass;
  return std::accumulate(m.begin(), m.end(), 0.0);
}

}  // namespace

TEST_CASE("a bar pulled at both ends breaks, and the map passes every law", "[fracture][scene]") {
  Scene scene = bar_scene();
  scene.bodies[0].held = {
      {.minimum = {-0.02, -1, -1}, .maximum = {0.02, 1, 1}, .velocity = {-0.001, 0, 0}},
      {.minimum = {0.58, -1, -1}, .maximum = {0.62, 1, 1}, .velocity = {0.001, 0, 0}}};
  Simulation sim = built(std::move(scene));
  const double mass = total_mass(sim);
  std::size_t fans = 0;
  for (int i = 0; i < 100; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    fans += report.fracture.fans.size();
    for (const FanEvent& fan : report.fracture.fans) {
      // A separation is always foreseen by the oracle.
      if (fan.components.created > 0) CHECK(fan.components.predicted > 0);
    }
  }
  CHECK(fans > 0);
  CHECK(living_components(sim.state->mechanics).size() > 1);
  CHECK(check(sim.state->cells.map).empty());
  CHECK(total_mass(sim) == Approx(mass).epsilon(1e-12));
  const Counts counts = count_cells(sim.state->cells.map);
  CHECK(counts.components == living_components(sim.state->mechanics).size());
  REQUIRE(counts.betti.has_value());
  CHECK((*counts.betti)[1] >= 0);
}

TEST_CASE("a body cut by command at rest keeps zero kinetic energy", "[fracture][scene]") {
  Simulation sim = built(bar_scene());
  SimulationState& s = *sim.state;
  // Cut it through the middle by hand, face by face.
  const auto faces = plane_faces(s.cells.map, CuttingPlane{{1, 0, 0}, 0.31});
  REQUIRE(faces);
  std::vector<FaceSplit> splits;
  for (const HalfFaceId f : *faces) {
    splits.push_back(split_face(s.cells.map, f));
    for (int i = 0; i < splits.back().vertex_count; ++i) {
      append_copy(s.mechanics.vertices, splits.back().split_vertices[i].old_row);
      append_copy(s.cells, splits.back().split_vertices[i].old_row);
    }
  }
  update_components(s.cells.map, splits, Detection::exact, s.cells.labels,
                    sim.scratch->fracture.components);
  s.mechanics.elements.component = s.cells.labels.of_tetrahedron;
  std::vector<ComponentId> all;
  for (std::size_t id = 0; id < s.cells.labels.size.size(); ++id) all.emplace_back(id);
  REQUIRE(all.size() == 2);
  rebuild(s.mechanics, s.cells.map.corners(), all, sim.scratch->mechanics);
  s.display.resize(2, s.display[0]);
  s.display_target = s.display;
  for (int i = 0; i < 20; ++i) REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
  // Rounding of positions of a metre moves 60 kg by 1e-16 m in 1e-3 s: far below 1e-20 J.
  CHECK(kinetic_energy(s.mechanics.vertices) < 1e-20);
}

TEST_CASE("a spinning body of 30 GPa does not break by itself", "[fracture][scene]") {
  Scene scene = bar_scene();
  scene.bodies[0].spin = {0, 0, 50};
  scene.integrator.time_step = 0.01;
  Simulation sim = built(std::move(scene));
  const Vec3 before = angular_momentum(sim.state->mechanics.vertices);
  for (int i = 0; i < 200; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    REQUIRE(report.fracture.fans.empty());
  }
  CHECK((angular_momentum(sim.state->mechanics.vertices) - before).norm() < 1e-10 * before.norm());
}

TEST_CASE("breaking keeps mass and momentum, and the two runs of a scene are the same",
          "[fracture][scene]") {
  const auto run = [] {
    Scene scene = bar_scene();
    scene.bodies[0].spin = {3, 20, 650};
    scene.integrator.time_step = 1e-4;
    Simulation sim = built(std::move(scene));
    const Vec3 P = momentum(sim.state->mechanics.vertices);
    const Vec3 L = angular_momentum(sim.state->mechanics.vertices);
    std::size_t fans = 0;
    for (int i = 0; i < 60; ++i) fans += advance(sim).fracture.fans.size();
    CHECK(fans > 0);
    // Rim speed 200 m/s, 58 kg: relative to the momenta of the pieces one by one.
    CHECK((momentum(sim.state->mechanics.vertices) - P).norm() < 1e-10 * 58 * 200);
    return std::pair{sim.state->mechanics.vertices.position, L};
  };
  const auto [first, L1] = run();
  const auto [second, L2] = run();
  REQUIRE(first.size() == second.size());
  for (std::size_t v = 0; v < first.size(); ++v) REQUIRE(first[v] == second[v]);
}

TEST_CASE("gravity is raised linearly over its ramp", "[fracture][scene]") {
  const GravitySettings ramp{.acceleration = {0, 0, -10}, .ramp_time = 2};
  CHECK(gravity_at(ramp, 0).norm() == 0);
  CHECK(gravity_at(ramp, 1).z() == Approx(-5));
  CHECK(gravity_at(ramp, 5).z() == Approx(-10));
  CHECK(gravity_at({}, 0).z() == Approx(-9.81));
}

TEST_CASE("a scene's mistakes are all told, with their place", "[fracture][scene]") {
  Scene scene = bar_scene();
  scene.bodies[0].material.poisson_ratio = 0.5;
  scene.bodies[0].material.density = -1;
  scene.bodies[0].mesh.tetrahedra[0][1] = 9999;
  const Result<Simulation> sim = build_simulation(scene);
  CHECK(!sim);
  CHECK(sim.findings.size() >= 3);
  Scene held = bar_scene();
  held.bodies[0].held = {{.minimum = {5, 5, 5}, .maximum = {6, 6, 6}}};
  const Result<Simulation> nothing = build_simulation(held);
  CHECK(!nothing);
  REQUIRE(!nothing.findings.empty());
  CHECK(nothing.findings.back().code == "nothing_held");
}

// SPDX-License-Identifier: MIT
// The energy a fan would release, against splitting a copy of the body and solving it again.
#include "fracture/energy/energy_release.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <optional>
#include <random>

#include "fracture/algorithms/split_fan.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// A shaken block held at one end, its other end pulled, under gravity.
Simulation loaded_block(std::mt19937& random, std::uint32_t order) {
  Scene scene;
  BodySettings block;
  block.mesh = suite::kuhn_box({5, 3, 3}, 0.1);
  std::uniform_real_distribution<double> shift(-0.015, 0.015);
  for (Point& p : block.mesh.points) {
    const bool inside = p[0] > 0.01 && p[0] < 0.49;
    if (inside) p = {p[0] + shift(random), p[1] + shift(random), p[2] + shift(random)};
  }
  block.order = order;
  block.rotation = Eigen::Quaterniond(0.8, 0.2, -0.4, 0.4).normalized();
  block.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  block.loads = {
      {.minimum = {0.5 - 1e-6, -1, -1}, .maximum = {9, 9, 9}, .pressure = -1e6},
      {.minimum = {0.2, 0.3 - 1e-6, -1}, .maximum = {9, 9, 9}, .force = {1e3, 2e3, 3e3}}};
  scene.bodies = {block};
  return std::move(*build_simulation(std::move(scene)));
}

Loads full_loads(const Simulation& sim, const MechanicsState& m, std::span<const Corners> corners) {
  Loads loads{.gravity = sim.scene.gravity.acceleration};
  add_corner_loads(loads.force, sim.state->loads, m, corners,
                   std::numeric_limits<double>::infinity());
  add_consistent_weight(loads.force, m, corners, loads.gravity);
  return loads;
}

double potential(const MechanicsState& m, const Loads& loads) {
  double energy = strain_energy(m) + gravity_energy(m.vertices, loads.gravity);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    energy -= loads.force[v].dot(m.vertices.position[v]);
  }
  return energy;
}

/// Splits a copy of the body and puts it into equilibrium again; nothing where it has none.
std::optional<double> slow_release(const Simulation& sim, std::span<const HalfFaceId> faces) {
  Cells cells = sim.state->cells;
  MechanicsState m = sim.state->mechanics;
  const double before = potential(m, full_loads(sim, m, cells.map.corners()));
  std::vector<FaceSplit> splits;
  for (const HalfFaceId face : faces) {
    std::vector<VertexCopy> nodes;
    splits.push_back(part_face({cells, m}, face, nodes));
  }
  ComponentScratch search;
  update_components(cells.map, splits, Detection::exact, cells.labels, search);
  m.elements.component = cells.labels.of_tetrahedron;
  std::vector<ComponentId> all;
  for (std::size_t c = 0; c < cells.labels.size.size(); ++c) all.emplace_back(c);
  MechanicsScratch scratch;
  rebuild(m, cells.map.corners(), all, scratch);
  const Loads loads = full_loads(sim, m, cells.map.corners());
  if (!solve_static(m, scratch, cells.map.corners(), loads).empty()) return {};
  return before - potential(m, loads);
}

}  // namespace

TEST_CASE("energy released by fans of random bodies is that of a copy split and solved anew",
          "[fracture][energy_release]") {
  const auto seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  int compared = 0;
  for (std::uint32_t round = 0; round < 4; ++round) {
    Simulation sim = loaded_block(random, 1 + round % 2);
    MechanicsState& m = sim.state->mechanics;
    const auto corners = sim.state->cells.map.corners();
    REQUIRE(solve_static(m, sim.scratch->mechanics, corners, full_loads(sim, m, corners)).empty());
    const std::vector<Vec3> force =
        node_loads(sim.state->loads, m, std::numeric_limits<double>::infinity());
    const ReleaseInput input{sim.state->cells, m, sim.scene.gravity.acceleration, force};
    for (int k = 0; k < (round % 2 == 0 ? 40 : 200); ++k) {
      const VertexId v{random() % m.vertices.size()};
      if (sim.state->cells.map.is_node(v)) continue;
      const Vec3 across{normal(random), normal(random), normal(random)};
      const auto faces = fan_faces(sim.state->cells.map, v, {across.x(), across.y(), across.z()});
      const auto release = energy_release(input, *faces, across);
      REQUIRE(release);
      if (faces->empty()) continue;
      const std::optional<double> slow = slow_release(sim, *faces);
      CHECK(release->comes_free != slow.has_value());
      if (!slow || release->copies == 0) continue;
      CHECK(release->projected > 0);
      CHECK(release->projected <= release->area * (1 + 1e-12));
      CHECK(release->energy == Approx(*slow).epsilon(1e-6).margin(1e-9 * strain_energy(m)));
      ++compared;
    }
  }
  CHECK(compared > 40);
}

TEST_CASE("a section through a bar pulled between two grips releases sigma^2 L / (2 E) per area",
          "[fracture][energy_release]") {
  constexpr double young = 1e9, pull = 2e-4, length = 0.8;
  Scene scene;
  BodySettings bar;
  bar.mesh = suite::kuhn_box({8, 2, 2}, 0.1);
  bar.material = {.young_modulus = young, .poisson_ratio = 0, .density = 1000};
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}},
              {.minimum = {length - 1e-6, -1, -1}, .maximum = {9, 9, 9}}};
  scene.bodies = {bar};
  Simulation sim = std::move(*build_simulation(std::move(scene)));
  MechanicsState& m = sim.state->mechanics;
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    if (m.vertices.rest_position[v].x() > length - 1e-9) m.vertices.displacement[v].x() = pull;
  }
  REQUIRE(solve_static(m, sim.scratch->mechanics, sim.state->cells.map.corners(), {}).empty());
  const auto faces =
      plane_faces(sim.state->cells.map, CuttingPlane{.normal = {1, 0, 0}, .offset = 0.4});
  const std::vector<Mat3> stress = m.elements.stress;
  const auto release = energy_release({sim.state->cells, m}, *faces, Vec3::UnitX());
  REQUIRE(release);
  const double sigma = young * pull / length;
  CHECK(release->area == Approx(0.04).epsilon(1e-12));
  CHECK(release->projected == Approx(0.04).epsilon(1e-12));
  const auto tilted = energy_release({sim.state->cells, m}, *faces, {3, 4, 0});
  REQUIRE(tilted);
  CHECK(tilted->projected == Approx(0.024).epsilon(1e-12));
  CHECK(tilted->energy == release->energy);
  CHECK(release->per_area() == Approx(sigma * sigma * length / (2 * young)).epsilon(1e-9));
  CHECK(m.elements.stress == stress);
  CHECK(sim.state->cells.map.vertices() == m.vertices.size());
}

TEST_CASE("a piece that comes free releases what strained it, or without end what a load drives",
          "[fracture][energy_release]") {
  Scene scene;
  BodySettings bar;
  bar.mesh = suite::kuhn_box({6, 2, 2}, 0.1);
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  scene.bodies = {bar};
  Simulation sim = std::move(*build_simulation(std::move(scene)));
  MechanicsState& m = sim.state->mechanics;
  const auto section =
      plane_faces(sim.state->cells.map, CuttingPlane{.normal = {1, 0, 0}, .offset = 0.3});
  const auto at_rest = energy_release({sim.state->cells, m}, *section, Vec3::UnitX());
  REQUIRE(at_rest);
  CHECK(at_rest->comes_free);
  CHECK(at_rest->energy == 0);
  const Vec3 gravity{0, 0, -9.81};
  const auto corners = sim.state->cells.map.corners();
  REQUIRE(solve_static(m, sim.scratch->mechanics, corners, {.gravity = gravity}).empty());
  const auto loaded = energy_release({sim.state->cells, m, gravity}, *section, Vec3::UnitX());
  REQUIRE(loaded);
  CHECK(std::isinf(loaded->energy));
}

TEST_CASE("a free body has no energy release in statics", "[fracture][energy_release]") {
  Scene scene;
  BodySettings body;
  body.mesh = suite::kuhn_box({2, 2, 2}, 0.1);
  scene.bodies = {body};
  Simulation sim = std::move(*build_simulation(std::move(scene)));
  const auto faces =
      plane_faces(sim.state->cells.map, CuttingPlane{.normal = {1, 0, 0}, .offset = 0.1});
  const auto release =
      energy_release({sim.state->cells, sim.state->mechanics}, *faces, Vec3::UnitX());
  REQUIRE(!release);
  CHECK(release.findings.front().code == "not_supported");
}

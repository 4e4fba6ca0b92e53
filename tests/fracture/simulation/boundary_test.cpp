// SPDX-License-Identifier: MIT
// Bodies that stand round an impact window: they keep the laws, and nothing passes through them.
#include "fracture/simulation/boundary.hpp"

#include <catch2/catch.hpp>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Cubes of 0.2 m in a row along x, a little shifted sideways, `gap` apart.
Scene row_of_cubes(int count, double gap) {
  Scene scene;
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  for (int k = 0; k < count; ++k) {
    BodySettings cube;
    cube.mesh = suite::kuhn_box({2, 2, 2}, 0.1);
    cube.translation = {k * (0.2 + gap), 0.01 * k, 0.005 * k};
    scene.bodies.push_back(cube);
  }
  return scene;
}

Vec3 angular_momentum_of(const Simulation& sim) {
  Vec3 sum = Vec3::Zero();
  for (const Component& c : sim.state->mechanics.components) {
    sum += c.centre.cross(c.momentum) + c.angular_momentum;
  }
  return sum;
}

Vec3 momentum_of(const Simulation& sim) {
  Vec3 sum = Vec3::Zero();
  for (const Component& c : sim.state->mechanics.components) sum += c.momentum;
  return sum;
}

double energy_of(const Simulation& sim) {
  return kinetic_energy(sim.state->mechanics.vertices) + strain_energy(sim.state->mechanics);
}

}  // namespace

TEST_CASE("what stands round an impact window keeps momentum and gains no energy",
          "[fracture][impact]") {
  const double step = GENERATE(1e-4, 1e-3);
  Scene scene = row_of_cubes(6, 2e-4);
  scene.bodies[0].velocity = {2, 0.3, 0};
  scene.bodies[0].spin = {0, 0, 1};
  scene.integrator.time_step = step;
  Simulation sim = built(std::move(scene));
  const Vec3 P = momentum_of(sim), L = angular_momentum_of(sim);
  double energy = energy_of(sim);
  std::uint32_t carried = 0;
  for (double t = 0; t < 0.02; t += step) {
    carried = std::max(carried, advance(sim).impact.carried);
    INFO("at " << t << " s");
    CHECK((momentum_of(sim) - P).norm() < 1e-12 * P.norm());
    CHECK((angular_momentum_of(sim) - L).norm() < 1e-11 * L.norm());
    const double now = energy_of(sim);
    CHECK(now <= energy * (1 + 1e-9));
    energy = now;
    const auto& c = sim.state->mechanics.components;
    for (std::size_t k = 1; k < 6; ++k) {
      // Balls of tetrahedra meet late.
      CHECK(c[k].centre.x() - c[k - 1].centre.x() > 0.15);
      CHECK(c[k].rung != Rung::carried);
    }
  }
  CHECK(carried > 0);
}

TEST_CASE("the energy ledger closes where carried bodies fall", "[fracture][impact]") {
  Scene scene = row_of_cubes(6, 2e-4);
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.bodies[0].velocity = {2, 0.3, 0};
  for (BodySettings& body : scene.bodies) body.velocity.z() = -3;
  scene.energy_ledger = true;
  Simulation sim = built(std::move(scene));
  std::uint32_t carried = 0;
  for (int k = 0; k < 20; ++k) {
    const StepReport report = advance(sim);
    carried = std::max(carried, report.impact.carried);
    INFO("step " << k);
    CHECK(std::abs(report.energy.residual) < 1e-4 * report.energy.moved);
  }
  CHECK(carried > 0);
}

TEST_CASE("a body that is carried and not touched ends with the bytes of its whole step",
          "[fracture][impact]") {
  Scene scene = row_of_cubes(3, 0.02);
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.bodies[2].spin = {1, 2, 3};
  Simulation sim = built(std::move(scene));
  for (int k = 0; k < 3; ++k) advance(sim);
  SimulationState& s = *sim.state;
  const std::vector<Vec3> position = s.mechanics.vertices.position;
  const std::vector<Vec3> velocity = s.mechanics.vertices.velocity;
  Boundary boundary;
  const ComponentId open{0};
  assign_roles(boundary, s, {&open, 1}, 0.05);
  CHECK(boundary.component[0] == Role::member);
  CHECK(boundary.component[1] == Role::member);
  REQUIRE(boundary.component[2] == Role::carried);
  begin_boundary(boundary, s, {0, 0, -9.81}, 1e-3);
  CHECK(s.mechanics.components[2].rung == Rung::carried);
  CHECK(s.mechanics.vertices.position != position);
  end_boundary(boundary, s);
  CHECK(s.mechanics.vertices.position == position);
  CHECK(s.mechanics.vertices.velocity == velocity);
}

// SPDX-License-Identifier: MIT
// Forces on obstacles and held boxes and works of loads, compared with closed forms and the
// ledgers.
#include "fracture/simulation/ledger/force_report.hpp"

#include <catch2/catch.hpp>

#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A bar along x, from 0 to 0.4 m, of section 0.1 x 0.1 m, that does not thin as it is pulled.
BodySettings bar() {
  BodySettings body;
  body.mesh = suite::kuhn_box({8, 2, 2}, 0.05);
  body.material.poisson_ratio = 0;
  return body;
}
constexpr double length = 0.4, section = 0.01;

HeldBox held_at(double x) { return {.minimum = {x - 1e-6, -1, -1}, .maximum = {x + 1e-6, 1, 1}}; }

Scene still_scene() {
  Scene scene;
  scene.fracture.mode = FractureMode::off;
  scene.gravity.acceleration.setZero();
  return scene;
}

/// Sums over the reports of several steps.
struct Sum {
  ForceReport forces;
  MomentumLedger momentum;
  double load_work = 0;

  Sum(Simulation& sim, int steps) : forces(no_forces(sim.scene)) {
    sim.reports_forces = true;
    for (int k = 0; k < steps; ++k) {
      const StepReport report = advance(sim);
      for (std::size_t i = 0; i < forces.obstacle.size(); ++i) {
        forces.obstacle[i] += report.forces.obstacle[i];
      }
      for (std::size_t i = 0; i < forces.held.size(); ++i) forces.held[i] += report.forces.held[i];
      for (std::size_t i = 0; i < forces.load_work.size(); ++i) {
        forces.load_work[i] += report.forces.load_work[i];
      }
      add_step(momentum, report.momentum);
      load_work += report.energy.loads;
    }
  }
};

}  // namespace

TEST_CASE("the floor bears the weight of what rests on it, below its centre", "[forces]") {
  Scene scene = still_scene();
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.ladder.sleep = false;
  scene.obstacles.push_back({Plane{}});
  scene.bodies.push_back(bar());
  scene.bodies[0].translation = {0.3, -0.2, 0};
  scene.bodies[0].rigid = GENERATE(false, true);
  Simulation sim = built(std::move(scene));
  Sum(sim, 600);
  const int steps = 100;
  const Sum sum(sim, steps);
  const double h = sim.scene.integrator.time_step;
  const double weight = 9.81 * sim.state->mechanics.components[0].mass;
  const Vec3 force = sum.forces.obstacle[0].head<3>() / (steps * h);
  CHECK(force[2] == Approx(-weight).epsilon(1e-4));
  CHECK(std::abs(force[0]) < 1e-4 * weight);
  const Vec3 moment = sum.forces.obstacle[0].tail<3>() / (steps * h);
  const Vec3 expected = Vec3(0.3 + 0.2, -0.2 + 0.05, 0).cross(Vec3(0, 0, -weight));
  CHECK((moment - expected).norm() < 1e-3 * expected.norm());
}

TEST_CASE("impulses of obstacles and held boxes are those of the momentum ledger", "[forces]") {
  Scene scene = still_scene();
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.obstacles.push_back({Plane{}});
  scene.obstacles.push_back({.shape = Sphere{{0.2, 0.05, 0.3}, 0.05}, .mass = 3.0});
  scene.obstacles[1].velocity = {0, 0, -3};
  scene.bodies.push_back(bar());
  scene.bodies[0].translation = {0, 0, 0.1};
  scene.bodies[0].held = {held_at(0), held_at(length)};
  scene.bodies.push_back(bar());
  scene.bodies[1].translation = {0.1, 0.3, 0.05};
  scene.bodies[1].velocity = {0, -0.5, -2};
  scene.ladder.sleep = false;
  scene.ladder.rubble = GENERATE(RubbleMode::off, RubbleMode::certified);
  Simulation sim = built(std::move(scene));
  const Sum sum(sim, 400);
  const Impulse& given = sum.momentum.obstacles;
  CHECK(given.head<3>().norm() > 1);
  CHECK((given + sum.forces.obstacle[0]).norm() < 1e-9 * given.norm());
  const Impulse held = sum.forces.held[0] + sum.forces.held[1];
  CHECK(held.head<3>().norm() > 1);
  CHECK((held - sum.momentum.supports).norm() < 1e-9 * held.norm());
  CHECK(sum.forces.obstacle[1].head<3>().norm() > 1);
}

TEST_CASE("impulses of rubble on driven obstacles are those of the momentum ledger", "[forces]") {
  Scene scene = still_scene();
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.obstacles.push_back({Plane{}});
  scene.obstacles.push_back(
      {Box{{0.2, 0.05, 0.06}, Eigen::Quaterniond::Identity(), {0.03, 0.2, 0.06}}});
  for (int k = 0; k < 4; ++k) {
    scene.bodies.push_back(bar());
    scene.bodies[static_cast<std::size_t>(k)].translation = {0.02 * k, 0.01 * k, 0.13 + 0.12 * k};
    scene.bodies[static_cast<std::size_t>(k)].rigid = true;
  }
  scene.bodies[3].translation = {0.5, 0.1, 0.01};
  scene.ladder.rubble = RubbleMode::certified;
  scene.ladder.sleep = false;  // the ledger counts sleeping rubble as an obstacle
  Simulation sim = built(std::move(scene));
  const Sum sum(sim, 300);
  const Impulse all = sum.forces.obstacle[0] + sum.forces.obstacle[1];
  const Impulse& given = sum.momentum.obstacles;
  CHECK(sum.forces.obstacle[0].head<3>().norm() > 1);
  CHECK(sum.forces.obstacle[1].head<3>().norm() > 1);
  CHECK((all + given).norm() < 1e-9 * given.norm());
}

TEST_CASE("a bar that is pulled slowly shows E A / L at both ends", "[forces]") {
  Scene scene = still_scene();
  scene.bodies.push_back(bar());
  scene.bodies[0].order = GENERATE(1u, 2u);
  HeldBox pulled = held_at(length);
  pulled.velocity = {1e-4, 0, 0};
  pulled.ramp_time = 0.1;
  scene.bodies[0].held = {held_at(0), pulled};
  scene.integrator.damping.stiffness_factor = 1e-4;
  Simulation sim = built(std::move(scene));
  const double h = sim.scene.integrator.time_step;
  Sum(sim, static_cast<int>(0.3 / h));
  const int steps = 50;
  const double from = sim.state->mechanics.time - 0.05;
  const Sum sum(sim, steps);
  const double to = sim.state->mechanics.time - 0.05;
  const double stiffness = sim.scene.bodies[0].material.young_modulus * section / length;
  const double expected = stiffness * 1e-4 * 0.5 * (from + to);
  CHECK(sum.forces.held[1][0] / (steps * h) == Approx(expected).epsilon(5e-3));
  CHECK(sum.forces.held[0][0] / (steps * h) == Approx(-expected).epsilon(5e-3));
}

TEST_CASE("works of loads are force times way, and together the ledger's", "[forces]") {
  Scene scene = still_scene();
  scene.bodies.push_back(bar());
  scene.bodies[0].held = {held_at(0)};
  LoadBox pull;
  pull.minimum = {length - 1e-6, -1, -1};
  pull.maximum = {length + 1e-6, 1, 1};
  pull.force = {1e5, 0, 0};
  LoadBox press;
  press.minimum = {-1, -1, 0.1 - 1e-6};
  press.maximum = {1, 1, 0.1 + 1e-6};
  press.pressure = 1e5;
  press.ramp_time = 0.01;
  scene.bodies[0].loads = {pull, press};
  Simulation sim = built(std::move(scene));
  const MechanicsState& m = sim.state->mechanics;
  const std::vector<Vec3> before = m.vertices.position;
  const Sum sum(sim, 40);
  double way = 0;
  int ends = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (m.vertices.rest_position[v][0] < length - 1e-6) continue;
    way += m.vertices.position[v][0] - before[v][0];
    ++ends;
  }
  CHECK(way > 0);
  CHECK(sum.forces.load_work[0] == Approx(1e5 * way / ends).epsilon(1e-9));
  CHECK(sum.forces.load_work[1] != 0);
  CHECK(sum.forces.load_work[0] + sum.forces.load_work[1] == Approx(sum.load_work).epsilon(1e-9));
}

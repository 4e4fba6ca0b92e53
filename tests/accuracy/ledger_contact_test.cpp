// SPDX-License-Identifier: MIT
// The energy ledger where bodies are struck, slide, are pulled by their supports, or break.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

BodySettings bar_of(suite::Cells cells, double cell) {
  BodySettings bar;
  bar.mesh = suite::kuhn_box(cells, cell);
  bar.material = {.young_modulus = 1e9, .poisson_ratio = 0.2, .density = 1000};
  return bar;
}

Scene scene_of(std::vector<BodySettings> bodies) {
  Scene scene;
  scene.bodies = std::move(bodies);
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  return scene;
}

/// Sum of the ledgers of `steps` steps, `residual` as the sum of sizes.
EnergyLedger run(Scene scene, int steps, double* damping = nullptr) {
  Result<Simulation> sim = build_simulation(std::move(scene));
  REQUIRE(sim);
  EnergyLedger sum;
  for (int i = 0; i < steps; ++i) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    const EnergyLedger& e = report.energy;
    sum.kinetic += e.kinetic;
    sum.strain += e.strain;
    sum.gravity += e.gravity;
    sum.contact += e.contact;
    sum.friction += e.friction;
    sum.supports += e.supports;
    sum.numerical += e.numerical;
    sum.residual += std::abs(e.residual);
    sum.moved += e.moved;
    if (damping) *damping += report.status.damping_work;
  }
  return sum;
}

}  // namespace

TEST_CASE("the ledger of a blow closes through all its sub-steps", "[accuracy][ledger][impact]") {
  BodySettings bar = bar_of({8, 2, 2}, 0.1);
  bar.velocity = {-2, 0, 0};
  bar.translation = {0.001, 0, 0};
  bar.rotation = Eigen::AngleAxisd(GENERATE(0.0, 0.2), Vec3(0, 0.6, 0.8));
  Scene scene = scene_of({bar});
  scene.obstacles = {{.shape = Plane{.normal = {1, 0, 0}, .offset = -0.2}, .friction = 0.3}};
  scene.integrator.time_step = GENERATE(5e-5, 5e-4);
  double damping = 0;
  const double mass = 1000 * 0.8 * 0.04, start = 0.5 * mass * 4;
  const EnergyLedger sum =
      run(scene, static_cast<int>(std::lround(0.15 / scene.integrator.time_step)), &damping);
  INFO("of " << start << " J: kinetic " << sum.kinetic << ", strain " << sum.strain << ", contact "
             << sum.contact << ", friction " << sum.friction << ", scheme " << sum.numerical
             << ", viscosity " << damping << ", residual " << sum.residual);
  CHECK(sum.kinetic < -0.05 * start);  // it was struck
  // A wall at rest takes energy by friction and by stopping the lumped layer that touches, which in
  // that sub-step still moves towards it.
  CHECK(sum.contact < -sum.friction + 0.02 * start);
  CHECK(sum.contact > -sum.friction - 0.07 * start);
  CHECK(sum.friction > -1e-9 * start);
  CHECK(sum.numerical > 0);
  CHECK(sum.residual < 1e-4 * start);
}

TEST_CASE("a sliding block turns its kinetic energy into heat of friction", "[accuracy][ledger]") {
  BodySettings block = bar_of({3, 3, 3}, 0.1);
  block.velocity = {1, 0, 0};
  Scene scene = scene_of({block});
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.obstacles = {{.shape = Plane{}, .friction = 0.5}};
  scene.contact.friction = 0.5;
  scene.integrator.time_step = GENERATE(1e-4, 1e-3);
  const EnergyLedger sum =
      run(scene, static_cast<int>(std::lround(0.3 / scene.integrator.time_step)));
  const double start = 0.5 * 27;
  INFO("kinetic " << sum.kinetic << ", friction " << sum.friction << ", contact " << sum.contact
                  << ", scheme " << sum.numerical << ", residual " << sum.residual);
  CHECK(sum.kinetic == Approx(-start).epsilon(1e-3));
  CHECK(sum.friction == Approx(start).epsilon(0.03));
  CHECK(sum.contact == Approx(-sum.friction).epsilon(0.03));
  CHECK(sum.residual < 0.05 * start);
}

TEST_CASE("the ledger closes on the springs of penalty, which store what it does not count",
          "[accuracy][ledger]") {
  BodySettings block = bar_of({3, 3, 3}, 0.1);
  block.velocity = {1, 0, -2};
  block.translation = {0, 0, 0.01};
  Scene scene = scene_of({block});
  scene.obstacles = {{.shape = Plane{}, .friction = 0.5}};
  scene.contact.method = ContactMethod::penalty;
  scene.contact.penalty_damping = GENERATE(0.0, 100.0);
  scene.integrator.time_step = 1e-4;
  const EnergyLedger sum = run(scene, 1000);
  INFO("kinetic " << sum.kinetic << ", strain " << sum.strain << ", friction " << sum.friction
                  << ", contact " << sum.contact << ", scheme " << sum.numerical << ", residual "
                  << sum.residual);
  CHECK((sum.friction > 1) == (scene.contact.penalty_damping > 0));
  CHECK(sum.residual < 1e-4 * sum.moved);
}

TEST_CASE("a bar pulled by its ends takes the work of its supports", "[accuracy][ledger]") {
  BodySettings bar = bar_of({8, 2, 2}, 0.1);
  bar.material.poisson_ratio = 0;
  const double speed = 0.01, time = 0.02;
  const bool both = GENERATE(false, true);
  bar.held = {
      {.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}, .velocity = {both ? -speed / 2 : 0, 0, 0}},
      {.minimum = {0.8 - 1e-6, -1, -1},
       .maximum = {9, 9, 9},
       .velocity = {both ? speed / 2 : speed, 0, 0}}};
  Scene scene = scene_of({bar});
  scene.integrator.time_step = GENERATE(1e-5, 1e-3);
  scene.integrator.damping.stiffness_factor = GENERATE(0.0, 1e-5);
  double damping = 0;
  const EnergyLedger sum =
      run(scene, static_cast<int>(std::lround(time / scene.integrator.time_step)), &damping);
  const double strain = speed * time / 0.8;
  const double expected = 0.5 * 1e9 * strain * strain * 0.8 * 0.04;
  INFO("strain " << sum.strain << " of " << expected << ", supports " << sum.supports << ", scheme "
                 << sum.numerical << ", damping " << damping << ", residual " << sum.residual);
  CHECK(sum.strain == Approx(expected).epsilon(0.02));
  CHECK(sum.supports == Approx(expected).epsilon(0.1));
  CHECK(sum.residual < 1e-6 * expected);
}

TEST_CASE("Rayleigh damping closes the ledger to rounding", "[accuracy][ledger]") {
  BodySettings bar = bar_of({8, 2, 2}, 0.1);
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  bar.loads = {{.minimum = {0.8 - 1e-6, -1, -1}, .maximum = {9, 9, 9}, .pressure = -1e5}};
  Scene scene = scene_of({bar});
  scene.integrator.time_step = GENERATE(1e-5, 1e-4, 1e-2);
  scene.integrator.rho_infinity = GENERATE(0.0, 0.5);
  scene.integrator.damping = {.mass_factor = 20, .stiffness_factor = 1e-5};
  double damping = 0;
  const EnergyLedger sum = run(scene, 100, &damping);
  CHECK(damping > 0);
  CHECK(sum.residual < 1e-9 * sum.moved);
}

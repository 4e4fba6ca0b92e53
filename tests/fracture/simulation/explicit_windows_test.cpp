// SPDX-License-Identifier: MIT
// Impact windows with explicit steps in whole simulations: ledgers, cracks, the stress of a bar.
#include <catch2/catch.hpp>
#include <cmath>

#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/state/living.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A block that falls on a plane, turned and spinning, and a ball that strikes it.
Scene struck_block(std::uint32_t order) {
  BodySettings block;
  block.mesh = suite::kuhn_box({3, 2, 2}, 0.1);
  block.order = order;
  block.rotation = Eigen::AngleAxisd(0.4, Vec3(1, 0.3, 0).normalized());
  double low = 0;
  for (const Point& p : block.mesh.points) {
    low = std::min(low, (block.rotation * Vec3(p[0], p[1], p[2])).z());
  }
  block.translation = {0, 0, 1e-4 - low};
  block.velocity = {0.5, 0, -6};
  block.spin = {1, 2, -1};
  block.material.young_modulus = 1e10;
  Scene scene;
  scene.bodies = {block};
  scene.obstacles = {{.shape = Plane{}, .friction = 0.5},
                     {.shape = Sphere{Vec3(0.15, 0.1, 0.4), 0.05},
                      .velocity = {0, 0, -20},
                      .friction = 0.3,
                      .mass = 2}};
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.integrator.time_step = 2e-4;
  scene.energy_ledger = true;
  return scene;
}

}  // namespace

TEST_CASE("ledgers of explicit windows close, with cracks or without", "[fracture][impact]") {
  const auto order = GENERATE(1u, 2u);
  const auto mode = GENERATE(CrackMode::paper, CrackMode::object, CrackMode::cohesive);
  const bool breaks = GENERATE(true, false);
  const bool is_loaded = GENERATE(true, false);
  Scene scene = struck_block(order);
  if (is_loaded) {
    // Over the upper half, so that pieces that come off bear loads too.
    scene.bodies[0].loads = {{.minimum = {-1, -1, 0.1 - 1e-6},
                              .maximum = {1, 1, 1},
                              .pressure = 1e5,
                              .force = {3000, 1000, 0}}};
  }
  scene.fracture.crack = mode;
  if (mode == CrackMode::cohesive) scene.bodies[0].material.fracture_energy = 40;
  if (!breaks) scene.fracture.mode = FractureMode::off;
  Simulation sim = built(std::move(scene));
  Impulse missing = Impulse::Zero();
  double residual = 0, moved = 0, damping = 0;
  std::size_t fans = 0, sub_steps = 0;
  for (int k = 0; k < 25; ++k) {
    const Impulse start = total_momentum(*sim.state);
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    // Whole steps take a part of a load's moment at another place.
    if (is_loaded && report.impact.sub_steps == 0) continue;
    missing += total_momentum(*sim.state) - start - report.momentum.gravity -
               report.momentum.obstacles - report.momentum.loads - report.momentum.supports -
               report.momentum.sleep;
    residual += report.energy.residual;
    moved += report.energy.moved;
    damping += report.status.damping_work;
    fans += report.fracture.fans.size();
    sub_steps += report.impact.sub_steps;
  }
  INFO("order " << order << ", mode " << static_cast<int>(mode) << ", " << fans << " fans, "
                << (is_loaded ? "loaded" : "free"));
  CHECK(sub_steps > 10);
  CHECK((fans > 0) == breaks);
  const double size = 0.012 * 2400 * 6;
  CHECK(missing.head<3>().norm() < 1e-9 * size);
  CHECK(missing.tail<3>().norm() < 1e-9 * size);
  CHECK(std::abs(residual) < 1e-4 * moved);
  CHECK(damping > 0);
}

TEST_CASE("a bar that strikes a wall has the stress of rho c v, at any step",
          "[fracture][impact]") {
  const double step = GENERATE(2e-6, 1e-5, 1e-3);
  BodySettings bar;
  bar.mesh = suite::kuhn_box({1, 1, 20}, 0.05);
  bar.material.poisson_ratio = 0;
  bar.translation = {0, 0, 1e-6};
  const double speed = 0.1;
  bar.velocity = {0, 0, -speed};
  const double stress = bar.material.density * compression_wave_speed(bar.material) * speed;
  Scene scene;
  scene.bodies = {bar};
  scene.obstacles = {{.shape = Plane{}, .friction = 0}};
  scene.contact.friction = 0;
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = step;
  scene.impact.by_energy = false;
  scene.impact.negligible = 1e-3;
  scene.fracture.mode = FractureMode::off;
  Simulation sim = built(std::move(scene));
  double peak = 0;
  while (simulated_time(sim) < 8e-4) {
    advance(sim, [&](const Simulation& now, const PartReport&) {
      for (const Mat3& sigma : now.state->mechanics.elements.stress) {
        peak = std::max(peak, -sigma(2, 2));
      }
    });
  }
  INFO("step " << step);
  CHECK(peak == Approx(stress).epsilon(0.05));
}

TEST_CASE("pieces that nothing strikes are rigid within explicit steps alone",
          "[fracture][impact]") {
  Scene scene = struck_block(1);
  scene.fracture.crack = CrackMode::object;
  scene.bodies[0].material.tensile_strength = 2e5;
  Simulation sim = built(std::move(scene));
  std::size_t stiff = 0, deforming = 0;
  const StepObserver count = [&](const Simulation& now, const PartReport& part) {
    for (const Component& c : now.state->mechanics.components) {
      if (c.rung != Rung::stiff) continue;
      CHECK(part.deformation == Deformation::wave);
      CHECK(now.state->impact.quiet[c.id.index()] == ImpactWindow::closed);
      ++stiff;
      for (const VertexId v : c.vertices) {
        deforming += !now.state->mechanics.vertices.displacement_rate[v.index()].isZero(0);
      }
    }
  };
  double residual = 0, moved = 0;
  for (int k = 0; k < 25; ++k) {
    const StepReport report = advance(sim, count);
    residual += report.energy.residual;
    moved += report.energy.moved;
    for (const Component& c : sim.state->mechanics.components) CHECK(c.rung != Rung::stiff);
  }
  CHECK(stiff > 0);
  CHECK(deforming == 0);
  CHECK(std::abs(residual) < 1e-4 * moved);
}

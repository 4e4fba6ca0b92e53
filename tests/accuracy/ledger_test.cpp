// SPDX-License-Identifier: MIT
// The energy ledger of a step in cases with every term known.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// A bar of 0.8 x 0.2 x 0.2 m along x, free, nothing breaks.
Scene bar_scene() {
  Scene scene;
  BodySettings bar;
  bar.mesh = suite::kuhn_box({8, 2, 2}, 0.1);
  bar.material = {.young_modulus = 1e9, .poisson_ratio = 0, .density = 1000};
  scene.bodies.push_back(std::move(bar));
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  return scene;
}

Simulation built(const Scene& scene) {
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  return std::move(*sim);
}

double energy(const Simulation& sim) {
  return kinetic_energy(sim.state->mechanics.vertices) + strain_energy(sim.state->mechanics);
}

}  // namespace

TEST_CASE("in a fall gravity's work is the kinetic energy", "[accuracy][ledger]") {
  Scene scene = bar_scene();
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.bodies[0].velocity = {1, 2, 3};
  scene.integrator.time_step = GENERATE(1e-3, 1.0 / 60);
  Simulation sim = built(scene);
  const double mass = 1000 * 0.8 * 0.04, h = scene.integrator.time_step;
  double work = 0;
  for (int i = 0; i < 50; ++i) {
    const EnergyLedger ledger = advance(sim).energy;
    const double whole = kinetic_energy(sim.state->mechanics.vertices);
    // m g . dx on the parabola, and the change of m v^2 / 2, to rounding of the sums.
    CHECK(std::abs(ledger.kinetic - ledger.gravity) < 1e-11 * whole);
    CHECK(std::abs(ledger.residual) < 1e-11 * whole);
    work += ledger.gravity;
  }
  const double t = 50 * h;
  CHECK(work == Approx(-mass * 9.81 * (3 * t - 9.81 * t * t / 2)).epsilon(1e-9));
}

TEST_CASE("a body spinning in its equilibrium loses nothing", "[accuracy][ledger]") {
  Scene scene = bar_scene();
  scene.bodies[0].spin = {0, 0, 20};
  scene.integrator.time_step = 5e-3;
  Simulation sim = built(scene);
  // From the undeformed start it rings, and large steps take that away.
  for (int i = 0; i < 40; ++i) advance(sim);
  for (int i = 0; i < 100; ++i) {
    const StepReport report = advance(sim);
    // Strain itself is 1e-6 of the whole: the loss is far below it.
    CHECK(std::abs(report.energy.residual) < 1e-9 * energy(sim));
  }
}

TEST_CASE("what a sudden load gives beyond the strain is the integrator's loss",
          "[accuracy][ledger]") {
  // Its work is f u, the strain f u / 2: a step far longer than the periods takes the other half.
  Scene scene = bar_scene();
  scene.bodies[0].held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  scene.bodies[0].loads = {
      {.minimum = {0.8 - 1e-6, -1, -1}, .maximum = {9, 9, 9}, .pressure = -1e5}};
  scene.integrator.time_step = GENERATE(1e-4, 1e-3, 0.1);
  Simulation sim = built(scene);
  const double strain = 0.5 * 1e5 * 1e5 / 1e9 * 0.8 * 0.04;
  EnergyLedger sum;
  for (int i = 0; i < 20; ++i) {
    const EnergyLedger ledger = advance(sim).energy;
    // Of a supported body the deformation is all there is: linear, so the closed form is exact.
    CHECK(std::abs(ledger.residual) < 1e-10 * strain);
    sum.loads += ledger.loads;
    sum.strain += ledger.strain;
    sum.numerical += ledger.numerical;
  }
  if (scene.integrator.time_step < 0.1) return;
  CHECK(sum.strain == Approx(strain).epsilon(1e-6));
  CHECK(sum.loads == Approx(2 * strain).epsilon(1e-6));
  CHECK(sum.numerical == Approx(strain).epsilon(1e-6));
}

TEST_CASE("the ledger of a ringing body closes, at any step and memory of the integrator",
          "[accuracy][ledger]") {
  Scene scene = bar_scene();
  scene.integrator.time_step = GENERATE(2e-5, 2e-4, 2e-3);
  scene.integrator.rho_infinity = GENERATE(0.0, 0.5);
  Simulation sim = built(scene);
  VertexColumns& vertices = sim.state->mechanics.vertices;
  const double speed = 0.1;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    vertices.velocity[v].x() = vertices.rest_position[v].x() < 0.4 ? speed : -speed;
  }
  reframe(sim.state->mechanics, ComponentId{0});
  const double start = energy(sim);
  double loss = 0, worst = 0;
  for (int i = 0; i < 100; ++i) {
    const EnergyLedger ledger = advance(sim).energy;
    worst = std::max(worst, std::abs(ledger.residual));
    loss += ledger.numerical;
  }
  // The frame couples to the deformation at second order: strains are v / c = 1e-4, squared 1e-8.
  INFO("worst residual of a step " << worst / start << " of the energy, lost " << loss / start);
  CHECK(worst < 1e-7 * start);
  CHECK(energy(sim) + loss == Approx(start).epsilon(1e-5));
  CHECK(loss > -1e-6 * start);
}

TEST_CASE("Rayleigh damping has its own place in the ledger", "[accuracy][ledger]") {
  Scene scene = bar_scene();
  scene.integrator.time_step = 2e-5;
  scene.integrator.damping.stiffness_factor = 1e-5;
  Simulation sim = built(scene);
  VertexColumns& vertices = sim.state->mechanics.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    vertices.velocity[v].x() = vertices.rest_position[v].x() < 0.4 ? 0.1 : -0.1;
  }
  reframe(sim.state->mechanics, ComponentId{0});
  const double start = energy(sim);
  double damped = 0, rest = 0;
  for (int i = 0; i < 200; ++i) {
    const StepReport report = advance(sim);
    damped += report.status.damping_work;
    rest += report.energy.residual;
  }
  INFO("damped " << damped / start << ", rest " << rest / start);
  // The rate within a step is taken by its mean: a rest of second order in the step.
  CHECK(damped > 0.1 * start);
  CHECK(std::abs(rest) < 0.1 * damped);
}

TEST_CASE("without the ledger a run is the same to the bit", "[accuracy][ledger]") {
  std::vector<Vec3> ends[2];
  for (const bool kept : {false, true}) {
    Scene scene = bar_scene();
    scene.bodies[0].velocity = {-2, 0, 0};
    scene.bodies[0].translation = {0.001, 0, 0};
    scene.obstacles = {{.shape = Plane{.normal = {1, 0, 0}}}};
    scene.energy_ledger = kept;
    Simulation sim = built(scene);
    double seen = 0;
    for (int i = 0; i < 20; ++i) {
      const EnergyLedger ledger = advance(sim).energy;
      seen += ledger.moved + std::abs(ledger.kinetic);
    }
    CHECK((seen > 0) == kept);
    ends[kept] = sim.state->mechanics.vertices.position;
  }
  CHECK(ends[0] == ends[1]);
}

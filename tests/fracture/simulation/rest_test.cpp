// SPDX-License-Identifier: MIT
// Bodies that rest on each other, or are pressed slowly, at the settings that are chosen for them.
#include <algorithm>
#include <catch2/catch.hpp>

#include "fracture/scene/choose_settings.hpp"
#include "fracture/simulation/ledger/force_report.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A cube of concrete, 0.1 m wide, with its lowest corner at a place.
BodySettings cube_at(const Vec3& place, double density) {
  BodySettings body;
  body.mesh = suite::kuhn_box({2, 2, 2}, 0.05);
  body.material.density = density;
  body.translation = place;
  return body;
}

}  // namespace

TEST_CASE("ten blocks of mass 1 and 100 in turns stand at the settings chosen",
          "[fracture][contact]") {
  // With 200 iterations they sink by 0.2 and 0.5 mm.
  const double time_step = GENERATE(2e-3, 3e-3);
  Scene scene;
  for (int k = 0; k < 10; ++k) {
    scene.bodies.push_back(cube_at({0, 0, 0.1 * k}, k % 2 == 0 ? 100 : 10000));
  }
  scene.obstacles = {{Plane{}}};
  scene.fracture.mode = FractureMode::off;
  scene.integrator.time_step = time_step;
  scene.duration = 1;
  choose_settings(scene, Accuracy::good, {});
  Simulation sim = built(scene);
  double deepest = 0;
  for (int k = 0; k < 12; ++k) {
    const StepReport report = advance(sim);
    INFO("step " << k << " of " << time_step << " s: " << report.contact.residual << " m");
    CHECK(report.contact.converged);
    deepest = std::max(deepest, report.contact.deepest);
  }
  CHECK(deepest < 1e-7);
  // The blocks give by their own weight.
  const std::vector<Component>& pieces = sim.state->mechanics.components;
  for (std::size_t k = 0; k < 10; ++k) {
    CHECK(pieces[k].centre.z() == Approx(0.05 + 0.1 * static_cast<double>(k)).margin(1e-5));
  }
}

TEST_CASE("a block that is pressed slowly feels the same force in a short run and in a long one",
          "[fracture][contact]") {
  double force[2];
  for (const int is_long : {0, 1}) {
    Scene scene;
    scene.bodies.push_back(cube_at(Vec3::Zero(), 2400));
    // Twice as high as wide: 40 iterations would give 1/170 of the force.
    scene.bodies[0].mesh = suite::kuhn_box({2, 2, 4}, 0.025);
    scene.bodies[0].material.tensile_strength = 3e6;
    scene.obstacles = {{Plane{}},
                       {.shape = Box{.center = {0.05, 0.05, 0.11}, .half_extent = {0.1, 0.1, 0.01}},
                        .velocity = {0, 0, -0.01}}};
    scene.contact.friction = 0;
    for (Obstacle& platen : scene.obstacles) platen.friction = 0;
    scene.fracture.mode = FractureMode::all;
    scene.integrator.time_step = 1e-3;
    // A body that stands does not fall, however long it could.
    scene.duration = is_long ? 10 : 0.005;
    choose_settings(scene, Accuracy::good, {});
    Simulation sim = built(scene);
    sim.reports_forces = true;
    ForceReport last;
    for (int k = 0; k < 5; ++k) {
      const StepReport report = advance(sim);
      INFO("step " << k << ": " << report.contact.residual << " m, " << scene.contact.max_iterations
                   << " iterations, " << scene.contact.max_passes << " passes");
      CHECK(report.contact.converged);
      last = report.forces;
    }
    force[is_long] = last.obstacle[1][2] / scene.integrator.time_step;
  }
  CHECK(force[0] == force[1]);
  // E times strain times section.
  CHECK(force[0] == Approx(30e9 * 5e-4 * 0.05 * 0.05).epsilon(1e-3));
}

// SPDX-License-Identifier: MIT
// The parts of a step, for bodies that supports move.
#include <catch2/catch.hpp>

#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("what supports pull apart goes on stretching while it waits for a blow",
          "[fracture][impact]") {
  BodySettings bar{.mesh = suite::kuhn_box({10, 1, 1}, 0.1)};
  bar.held = {{{-1, -1, -1}, {1e-3, 1, 1}}, {{0.999, -1, -1}, {2, 1, 1}, {0.02, 0, 0}}};
  Scene scene;
  scene.bodies = {bar};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.integrator.time_step = 1e-3;
  const Simulation alone = [&] {
    Simulation sim = built(scene);
    advance(sim);
    return sim;
  }();
  // It touches the middle late in the step.
  scene.impact.by_energy = false;
  scene.obstacles = {{.shape = Sphere{{0.5, 0, 0.15 + 0.9e-3 * 0.3}, 0.05},
                      .velocity = {0, 0, -0.3},
                      .mass = 0.1}};
  const auto stretch_at_end = [](const Simulation& sim) {
    double largest = 0;
    const Cells& cells = sim.state->cells;
    for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
      for (const VertexId v : cells.map.corners(TetId{t})) {
        if (cells.map.point(v)[0] < 0.95) continue;
        largest = std::max(largest, sim.state->mechanics.elements.stress[t](0, 0));
      }
    }
    return largest;
  };
  Simulation struck = built(scene);
  double largest = 0;
  const StepReport report = advance(struck, [&](const Simulation& sim, const PartReport&) {
    largest = std::max(largest, stretch_at_end(sim));
  });
  REQUIRE(report.impact.opened > 0);
  // Frozen until the touch, the last cell would have borne nine times as much.
  CHECK(stretch_at_end(alone) > 1e5);
  CHECK(largest < 3 * stretch_at_end(alone));
}

// SPDX-License-Identifier: MIT
// Parts of a step that are taken back come to an end.
#include "fracture/simulation/attempt.hpp"

#include <catch2/catch.hpp>

#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("a step ends where what is overloaded is rigid, and no window of it can open", "[ties]") {
  for (const IsolatedTetrahedra isolated :
       {IsolatedTetrahedra::rigid, IsolatedTetrahedra::projection, IsolatedTetrahedra::qr}) {
    Scene scene;
    scene.fracture.crack = CrackMode::cohesive;
    scene.integrator.isolated = isolated;
    BodySettings block{.mesh = suite::kuhn_box({2, 2, 2}, 0.1)};
    BodySettings chip{.translation = {0, 0, 3}, .spin = {30, 20, 10}};
    chip.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    chip.mesh.tetrahedra = {{0, 1, 2, 3}};
    chip.material.tensile_strength = 1e-6;
    for (BodySettings body : {block, chip}) {
      body.material.fracture_energy = 33;
      scene.bodies.push_back(body);
    }
    Simulation sim = built(scene);
    for (int i = 0; i < 5; ++i) CHECK(advance(sim).status.outcome == StepOutcome::fine);
    CHECK(sim.state->step == 5);
    CHECK(sim.state->cells.map.vertices() == block.mesh.points.size() + 4);
  }
}

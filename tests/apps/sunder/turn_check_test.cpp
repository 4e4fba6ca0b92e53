// SPDX-License-Identifier: MIT
// Bodies that bend too far for one rigid reference get a warning, a corner that turns gets none.
#include "apps/sunder/run/report/turn_check.hpp"

#include <catch2/catch.hpp>

#include "fracture/simulation/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// The first warning of a strip of 0.2 x 0.02 x 0.02 m, held at one end, that `force` (N) pulls
/// down at the vertices between `from` and its other end (m); it breaks at a strain of 0.01, so
/// that turns up to 0.1 rad give no warning.
std::optional<Finding> first_warning(double force, double from) {
  Scene scene;
  BodySettings body;
  body.mesh = suite::kuhn_box({20, 2, 2}, 0.01);
  body.material.young_modulus = 1e7;
  body.material.tensile_strength = 1e5;
  body.held = {{.minimum = Vec3::Constant(-1e-9), .maximum = Vec3(1e-9, 1, 1)}};
  LoadBox load;
  load.minimum = Vec3(from, -1, 0.0199);
  load.maximum = Vec3(1, 1e-9, 1);
  load.force = Vec3(0, 0, -force);
  body.loads = {load};
  scene.bodies = {body};
  scene.gravity.acceleration = Vec3::Zero();
  scene.fracture.mode = FractureMode::off;
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  for (int step = 0; step < 100; ++step) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    if (std::optional<Finding> found = check_turns(*sim, report)) return found;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a strip that bends too far for its reference is warned about", "[run][turn]") {
  const std::optional<Finding> bent = first_warning(1, 0.199);
  REQUIRE(bent);
  CHECK(bent->code == turned_too_far);
  CHECK(bent->severity == Severity::warning);
  CHECK(bent->text.find("beyond 0.1 the") != std::string::npos);
  CHECK(bent->remedy.find("corotational") != std::string::npos);
  CHECK_FALSE(first_warning(0.01, 0.199));
}

TEST_CASE("one cell that turns too far gives no warning", "[run][turn]") {
  Scene scene;
  BodySettings body;
  body.mesh = suite::kuhn_box({20, 2, 2}, 0.01);
  body.material.tensile_strength = 1e5;
  body.material.young_modulus = 1e7;
  scene.bodies = {body};
  scene.gravity.acceleration = Vec3::Zero();
  scene.fracture.mode = FractureMode::off;
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  const StepReport report = advance(*sim);
  MechanicsState& m = sim->state->mechanics;
  // About z and `centre`, by a fifth of a radian: displacement (-y, x, 0) / 5 of the cells'
  // corners.
  const auto turn_cells = [&](std::size_t count, const Vec3& centre) {
    for (std::size_t t = 0; t < count; ++t) {
      for (const VertexId v : sim->state->cells.map.corners(m.components[0].tetrahedra[t])) {
        const Vec3 x = Vec3(sim->state->cells.map.point(v).data()) - centre;
        m.vertices.displacement[v.index()] = Vec3(-x[1], x[0], 0) / 5;
      }
    }
    m.components[0].largest_turn = 0.2;
  };
  turn_cells(1, Vec3::Constant(0.005));
  CHECK_FALSE(check_turns(*sim, report));
  turn_cells(m.components[0].tetrahedra.size(), Vec3::Zero());
  CHECK(check_turns(*sim, report));
}

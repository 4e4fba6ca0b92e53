// SPDX-License-Identifier: MIT
// Bodies break alike whether old factors serve on after a crack or new ones are made at once.
#include <catch2/catch.hpp>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/solver/component_system.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

struct Run {
  std::vector<std::pair<std::uint64_t, VertexId>> fans;  ///< step and vertex
  std::size_t bordered = 0;                              ///< steps that ended with a border
  std::vector<Vec3> position;
};

Run run(bool with_borders, int order) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.integrator.time_step = 2e-5;
  scene.impact.window = false;  // so that systems can be thrown away between any two parts
  scene.bodies.push_back({.mesh = suite::kuhn_box({6, 4, 3}, 0.05),
                          .material = {.tensile_strength = 3e6},
                          .translation = {0, 0, 0.26},
                          .rotation = Eigen::Quaterniond(0.9, 0.3, 0.2, 0.1).normalized(),
                          .velocity = {0, 0, -4}});
  scene.bodies[0].order = order;
  scene.obstacles.push_back({Plane{}});
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  Run result;
  for (int k = 0, last = 2000; k < last; ++k) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    for (const FanEvent& fan : report.fracture.fans) result.fans.emplace_back(k, fan.vertex);
    if (last == 2000 && result.fans.size() >= 8) last = k + (order == 1 ? 20 : 3);
    ComponentSystems& systems = sim->state->mechanics.systems;
    if (!with_borders) {
      for (auto& retired : systems.retired) retired.reset();
    }
    // If a component breaks in every step, the system of the step is retired as it ends.
    for (const auto* of : {&systems.present, &systems.retired}) {
      for (const auto& system : *of) result.bordered += system && !system->border.columns.empty();
    }
  }
  result.position = sim->state->mechanics.vertices.position;
  return result;
}

}  // namespace

TEST_CASE("with and without borders the same vertices break in the same steps",
          "[fracture][border]") {
  // Order 2 breaks to pieces at once, and their contacts part the runs soon: compared before that.
  const int order = GENERATE(1, 2);
  const Run with = run(true, order), without = run(false, order);
  CHECK(with.fans.size() >= 8);
  CHECK(with.bordered > 0);
  CHECK(without.bordered == 0);
  CHECK(with.fans == without.fans);
  REQUIRE(with.position.size() == without.position.size());
  double worst = 0;
  for (std::size_t v = 0; v < with.position.size(); ++v) {
    worst = std::max(worst, (with.position[v] - without.position[v]).norm());
  }
  // Of 0.3 m. Crack faces touch: places are as alike as contact is solved.
  CHECK(worst < 1e-6);
}

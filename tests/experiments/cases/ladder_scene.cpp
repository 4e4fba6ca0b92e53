// SPDX-License-Identifier: MIT
// Runs of a scene with and without the ladder.
#include "tests/experiments/cases/ladder_scene.hpp"

#include <algorithm>
#include <ctime>
#include <stdexcept>

namespace sunder::accuracy {

LadderOutcome run_on_ladder(const Scene& scene) {
  Result<Simulation> sim = build_simulation(scene);
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  LadderOutcome outcome;
  while (sim->state->mechanics.time < scene.duration * (1 - 1e-9)) {
    const std::clock_t start = std::clock();
    const StepReport report = advance(*sim);
    outcome.ms += 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    for (const FanEvent& fan : report.fracture.fans) {
      outcome.fans.emplace_back(report.step, fan.vertex);
    }
    outcome.time.insert(outcome.time.end(), report.fan_time.begin(), report.fan_time.end());
    outcome.pieces = report.components;
    for (std::size_t rung = 0; rung < rung_count; ++rung) {
      outcome.tetrahedra[rung] += report.ladder.tetrahedra[rung];
    }
  }
  return outcome;
}

Scene always_full(Scene scene) {
  scene.ladder.rigid = scene.ladder.quasi_static = scene.ladder.sleep = false;
  return scene;
}

Scene moved_by_nothing(Scene scene) {
  constexpr double nothing = 1e-12;
  scene.gravity.acceleration *= 1 + nothing;
  for (BodySettings& body : scene.bodies) body.velocity += nothing * Vec3::Ones();
  return scene;
}

std::size_t same_fans(const LadderOutcome& a, const LadderOutcome& b) {
  const auto [end, other] = std::ranges::mismatch(a.fans, b.fans);
  return static_cast<std::size_t>(end - a.fans.begin());
}

}  // namespace sunder::accuracy

// SPDX-License-Identifier: MIT
// The falling cube, and the measurements of any falling scene.
#include "tests/experiments/cases/falling_scene.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {

Scene falling_cube(int cells) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  BodySettings cube;
  cube.name = "cube";
  cube.mesh = suite::jittered(suite::kuhn_box({cells, cells, cells}, 0.2 / cells), 0.01 / cells, 1);
  cube.rotation = Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 0.4, 0).normalized());
  double low = 0;
  for (const Point& p : cube.mesh.points) {
    low = std::min(low, (cube.rotation * Eigen::Vector3d(p[0], p[1], p[2])).z());
  }
  cube.translation = {0, 0, 1e-3 - low};
  cube.velocity = {0, 0, -3};
  cube.spin = {0, 2, 1};
  scene.bodies.push_back(std::move(cube));
  scene.obstacles = {{.shape = Plane{}}};
  scene.duration = 0.02;
  return scene;
}

FallOutcome run_fall(const Scene& scene) {
  Result<Simulation> sim = build_simulation(scene);
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  FallOutcome outcome;
  while (sim->state->mechanics.time < scene.duration * (1 - 1e-9)) {
    const StepReport report = advance(*sim);
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    if (outcome.fans == 0 && !report.fan_time.empty()) outcome.first_fan = report.fan_time.front();
    outcome.fans += report.fracture.fans.size();
    outcome.deepest = std::max(outcome.deepest, report.contact.deepest);
    outcome.sub_steps += report.impact.sub_steps;
    outcome.pieces = report.components;
  }
  double largest = 0, all = 0;
  for (const Component& c : sim->state->mechanics.components) {
    largest = std::max(largest, c.mass);
    all += c.mass;
  }
  outcome.largest_share = largest / all;
  return outcome;
}

}  // namespace sunder::accuracy

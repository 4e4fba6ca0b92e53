// SPDX-License-Identifier: MIT
// One step: mechanics with contact, then fracture, then the components that came of it.
#include "fracture/simulation.hpp"

#include <algorithm>
#include <chrono>

namespace sunder {
namespace {

/// Adds the time until the end of its scope to a stage.
class StageTimer {
 public:
  StageTimer(StepReport& report, Stage stage)
      : ms_(report.stage_ms[static_cast<std::size_t>(stage)]) {}
  ~StageTimer() {
    ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
               .count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& ms_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The component that `id` was part of when the step began.
ComponentId ancestor(const Components& labels, ComponentId id, std::size_t components_before) {
  while (id.index() >= components_before) id = labels.parent[id.index()];
  return id;
}

/// Components that the fans of a step divided, and what came off them, ascending.
std::vector<ComponentId> touched_components(const Components& labels,
                                            const FractureReport& fracture,
                                            std::size_t components_before) {
  std::vector<ComponentId> touched;
  for (const FanEvent& fan : fracture.fans) {
    // Every row a fan split belongs to a component whose masses, at least, must be made anew.
    for (const FaceSplit& split : fan.faces) {
      touched.push_back(labels.of_tetrahedron[tetrahedron_of(split.face).index()]);
      touched.push_back(labels.of_tetrahedron[tetrahedron_of(split.opposite).index()]);
    }
  }
  for (std::size_t id = components_before; id < labels.size.size(); ++id) {
    touched.emplace_back(id);
    touched.push_back(ancestor(labels, ComponentId{id}, components_before));
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

/// Brings mechanics and display up to date with what broke.
void rebuild_components(Simulation& sim, StepReport& report) {
  SimulationState& s = sim.state;
  const std::size_t before = s.display.size();
  const auto touched = touched_components(s.cells.labels, report.fracture, before);
  std::vector<Vec3> old_rest_centre;
  for (std::size_t id = 0; id < before; ++id) {
    old_rest_centre.push_back(s.mechanics.components[id].rest_centre);
  }
  s.mechanics.elements.component = s.cells.labels.of_tetrahedron;
  report.energy_released =
      rebuild(s.mechanics, s.cells.map.corners(), touched, sim.scratch.mechanics).energy_released;

  s.display.resize(s.cells.labels.size.size());
  s.display_target.resize(s.display.size());
  // Fresh ids first: their display state comes from the parent's, which changes last.
  for (auto id = touched.rbegin(); id != touched.rend(); ++id) {
    const std::size_t old = ancestor(s.cells.labels, *id, before).index();
    const Vec3& centre = s.mechanics.components[id->index()].rest_centre;
    s.display[id->index()] = split_off(s.display[old], old_rest_centre[old], centre);
    s.display_target[id->index()] = split_off(s.display_target[old], old_rest_centre[old], centre);
  }
}

/// Section 3.3: what is drawn follows the frames smoothly.
void update_display(Simulation& sim) {
  SimulationState& s = sim.state;
  for (const Component& c : s.mechanics.components) {
    const DisplayState target{c.centre, c.orientation};
    DisplayState& shown = s.display[c.id.index()];
    shown = approach(carry(shown, s.display_target[c.id.index()], target), target,
                     sim.scene.time_step, sim.scene.display_time_constant);
    s.display_target[c.id.index()] = target;
  }
}

}  // namespace

Vec3 gravity_at(const GravitySettings& gravity, double time) {
  if (gravity.ramp_time <= 0) return gravity.acceleration;
  return gravity.acceleration * std::min(1.0, time / gravity.ramp_time);
}

StepReport advance(Simulation& sim) {
  SimulationState& s = sim.state;
  StepReport report;
  {
    const StageTimer timer(report, Stage::mechanics);
    const Loads loads{
        .gravity = gravity_at(sim.scene.gravity, s.mechanics.time + sim.scene.time_step)};
    const StepInput input{s.cells.map.corners(), loads, sim.scene.integrator};
    ContactStepResult result =
        advance_with_contact({s.mechanics, s.obstacles, s.contact}, input, sim.scene.contact,
                             {sim.scratch.mechanics, sim.scratch.contact});
    report.status = result.status;
    report.contact = std::move(result.report);
  }
  report.step = ++s.step;
  report.time = s.mechanics.time;
  report.components = living_components(s.mechanics).size();
  if (report.status.outcome != StepOutcome::fine) return report;
  {
    const StageTimer timer(report, Stage::fracture);
    report.fracture =
        find_fractures(s.cells, s.mechanics, sim.scene.fracture, sim.scratch.fracture);
  }
  if (report.fracture.not_a_number) return report;
  if (!report.fracture.fans.empty()) {
    const StageTimer timer(report, Stage::rebuild);
    rebuild_components(sim, report);
  }
  {
    const StageTimer timer(report, Stage::display);
    update_display(sim);
  }
  report.components = living_components(s.mechanics).size();
  return report;
}

}  // namespace sunder

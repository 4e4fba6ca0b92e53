// SPDX-License-Identifier: MIT
// The start of a step, kept in case that the step is not taken.
#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/detection/contact_overlaps.hpp"

namespace sunder {

void remember_start(ContactStep& step) {
  StepStart& start = step.scratch.start;
  const MechanicsState& state = step.pass.state;
  start.momenta.clear();
  start.rungs.clear();
  for (const Component& c : state.components) {
    start.momenta.push_back({c.momentum, c.angular_momentum});
    start.rungs.push_back(c.rung);
  }
  start.obstacles = step.pass.obstacles;
  if (!is_floating(step.pass.input.settings.integrator)) start.velocity = state.vertices.velocity;
}

void put_back(ContactStep& step) {
  const StepStart& start = step.scratch.start;
  MechanicsState& state = step.pass.state;
  for (Component& c : state.components) {
    c.momentum = start.momenta[c.id.index()][0];
    c.angular_momentum = start.momenta[c.id.index()][1];
    c.rung = start.rungs[c.id.index()];
  }
  step.pass.obstacles = start.obstacles;
  if (!is_floating(step.pass.input.settings.integrator)) state.vertices.velocity = start.velocity;
}

bool has_passing(ContactStep& step) {
  if (!step.pass.input.part.divides) return false;
  const StepPaths paths = paths_of(step);
  return may_overlap(paths, step.settings) && find_passing(step.scratch.detect, paths);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// A scene in motion: one step is contact, mechanics, fracture, components. No file is read or
// written, and no clock decides anything: times of stages are only reported.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fracture/simulation/scene.hpp"
#include "fracture/simulation/step_report.hpp"
#include "topology/kernel/finding.hpp"
#include "topology/kernel/owned.hpp"

namespace sunder {

struct PartReport;
struct SimulationScratch;
struct SimulationState;

/// Rows of one body of the scene: its tetrahedra and the points of its mesh are consecutive.
struct BodyRows {
  std::size_t first_tetrahedron = 0, end_tetrahedron = 0;
  std::size_t first_point = 0, end_point = 0;
};

/// A scene with its state. The scene's settings do not change while it runs.
struct Simulation {
  Simulation();
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  Scene scene;
  std::vector<BodyRows> bodies;
  /// That a step may use. Results are the same bytes for any number.
  unsigned threads = 1;
  /// All that evolves: fracture/simulation/state.hpp.
  Owned<SimulationState> state;
  /// Working memory: may be replaced by a new one between any two steps.
  Owned<SimulationScratch> scratch;
};

using StepObserver = std::function<void(const Simulation&, const PartReport&)>;

/// Builds every body of a scene at its start: map, columns, supports, placement, components.
/// The findings tell all that is wrong with meshes, materials, obstacles and settings; warnings and
/// notes may stand beside a simulation. O(|T|).
Result<Simulation> build_simulation(Scene scene);

/// One step of length `scene.time_step`: contact and external forces -> integrate -> element stress
/// at the new state -> fracture -> components (docs/decisions.md, Order of a step).
/// A step that would run into a blow is divided for the components struck and what they can reach:
/// frozen deformations up to the blow, sub-steps while it lasts, each with its own fractures, and
/// the rest at once; all others take the whole step, and everybody meets at its end
/// (docs/impact.md). `observe` is called after each part.
/// With a script its fans are made instead of looking for any.
/// After an outcome other than fine in `status`, a stress that is not a number, or a departure from
/// the script, the simulation must not be advanced further; the state is as computed, for whoever
/// wants to look.
StepReport advance(Simulation& simulation, const StepObserver& observe = {});

}  // namespace sunder

// SPDX-License-Identifier: MIT
// A scene in motion: one step is contact, mechanics, fracture, components. No file is read or
// written, and no result depends on a clock: times of stages are only reported.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/step_report.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/owned.hpp"

namespace sunder {

struct PartReport;
struct SimulationScratch;
struct SimulationState;

/// A scene with its state. The scene's settings do not change while it runs. One that was moved
/// from can be destroyed or assigned to; whatever else is asked of it throws Misuse.
struct Simulation {
  Simulation();
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  Scene scene;
  std::vector<BodyRows> bodies;
  /// Threads for factors and contact of large pieces, at least 1; outcomes are the same bytes for
  /// any number. May change between steps.
  unsigned threads = 1;
  /// Where given and true, a step ends as soon as it can: what is left of it is taken at once and
  /// contact's sweeps are cut short, which its report says. For programs that can be interrupted.
  const std::atomic<bool>* hurry = nullptr;
  /// What evolves. Internal: its type is no part of the public headers.
  Owned<SimulationState> state;
  /// Working memory: may be replaced by new one between any two steps. Internal.
  Owned<SimulationScratch> scratch;
};

using StepObserver = std::function<void(const Simulation&, const PartReport&)>;

/// Builds every body of a scene at its start: map, columns, supports, placement, components.
/// Bodies of order 2 get nodes in the middles of their edges, rows behind those of the vertices.
/// Errors: all that is wrong with meshes and settings (`check_mesh`, `check_scene`,
/// `second_order_findings`). Warnings and notes may stand beside a simulation. O(|T|).
Result<Simulation> build_simulation(Scene scene);

/// One step, `scene.integrator.time_step` long: contact and external forces -> integrate -> element
/// stress at the new state -> fracture -> components (docs/explanation/paper.md). A step
/// in which something is struck is divided for the components struck and those they can reach:
/// deformations are frozen up to the impact, sub-steps follow while the waves run, each with its
/// own search for fractures, and the remainder is taken at once; all other components take the
/// whole step (docs/explanation/time_and_contact.md). `observe` is called after each part.
/// With a script its fans are made instead of looking for any.
/// After an outcome other than fine in `status`, a stress that is not a number, or a departure from
/// the script, the simulation must not be advanced further; the state is as computed, to be looked
/// at.
StepReport advance(Simulation& simulation, const StepObserver& observe = {});

/// Steps taken since the start.
std::uint64_t steps_taken(const Simulation& simulation);

/// Simulated time since the start, s.
double simulated_time(const Simulation& simulation);

/// Row of the body that a tetrahedron belongs to, whatever has come off. Throws Misuse where there
/// is no such tetrahedron.
std::size_t body_of(const Simulation& simulation, TetId tetrahedron);

}  // namespace sunder

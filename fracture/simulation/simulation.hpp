// SPDX-License-Identifier: MIT
// A scene in motion: one step is contact, mechanics, fracture, components. No file is read or
// written, and no result depends on a clock: times of stages are only reported.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/step_report.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/owned.hpp"

namespace sunder {

struct PartReport;
struct SimulationScratch;
struct SimulationState;

/// A spring from a vertex to a place in the world (`pull`).
struct Spring {
  VertexId vertex;
  Vec3 end = Vec3::Zero();  ///< m
};

/// A scene with its state. The scene's settings do not change during the run. A moved-from
/// simulation can be destroyed or assigned to. Any other use of it throws Misuse.
struct Simulation {
  Simulation();
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  Scene scene;
  std::vector<BodyRows> bodies;
  /// Number of threads for factors and contact of large pieces, at least 1. Results are the same
  /// bytes for any number. It may change between steps.
  unsigned threads = 1;
  /// If given and true, a step ends as soon as possible: its remainder is taken at once and the
  /// sweeps of contact are cut short, as its report shows. For programs that can be interrupted.
  const std::atomic<bool>* hurry = nullptr;
  /// True: each step fills `StepReport::forces`. It may change between steps.
  bool reports_forces = false;
  /// Pulls in every step, while there is one. It is not saved.
  std::optional<Spring> spring;
  /// The evolving state. Internal: its type is not part of the public headers.
  Owned<SimulationState> state;
  /// Working memory, replaceable by an empty one between any two steps. Internal.
  Owned<SimulationScratch> scratch;
};

using StepObserver = std::function<void(const Simulation&, const PartReport&)>;

/// Builds every body of a scene at its start: map, columns, supports, placement, components. Bodies
/// of order 2 get nodes in the middles of their edges, rows behind those of the vertices. Errors:
/// all faults of meshes and settings (`check_mesh`, `check_scene`, `second_order_findings`).
/// Warnings and notes may accompany a simulation. O(|T|).
Result<Simulation> build_simulation(Scene scene);

/// Advances by one step of `scene.integrator.time_step`, s: contact and external forces ->
/// integrate -> element stress at the new state -> fracture -> components
/// (docs/explanation/paper.md). A step with an impact is divided for the struck components and
/// those in reach: deformations are frozen up to the impact, sub-steps with their own searches for
/// fractures follow while the waves run, and the remainder is taken at once. All other components
/// take the whole step (docs/explanation/time_and_contact.md). `observe` is called after each part.
/// A script's fans replace the search. Errors: an outcome other than fine in `status`, a stress
/// that is not a number, or a departure from the script. The simulation must then not be advanced
/// further, and its state can be inspected.
StepReport advance(Simulation& simulation, const StepObserver& observe = {});

/// Number of steps since the start.
std::uint64_t steps_taken(const Simulation& simulation);

/// Simulated time since the start, s.
double simulated_time(const Simulation& simulation);

/// Row of the body of a tetrahedron, also after pieces have come off. Throws Misuse if there is no
/// such tetrahedron.
std::size_t body_of(const Simulation& simulation, TetId tetrahedron);

}  // namespace sunder

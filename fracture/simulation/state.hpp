// SPDX-License-Identifier: MIT
// The state of a simulation, and the scratch of its steps.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/breaking/break_vertices.hpp"
#include "fracture/breaking/fan_script.hpp"
#include "fracture/energy/crack_energy.hpp"
#include "fracture/simulation/ledger/break_energy.hpp"
#include "fracture/simulation/rubble/rubble_state.hpp"
#include "mechanics/contact/contact.hpp"
#include "mechanics/state/display_state.hpp"
#include "mechanics/state/impulse.hpp"
#include "mechanics/state/loads.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// Impact windows: which components are stepped finely, and how finely.
struct ImpactWindow {
  static constexpr double closed = std::numeric_limits<double>::infinity();
  /// Row = ComponentId: s since the component last felt a blow, negative where it lies ahead;
  /// `closed` for all others.
  std::vector<double> quiet;
  /// s, the scene's step over a power of two; kept while a window is open.
  double sub_step = 0;
};

/// The values that decide the rungs of components, in addition to their rows.
struct LadderState {
  std::vector<double> still;  ///< row = ComponentId: s for which it has lain still
  RubbleState rubble;
};

/// The evolving state: all values that `save` keeps besides the scene.
struct SimulationState {
  Cells cells;
  MechanicsState mechanics;
  /// Those of the scene, where they are now.
  std::vector<Obstacle> obstacles;
  ContactMemory contact;
  ImpactWindow impact;
  LadderState ladder;
  /// Row = ComponentId: where each component is drawn (section 3.3), and the target it was given in
  /// the last step.
  std::vector<Pose> display, display_target;
  std::vector<OpenCrack> cracks;  ///< with an energy that is still being measured
  std::uint64_t fans = 0;         ///< so far
  /// Fans and pieces there were when the `budget_time` at hand began.
  std::uint64_t fans_before = 0, pieces_before = 0;
  std::uint64_t step = 0;
  std::vector<std::uint64_t> birth_step;  ///< row = ComponentId: in which it came off; 0: the start
  /// Surface loads of all bodies (`BodySettings::loads`); corners keep them through every split.
  std::vector<CornerLoad> loads;
  /// Fans to make in place of finding any: those of an earlier run (replay).
  std::optional<FanScript> script;
};

/// The state at the start of the part of a step at hand, for the ledgers.
struct PartStart {
  std::vector<Vec3> position;                            ///< m, world
  std::vector<Vec3> displacement, rate, acceleration;    ///< m, m/s, m/s^2, body frame
  std::vector<Vec3> centre, momentum, angular_momentum;  ///< row = ComponentId
  std::vector<Eigen::Quaterniond> orientation;           ///< row = ComponentId
  std::vector<Obstacle> obstacles;
  std::vector<double> work;  ///< of a product with K
};

/// Input of the choice of rungs, rows = ComponentId.
struct LadderScratch {
  std::vector<char> rested, loaded, tied;
  std::vector<std::array<std::size_t, 2>> touching;
};

/// Of ticks of the rubble.
struct RubbleTickScratch {
  RubbleScratch solver;
  std::vector<char> declared;     ///< row = ComponentId (`note_unbreakable`)
  std::vector<char> tied;         ///< row = ComponentId: it has ties
  std::vector<char> watched;      ///< row = ComponentId: rubble until a blow could break it
  std::vector<double> threshold;  ///< J, row = ComponentId
  std::vector<double> strength;   ///< Pa, row = ComponentId, of the weakest vertex
  std::vector<double> body_mass;  ///< kg, row = body
};

/// Working memory of a step, and values that follow exactly from the state. It can be thrown away
/// between any two steps.
struct SimulationScratch {
  MechanicsScratch mechanics;
  ContactScratch contact;
  FractureScratch fracture;
  std::vector<char> touched;  ///< row = ComponentId: a contact pushed at it in this step
  LadderScratch ladder;
  RubbleTickScratch rubble;
  PartStart before;
  std::vector<Impulse> supports;  ///< of the part at hand
  Loads loads;
  std::vector<double> strength;   ///< |C|, Pa: `StepPlan::strength`
  std::vector<double> threshold;  ///< |C|, J: `StepPlan::threshold`
  BreakEnergyScratch break_energy;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Scratch of mechanics: the state that a step predicts, and values that follow exactly from the
// state.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mechanics/element/energy.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/state/step_status.hpp"

namespace sunder {

struct BaselineSystem;
struct ColumnScratch;

/// Results of `predict` for one component, in addition to its rows.
struct PredictedFrame {
  Vec3 centre = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 momentum = Vec3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
  double damping_work = 0;  ///< J taken by Rayleigh damping in this step
  double turned = 0;        ///< rad: h^2 / I times the largest moment of forces that do not turn
  double spun = 0;  ///< rad: h times the spin at the start of the step, of freely turning bodies
  SolveReport solve = {};
  Vec3 spin = Vec3::Zero();  ///< rad/s, world; of bodies that float in their frames
};

/// Scratch of one step, and values that follow exactly from the state. All of it can be thrown away
/// between two steps; the next gives the same bytes. Bounded by the present mesh.
struct MechanicsScratch {
  MechanicsScratch();
  ~MechanicsScratch();
  MechanicsScratch(MechanicsScratch&&) noexcept;
  MechanicsScratch& operator=(MechanicsScratch&&) noexcept;

  /// Data that the baselines keep for a component; row = ComponentId, null until needed.
  std::vector<std::unique_ptr<BaselineSystem>> baselines;

  /// Predicted state, rows as in the state. Contact works with `position`.
  struct Predicted {
    std::vector<Vec3> position, velocity;
    std::vector<Vec3> displacement, displacement_rate, displacement_acceleration;
    std::vector<PredictedFrame> frame;  ///< row = ComponentId
  } predicted;

  /// Local vectors of the component at hand, 3 n each, grown to the largest and kept.
  std::array<std::vector<double>, 8> local;
  std::vector<Lame> lame;                   ///< row = MaterialId
  std::vector<StressEnergy> stress_energy;  ///< row = MaterialId
  /// Row = TetId: the step that its element stands explicitly, s; elements keep it for ever. Empty
  /// until needed.
  std::vector<double> element_step_bound;
  std::vector<ColumnScratch> columns;  ///< one a thread
};

}  // namespace sunder

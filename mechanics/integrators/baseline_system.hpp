// SPDX-License-Identifier: MIT
// Data that baselines keep for one component from step to step; derived, thrown away when it
// changes.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

struct ModalBasis;
struct ReassembledSystem;

/// Row of `MechanicsScratch::baselines`. Each part is made at its first use.
struct BaselineSystem {
  BaselineSystem();
  ~BaselineSystem();

  /// Steps that Broyden's method keeps, 3 n each.
  std::vector<Eigen::Matrix3Xd> updates;
  /// K_ii of every vertex in the system's order (3 x 3 n), N/m.
  Eigen::Matrix3Xd diagonal;
  /// Of the model corotational: turns of the elements (`element_rotations`), world.
  std::vector<Mat3> turn;
  std::unique_ptr<ReassembledSystem> reassembled;
  std::unique_ptr<ModalBasis> modal;
};

/// That of a component, made where it is not yet.
BaselineSystem& baseline_of(const ComponentStep& step);

}  // namespace sunder

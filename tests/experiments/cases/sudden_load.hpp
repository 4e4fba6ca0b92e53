// SPDX-License-Identifier: MIT
// A held bar that is loaded suddenly: how a long step comes to the static answer.
#pragma once

#include <vector>

#include "mechanics/state/settings/settings.hpp"

namespace sunder::accuracy {

/// A bar of 10 x 2 x 2 cells of concrete, 1 m long, held at one end; gravity along it (or across
/// it) comes at once.
struct SuddenLoad {
  /// Lowest angular frequency of the bar as a beam, 3.516 c t / (sqrt(12) L^2), times the step.
  double frequency_times_step = 10;
  bool across = false;
  /// Whether the load comes after it was held in another direction for this many steps: the scheme
  /// then remembers accelerations.
  int steps_before = 0;
  double rho_infinity = 0;
};

/// After each step of load.
struct SuddenLoadStep {
  double displacement = 0;  ///< largest error of a displacement over the largest static one
  double stress = 0;        ///< largest error of an element stress over the largest static one
};

/// `count` steps after the load came; errors against the static solution of the same mesh.
std::vector<SuddenLoadStep> run_sudden_load(const SuddenLoad& load, int count);

}  // namespace sunder::accuracy

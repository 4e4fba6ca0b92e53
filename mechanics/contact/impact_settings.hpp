// SPDX-License-Identifier: MIT
// What a user chooses about impacts.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "topology/kernel/finding.hpp"

namespace sunder {

/// What a user chooses about impacts. The stress of a blow lives for a few L/c, the time in which a
/// wave crosses a component; a step of 10 L/c finds a fifteenth of it, and what breaks would be
/// decided by the step. So components that are struck are stepped finely while that lasts.
struct ImpactSettings {
  /// Whether they are; false steps everything with the scene's step.
  bool window = true;
  /// Largest sub-step over L/c, L the component's extent (twice the distance of its farthest vertex
  /// from its centre), c the speed of compression waves. Half the time in which a wave crosses a
  /// mean cell is never undercut: the mesh holds no shorter waves.
  double fraction = 0.0625;
  /// A blow counts when its stress rho c v is at least this part of the tensile strength.
  double negligible = 0.1;
  /// Sub-steps in one step; what is left of a step then is taken at once.
  std::uint32_t max_sub_steps = 256;
};

/// What is wrong with the settings, each an error with value, range and remedy; `place` names them.
std::vector<Finding> check(const ImpactSettings& settings, std::string_view place);

}  // namespace sunder

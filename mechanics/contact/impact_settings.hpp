// SPDX-License-Identifier: MIT
// What a user chooses about impacts.
#pragma once

#include <cstdint>

namespace sunder {

/// What a user chooses about impacts. The stress of a blow lasts for a few L/c, the time in which a
/// wave crosses a component; a step of 10 L/c finds a fifteenth of it, so that the step would
/// decide what breaks. Components that are struck are therefore sub-stepped while the waves run.
struct ImpactSettings {
  /// Whether components that are struck are sub-stepped; false: one step for everything.
  bool window = true;
  /// Largest sub-step over L/c, L the component's extent (twice the distance of its farthest vertex
  /// from its centre), c the speed of compression waves. Sub-steps are never shorter than half the
  /// time in which a wave crosses a mean cell: the mesh carries no shorter waves.
  double fraction = 0.0625;
  /// A blow counts when its stress rho c v is at least this part of the tensile strength.
  double negligible = 0.1;
  /// Whether a window opens only where the energy that could come into a component before the next
  /// check could break it, and closes once less is left in it; false: at every such blow, for 2
  /// L/c.
  bool by_energy = true;
  /// Sub-steps allowed in one step; the remainder of the step is then taken at once.
  std::uint32_t max_sub_steps = 10000;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Settings of impacts.
#pragma once

#include <cstdint>

namespace sunder {

/// Settings of impacts. The stress of an impact lasts a few L/c, the time in which a wave crosses a
/// component. A step of 10 L/c finds a fifteenth of this stress, so the step would decide the
/// outcome. Struck components are therefore sub-stepped while the waves run.
struct ImpactSettings {
  /// True: struck components are sub-stepped. False: one step for all components.
  bool window = true;
  /// An impact counts if its stress rho c v is at least this share of the tensile strength.
  double negligible = 0.1;
  /// True: a window opens only if the energy that can enter a component before the next check could
  /// break it, and closes when less remains. False: a window opens at every such impact, for 2 L/c.
  bool by_energy = true;
  /// Most explicit sub-steps between two looks at windows, and at contacts with obstacles and crack
  /// faces. Cracks are looked for in each of them.
  std::uint32_t at_once = 16;
  /// Most sub-steps per step. The remainder of the step is then taken at once.
  std::uint32_t max_sub_steps = 10000;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// What a user chooses about the ladder.
#pragma once

namespace sunder {

/// Which components may be computed with less than full dynamics (docs/ladder.md).
struct LadderSettings {
  /// Whether components in free flight that cannot break move as rigid bodies.
  bool rigid = true;
  /// Whether supported components under slow loads go from equilibrium to equilibrium.
  bool quasi_static = true;
  /// Whether components at rest are not stepped until something touches them.
  bool sleep = true;
  /// How long they must have been at rest, s.
  double sleep_after = 0.1;
};

}  // namespace sunder

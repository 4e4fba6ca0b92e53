// SPDX-License-Identifier: MIT
// What a user chooses about the ladder.
#pragma once

namespace sunder {

/// How little of a component's motion may be computed (docs/ladder.md).
struct LadderSettings {
  /// Whether components in free flight that cannot break move as rigid bodies.
  bool rigid = true;
  /// Whether supported components under slow loads go from equilibrium to equilibrium.
  bool quasi_static = true;
  /// Whether components that lie still are left alone until something touches them.
  bool sleep = true;
  /// How long they must have lain still, s.
  double sleep_after = 0.1;
};

}  // namespace sunder

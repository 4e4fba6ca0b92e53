// SPDX-License-Identifier: MIT
// What a user chooses about the ladder.
#pragma once

namespace sunder {

/// Whether pieces that cannot break meet each other as rigid bodies
/// (docs/explanation/time_and_contact.md).
enum class RubbleMode {
  off,        ///< never
  certified,  ///< where a bound says that none of them can break before the next look
};

/// Which components may be computed with less than full dynamics
/// (docs/explanation/time_and_contact.md).
struct LadderSettings {
  /// Whether components in free flight that cannot break move as rigid bodies.
  bool rigid = true;
  /// Whether supported components under slow loads go from equilibrium to equilibrium.
  bool quasi_static = true;
  /// Whether components at rest are not stepped until something touches them.
  bool sleep = true;
  /// How long they must have been at rest, s.
  double sleep_after = 0.1;
  /// Whether what cannot break is stepped with its contacts as rubble, on a clock of about 1/240 s.
  RubbleMode rubble = RubbleMode::off;
  /// Pieces that have come off with no more than this share of their body's mass never break
  /// again, in [0, 1): no bound says so, the user does.
  double declared_rubble = 0;
};

}  // namespace sunder

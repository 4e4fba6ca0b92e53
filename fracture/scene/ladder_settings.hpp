// SPDX-License-Identifier: MIT
// Settings of activity levels.
#pragma once

namespace sunder {

/// Rule by which pieces that cannot break meet as rigid bodies
/// (docs/explanation/time_and_contact.md).
enum class RubbleMode {
  off,        ///< never
  certified,  ///< if a bound proves that none can break before the next check
  /// Those, and pieces that came off, until a blow could break one of them. Slow loads on such
  /// pieces are not looked at.
  until_struck,
};

/// Components that may be computed with less than full dynamics
/// (docs/explanation/time_and_contact.md).
struct LadderSettings {
  /// True: components in free flight that cannot break move as rigid bodies.
  bool rigid = true;
  /// True: supported components under slow loads go from equilibrium to equilibrium.
  bool quasi_static = true;
  /// True: components at rest sleep until something touches them.
  bool sleep = true;
  /// Time at rest before sleep, s.
  double sleep_after = 0.1;
  /// Rule by which components that cannot break are stepped with their contacts as rubble, with a
  /// clock of about 1/240 s.
  RubbleMode rubble = RubbleMode::off;
  /// Separated pieces with at most this share of their body's mass never break again, in [0, 1).
  /// This is the user's assumption, without a proof.
  double declared_rubble = 0;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Settings of impacts.
#pragma once

#include <cstdint>

namespace sunder {

/// How the sub-steps of an impact are taken.
enum class ImpactScheme {
  /// One implicit step each, contact through the compliance of the bodies (`WaveScheme`).
  implicit,
  /// Central differences on lumped masses in as many steps as are stable, contact by impulses in
  /// each of them (mechanics/contact/waves/).
  central,
};

/// Settings of impacts. The stress of an impact lasts a few L/c, the time in which a wave crosses a
/// component. A step of 10 L/c finds a fifteenth of this stress, so the step would decide the
/// outcome. Struck components are therefore sub-stepped while the waves run.
struct ImpactSettings {
  /// True: struck components are sub-stepped. False: one step for all components.
  bool window = true;
  ImpactScheme scheme = ImpactScheme::central;
  /// Largest sub-step divided by L/c. L is the component's extent (twice the distance of its
  /// farthest vertex from its centre), and c is the speed of compression waves. No sub-step is
  /// shorter than half the time in which a wave crosses a mean cell, because the mesh carries no
  /// shorter waves.
  double fraction = 0.0625;
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

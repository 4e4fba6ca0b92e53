// SPDX-License-Identifier: MIT
// Works of forces and contacts in explicit steps.
#pragma once

namespace sunder {

/// Works of forces in explicit steps, each on the mean of the velocities before and after a kick.
struct WaveWork {
  double inner = 0;     ///< J, by stress and viscosity
  double gravity = 0;   ///< J
  double loads = 0;     ///< J, by surface loads
  double supports = 0;  ///< J
};

/// Works of contacts in a part, J: on bodies, by friction, and by pushing deep sides out. And of
/// loads on the rigid bodies among them.
struct RowWork {
  double contact = 0, friction = 0, push_out = 0;
  double loads = 0;    ///< of surface loads on rigid bodies
  double on_held = 0;  ///< of contacts and bonds on nodes that supports hold
};

}  // namespace sunder

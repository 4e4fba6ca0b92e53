// SPDX-License-Identifier: MIT
// The flat bar on a rigid wall (nu = 0): a run of an impact with a known answer.
#pragma once

#include <array>

#include "fracture/scene/scene.hpp"

namespace sunder::accuracy {

/// A bar of Kuhn cells, 1 m long, of concrete with nu = 0, flies lengthwise at a wall at 1.5 xi /
/// (rho c), c = sqrt(E / rho), without gravity and friction. Exact: compression rho c v, never
/// tension, contact for 2 L/c, rebound at v.
struct BarImpact {
  std::array<int, 3> cells = {50, 1, 1};
  /// Length of a step over L/c.
  double step = 1;
  /// Where in a step, as a share of it, the bar touches first.
  double touches_at = 0.37;
  /// Impact speed over xi / (rho c).
  double blow = 1.5;
  bool breaks = true;
  IntegratorSettings integrator = {};
  ContactSettings contact = {};
  ImpactSettings impact = {};
};

/// Results; all would be 1 for the exact bar, unless noted.
struct BarOutcome {
  double element_compression = 0;  ///< largest over elements and time, / rho c v
  double node_compression = 0;     ///< the same of node stresses (eq. 6)
  double element_tension = 0;      ///< largest principal stress / xi; exact: 0
  double node_tension = 0;         ///< exact: 0
  double rebound = 0;              ///< speed away from the wall at the end / v
  double contact_time = 0;         ///< from first to last push of 1 per cent of rho c v, / (2 L/c)
  double energy_peak = 0;          ///< largest energy over that at the start
  double energy_end = 0;           ///< energy at the end / that at the start
  unsigned sub_steps = 0;
  bool broke = false;
};

/// Runs until the bar has left the wall for 3 L/c and four steps.
BarOutcome run_bar(const BarImpact& impact);

}  // namespace sunder::accuracy

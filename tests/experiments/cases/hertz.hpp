// SPDX-License-Identifier: MIT
// A round body that strikes a rigid wall slowly, against Hertz's answer.
#pragma once

#include <cstddef>

namespace sunder::accuracy {

/// A block of 1 x 1 x 1 m with a paraboloid of radius 1 m as lower face falls on a rigid plane
/// without friction. Cells shrink towards the contact. The error of Hertz's theory grows with the
/// radius of contact over the block's half width (a twentieth to a tenth here): the block is no
/// half-space and shortens as a whole.
struct HertzImpact {
  int cells = 8;           ///< across half the width, and two thirds as many in the height
  double smallest = 0.02;  ///< width of the cells in the middle, m
  double speed = 3;        ///< m/s; waves need c / speed times less time than the way it goes
  double poisson_ratio = 0.2;
};

/// Results relative to Hertz's answer, unless noted.
struct HertzOutcome {
  std::size_t vertices = 0;
  double radius_cells = 0;  ///< Hertz's radius of contact at the peak, in smallest cells
  double contact_time = 0;  ///< from first push to last / 2.87 (m^2 / (R E*^2 v))^(1/5)
  double force = 0;     ///< peak / (4/3 E* sqrt(R) d^1.5), d = (15 m v^2 / (16 E* sqrt R))^(2/5)
  double radius = 0;    ///< at the peak, sqrt(5/2 sum p r^2 / sum p) / sqrt(R d)
  double law = 0;       ///< the peak force over that of the radius seen, 4/3 E* a^3 / R
  double pressure = 0;  ///< in the middle at the peak / (3 F / (2 pi a^2)), F and a as seen
  double rebound = 0;   ///< speed away / speed it came at
};

/// Runs until it has left the wall. Seconds for 8 cells.
HertzOutcome run_hertz(const HertzImpact& impact);

}  // namespace sunder::accuracy

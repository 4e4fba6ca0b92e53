// SPDX-License-Identifier: MIT
// A ring that flies apart: how many fragments, against the exact rule of unloading waves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sunder::accuracy {

/// A thin ring of one cell in cross-section, 1 m in radius, nu = 0, every point of which flies
/// outwards at rate x radius. Its sections have strengths xi (1 + spread u), u drawn evenly from
/// [0, 1), so that flaws become critical at a constant rate. Hoop stress E rate sin(w t) / w,
/// w = c / R, until a release reaches the place. A break sends releases out at c behind which no
/// stress grows again, so section i breaks if and only if t_i < t_j + |s_i - s_j| / c for all j
/// that break: Mott's rule for an elastic ring. Means (Johnson and Mehl 1939; Kolmogorov 1937):
/// N / 2 sqrt(pi cell / (c T)) fragments of N cells, T the time in which all flaws would have
/// become critical; so a size proportional to rate^(-1/2).
struct RingBurst {
  int cells = 800;
  double rate = 3;         ///< 1/s
  double spread = 3;       ///< of strengths
  double step = 0.25;      ///< of a wave's way through a cell
  double viscosity = 0.1;  ///< C = this (cell / c) K
  std::uint32_t seed = 1;
  std::optional<double> toughness = {};  ///< Pa sqrt(m)
};

struct RingOutcome {
  std::size_t fragments = 0;      ///< pieces seen
  std::size_t expected = 0;       ///< by the rule, with these strengths
  double mean_expected = 0;       ///< by the mean over all draws, for small cells
  std::size_t same_sections = 0;  ///< sections that broke and should
  double grady_fragments = 0;     ///< 2 pi R / (sqrt(24) K_Ic / (rho c rate))^(2/3), K_Ic given
  double energy_per_area = 0;     ///< kinetic and strain energy lost / area of cracks, J/m^2
};

/// Runs until the strongest section would have broken.
RingOutcome run_ring(const RingBurst& burst);

}  // namespace sunder::accuracy

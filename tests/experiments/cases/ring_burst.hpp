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
  /// G_c, J/m^2: where given cracks are cohesive, and strengths are a function of place, drawn at
  /// 1600 places: cells divides that.
  std::optional<double> fracture_energy = {};
};

struct RingOutcome {
  std::size_t fragments = 0;      ///< pieces seen
  std::size_t expected = 0;       ///< by the rule, with these strengths
  double mean_expected = 0;       ///< by the mean over all draws, for small cells
  std::size_t same_sections = 0;  ///< sections that broke and should
  double zhou_fragments = 0;      ///< `zhou_size`, G_c given
  double taken = 0;               ///< work on ties / (G_c times the area of the sections apart)
  double grady_fragments = 0;     ///< 2 pi R / (sqrt(24) K_Ic / (rho c rate))^(2/3), K_Ic given
  double energy_per_area = 0;     ///< kinetic and strain energy lost / area of cracks, J/m^2
};

/// m, mean size of fragments of an expanding ring with cohesive sections of equal strength [Zhou,
/// Molinari and Ramesh 2006]: s / s0 = 4.5 / (1 + 4.5 e^(2/3)), s0 = E G_c / sigma^2, e = rate E^2
/// G_c / (c sigma^3).
double zhou_size(double rate, double fracture_energy);

/// Runs until the strongest section would have broken; with ties for half a millisecond more.
RingOutcome run_ring(const RingBurst& burst);

}  // namespace sunder::accuracy

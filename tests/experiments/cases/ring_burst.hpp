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
  double viscosity = 0.1;  ///< C = this (cell / c) K, without ties
  std::uint32_t seed = 1;
  /// G_c, J/m^2: where given cracks are cohesive, and strengths are a function of place, drawn at
  /// `places` points and linear between them, the same on all meshes with a multiple of these as
  /// cells.
  std::optional<double> fracture_energy = {};
  int places = 400;
  double after = 5e-4;  ///< s that a ring with ties runs on
};

struct RingOutcome {
  std::size_t fragments = 0;      ///< pieces seen
  std::size_t expected = 0;       ///< by the rule, with these strengths
  double mean_expected = 0;       ///< by the mean over all draws, for small cells
  std::size_t same_sections = 0;  ///< sections that broke and should
  double taken = 0;               ///< work on ties / (G_c times the area of the sections apart)
  double energy_per_area = 0;     ///< kinetic and strain energy lost / area of cracks, J/m^2
};

/// Of sections that all have the least strength, by `chain::zhou_size` and `chain::glenn_size`.
/// Need a fracture energy.
double zhou_fragments(const RingBurst& burst);
double glenn_fragments(const RingBurst& burst);

/// Runs until the strongest section would have broken; with ties for `after` more. A fragment is a
/// component of the map of pieces: bodies held by a tie are one.
RingOutcome run_ring(const RingBurst& burst);

/// Results of the one-dimensional program (`chain::Chain`) for the same ring.
struct ChainRingOutcome {
  std::size_t fragments = 0;  ///< sections that have opened by d_c
  std::size_t live = 0;       ///< others, open by more than a tenth of that
  double taken = 0;           ///< energy that the law says is gone / (G_c, sections apart)
  double contact = 0;         ///< energy taken by impacts of sections, over the same
  double residual = 0;        ///< of the ledger / energy that the law says is gone
};

/// The same strengths, material, rate and end on `cells` bars, in steps of `step` of a wave's way
/// through one. The viscosity is none of the program's own. Needs a fracture energy; the mesh, step
/// and viscosity of `burst` do not count.
ChainRingOutcome run_ring_on_chain(const RingBurst& burst, int cells, double step = 0.1,
                                   double viscosity = 0);

}  // namespace sunder::accuracy

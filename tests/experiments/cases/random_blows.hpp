// SPDX-License-Identifier: MIT
// Random blows round the energy that impact windows are opened by.
#pragma once

#include <cstdint>

namespace sunder::accuracy {

/// One blow twice, with windows at every blow and by energy. Small blocks of 1 to 3 cells per side,
/// turned at random and spinning: onto the floor, into each other, onto one that lies on the floor,
/// and several thrown together over a floor. The energy of the blow is a thirtieth to a thousand
/// times the need of a block's weakest star. Steps are 0.5 to 50 L/c. A hundredth of the strength
/// counts as a blow, so that the energy decides.
struct BlowOutcome {
  bool breaks_always = false, breaks_by_energy = false;
  bool opens_always = false, opens_by_energy = false;
  bool by_pair = false, by_island = false;  ///< which bound spared a block
};

/// The blow of a number; every number is another one, the same on every run.
BlowOutcome run_blow(std::uint64_t number);

struct BlowCounts {
  std::uint64_t blows = 0;
  std::uint64_t broke = 0;     ///< with windows at every blow
  std::uint64_t missed = 0;    ///< of those: no window by energy, must be 0
  std::uint64_t needless = 0;  ///< window by energy, but nothing broke with any
  std::uint64_t spared = 0;    ///< window at every blow, none by energy
  std::uint64_t spared_by_pair = 0, spared_by_island = 0;
};

/// Blows `first` to `first + count - 1`.
BlowCounts run_blows(std::uint64_t first, std::uint64_t count);

/// The certificate of the rung `rubble` under blows of the same kinds. Their energies are a
/// thousandth to a thousand times the need of a block's weakest star.
struct CertificateCounts {
  std::uint64_t blows = 0;
  std::uint64_t certified = 0;  ///< scenes with all blocks as rubble in the first tick
  std::uint64_t missed = 0;     ///< of those: stepped in full something broke in it; must be 0
  std::uint64_t refused = 0;    ///< scenes in which a certificate was refused
  std::uint64_t needless = 0;   ///< of those: nothing broke in the tick
};
CertificateCounts run_certificates(std::uint64_t first, std::uint64_t count);

}  // namespace sunder::accuracy

// SPDX-License-Identifier: MIT
// Strengths and pulses as functions of place, for Sunder's meshes and for the chain alike.
#pragma once

#include <cstdint>
#include <vector>

namespace sunder::chain {

/// Strengths round a ring, the same function of place on every mesh: drawn evenly from xi to
/// xi (1 + spread) at `places` points, linear between them.
struct RingStrengths {
  double least = 3e6;  ///< xi, Pa
  double spread = 3;
  int places = 400;
  std::uint32_t seed = 1;
};

/// Pa, at `cells` equal sections of the ring, the first at the first of the places. A mesh with a
/// multiple of the places as cells has every weakest point in it. Needs both > 0.
std::vector<double> strengths_of(const RingStrengths& strengths, int cells);

/// A sawtooth of compression that runs along x: its front stands at `front`, it rises to `peak`
/// over `ramp` behind that and falls to nothing over the rest of `length`.
struct Pulse {
  double front, ramp, length, peak;  ///< m, m, m, Pa

  /// Pa, compression > 0.
  double stress(double x) const;
  /// Pa m: of the stress from x on; by E it is the displacement.
  double integral(double x) const;
};

/// Number of fragments of a ring 2 pi m round with cohesive sections of equal strength.
struct RingLaw {
  double young_modulus = 30e9, density = 2400, strength = 3e6, fracture_energy = 33;  ///< SI
  double rate = 1.5;                                                                  ///< 1/s
};

/// m, mean size of a fragment [Zhou, Molinari and Ramesh 2006]: s / s0 = 4.5 / (1 + 4.5 e^(2/3)),
/// s0 = E G_c / sigma^2, e = rate E^2 G_c / (c sigma^3).
double zhou_size(const RingLaw& law);

/// m [Glenn and Chudnovsky 1986]: s / s0 = (4 / e) sinh(asinh(1.5 e) / 3).
double glenn_size(const RingLaw& law);

}  // namespace sunder::chain

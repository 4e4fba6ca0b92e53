// SPDX-License-Identifier: MIT
// The two sides of a face that came apart.
#pragma once

#include <array>
#include <cstdint>

#include "topology/base/ids.hpp"

namespace sunder {

/// Two half-faces that were one face, and the pairs of corners that met. They need no search to
/// find each other, and their gap is exactly 0 when they part. Exceptions are pieces that turn
/// rigid: their positions are rounded again.
struct Partner {
  HalfFaceId face, opposite;
  /// Places of the corners in their tetrahedra, by the darts of `face` (dart_order); k meets k.
  std::array<std::uint8_t, 3> corner{}, opposite_corner{};
  /// m, half the smaller inradius of the two tetrahedra: a partner that has parted or slid so far
  /// is treated like any other piece from then on.
  double reach = 0;
};

}  // namespace sunder

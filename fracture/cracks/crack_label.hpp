// SPDX-License-Identifier: MIT
// A crack's name, and the side of it that a tetrahedron is on.
#pragma once

#include <cstdint>

#include "topology/base/ids.hpp"

namespace sunder {

/// Row of a crack; ids grow and are never reused.
using CrackId = Id<struct CrackTag>;

/// The side of a crack that a tetrahedron is on, once decided for good.
struct CrackLabel {
  CrackId crack;
  TetId tetrahedron;
  bool positive = false;
  /// 1 + the row of the label that the tetrahedron got before; 0: none.
  std::uint32_t before = 0;
};

}  // namespace sunder

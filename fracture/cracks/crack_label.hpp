// SPDX-License-Identifier: MIT
// The side of a crack that a tetrahedron is on.
#pragma once

#include <cstdint>

#include "mechanics/ties/crack_id.hpp"

namespace sunder {

/// The side of a crack that a tetrahedron is on. The decision is final.
struct CrackLabel {
  CrackId crack;
  TetId tetrahedron;
  bool positive = false;
  /// 1 + the row of the tetrahedron's previous label; 0: none.
  std::uint32_t before = 0;
};

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The energy that a fan gave up, as reports tell it.
#pragma once

#include <cstdint>

namespace sunder {

/// What a fan gave up.
struct CrackEnergy {
  std::uint64_t fan = 0;
  double time = 0;    ///< s
  double area = 0;    ///< m^2
  double energy = 0;  ///< J; over `area`: energy per crack area
};

}  // namespace sunder

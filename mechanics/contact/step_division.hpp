// SPDX-License-Identifier: MIT
// A step in parts of a power of two, short where pieces would pass each other.
#pragma once

#include <cstdint>

namespace sunder {

/// How a step is divided: parts are halved where pieces would pass each other in one, and joined
/// again by two once that is over.
struct StepDivision {
  std::uint32_t parts = 1;  ///< parts of the present length in the whole step, a power of two
  std::uint32_t taken = 0;  ///< how many of them are over
  /// Parts are not looked at from so many on. At least `least_limit`. More while pieces that pass
  /// each other move farther in a part than their cells are long.
  std::uint32_t limit = 256;
  std::uint32_t streak = 0;    ///< parts taken at the present length
  std::uint32_t patience = 2;  ///< how many are taken before two are joined
  bool has_grown = false;      ///< whether the last change made parts longer

  /// Whether a part in which pieces would pass each other is to be refused.
  bool may_divide() const { return parts < limit; }
};

inline constexpr std::uint32_t least_limit = 256, most_parts = 65536;

/// Notes that pieces would have passed each other in the part at hand, and halves the parts.
/// `way`: how far they move against each other in it, in mean edges of the smaller cell.
void divide(StepDivision& division, double way);

/// Notes that the part at hand was taken. Joins parts by two where many of one length were taken.
/// An attempt at longer parts that fails doubles how many are taken before the next.
void take_part(StepDivision& division);

}  // namespace sunder

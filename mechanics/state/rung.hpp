// SPDX-License-Identifier: MIT
// The rungs of the ladder: how much of a motion is computed.
#pragma once

#include <cstddef>

namespace sunder {

/// How much of a component's motion a step computes: no more than it needs (docs/ladder.md).
enum class Rung : unsigned char {
  full,          ///< frame and deformation
  quasi_static,  ///< the equilibrium under the present load, of what is supported
  rigid,         ///< the frame; what it is deformed by stays
  asleep,        ///< nothing: it lies still
};
inline constexpr std::size_t rung_count = 4;

/// Whether displacements change on a rung.
constexpr bool deforms(Rung rung) { return rung == Rung::full || rung == Rung::quasi_static; }

}  // namespace sunder

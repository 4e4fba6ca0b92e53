// SPDX-License-Identifier: MIT
// The rungs of the ladder: how much of a motion is computed.
#pragma once

#include <cstddef>

namespace sunder {

/// How much of a component's motion a step computes: no more than it needs
/// (docs/explanation/time_and_contact.md).
enum class Rung : unsigned char {
  full,          ///< rigid motion and deformation
  quasi_static,  ///< the equilibrium under the present load; supported components only
  rigid,         ///< rigid motion; the deformation stays as it is
  asleep,        ///< nothing: the component is at rest
  rubble,        ///< rigid motion and contact, on a clock of its own
  carried,       ///< inside a step only: what has taken it already meets what is sub-stepped
};
/// Those on which components are between steps.
inline constexpr std::size_t rung_count = 5;

/// Whether displacements change on a rung.
constexpr bool deforms(Rung rung) { return rung == Rung::full || rung == Rung::quasi_static; }

}  // namespace sunder

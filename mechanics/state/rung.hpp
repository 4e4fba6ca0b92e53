// SPDX-License-Identifier: MIT
// Activity levels: the computed part of a motion.
#pragma once

#include <cstddef>

namespace sunder {

/// Activity level of a component: the part of its motion that a step computes
/// (docs/explanation/time_and_contact.md).
enum class Rung : unsigned char {
  full,          ///< rigid motion and deformation
  quasi_static,  ///< the equilibrium under the present load; supported components only
  rigid,         ///< rigid motion; the deformation stays as it is
  asleep,        ///< nothing: the component is at rest
  rubble,        ///< rigid motion and contact, with a clock of its own
  carried,       ///< within a step only: has taken the step, and meets sub-stepped components
  stiff,         ///< within a step only: like `rigid`, and stays so where contact finds it
};
/// Number of levels that components can have between steps.
inline constexpr std::size_t rung_count = 5;

/// True if contact finds a rigid body at this level, in a step or a part of one.
constexpr bool is_stiff(Rung rung) { return rung == Rung::carried || rung == Rung::stiff; }

/// True if displacements change at this level.
constexpr bool deforms(Rung rung) { return rung == Rung::full || rung == Rung::quasi_static; }

}  // namespace sunder

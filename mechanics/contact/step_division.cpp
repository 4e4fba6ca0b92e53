// SPDX-License-Identifier: MIT
// Halving and joining of the parts of a step.
#include "mechanics/contact/step_division.hpp"

#include <algorithm>
#include <bit>

namespace sunder {

void divide(StepDivision& division, double way) {
  constexpr std::uint32_t most_patience = 64;
  // Contacts on straight ways, and their turns, hold for about half an edge per part.
  const double asked = std::min(2 * way * division.parts, double(most_parts));
  division.limit = std::max(division.limit, std::bit_ceil(static_cast<std::uint32_t>(asked)));
  if (division.has_grown) division.patience = std::min(2 * division.patience, most_patience);
  division.parts *= 2;
  division.taken *= 2;
  division.streak = 0;
  division.has_grown = false;
}

void take_part(StepDivision& division) {
  ++division.taken;
  ++division.streak;
  const bool is_over = division.taken == division.parts;
  if (is_over || division.taken % 2 != 0 || division.streak < division.patience) return;
  division.parts /= 2;
  division.taken /= 2;
  division.streak = 0;
  if (division.has_grown) division.patience = std::max(2u, division.patience / 2);
  division.has_grown = true;
}

}  // namespace sunder

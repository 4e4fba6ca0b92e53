// SPDX-License-Identifier: MIT
#include "apps/sunder/break/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "topology/base/counted.hpp"

namespace sunder {

std::string outcome_sentence(std::span<const double> masses, std::size_t cracks) {
  if (masses.size() == 1) {
    return cracks == 0 ? "1 piece: it did not break"
                       : fmt::format("1 piece with {}", counted(cracks, "crack"));
  }
  const double all = std::accumulate(masses.begin(), masses.end(), 0.0);
  double large = 0;
  std::size_t count = 0;
  for (const double mass : masses) {
    if (mass < large_share * all) continue;
    large += mass;
    ++count;
  }
  const double largest = *std::ranges::max_element(masses);
  return fmt::format("{} pieces, {} with {:.0f} % of the mass, largest {:.0f} %", masses.size(),
                     counted(count, "large one"), 100 * large / all, 100 * largest / all);
}

}  // namespace sunder

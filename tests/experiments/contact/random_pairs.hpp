// SPDX-License-Identifier: MIT
// Random pairs of solids thrown at each other, with an independent judge.
#pragma once

#include <cstdint>

#include "tests/experiments/contact/random_throws.hpp"

namespace sunder::test {

/// One pair with its judgement.
struct RandomPair : ThrowFigures {
  bool met = false;     ///< a contact had an impulse
  bool passed = false;  ///< through each other between two moments, or in and out
  double deepest = 0;   ///< mean edges of the smaller one: overlap at the end of a step
  double last = 0;      ///< mean edges: overlap as the run ends
};

/// Makes the pair of a seed, lets it meet and judges it: by separating axes at the end of each
/// step, and by `judge_crossings` within, over moments in which nothing turns by more than 0.05
/// rad. The same seed gives the same pair.
RandomPair run_random_pair(std::uint64_t seed);

}  // namespace sunder::test

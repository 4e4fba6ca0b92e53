// SPDX-License-Identifier: MIT
// Case 13, fragment sizes: a ring that flies apart against Mott's rule of unloading waves.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/experiments/cases/ring_burst.hpp"

using namespace sunder::accuracy;

TEST_CASE("case 13: a ring breaks where no unloading wave comes first", "[accuracy][case13]") {
  const auto seed = GENERATE(1u, 2u, 3u);
  const RingOutcome o = run_ring({.seed = seed});
  INFO("seed " << seed << ": " << o.fragments << " fragments, " << o.expected << " by the rule, "
               << o.same_sections << " sections of it");
  // Stress is averaged over the cells next to a section, so releases are felt a cell early and some
  // sections are spared; those that break are the rule's.
  CHECK(double(o.same_sections) >= 0.95 * double(o.fragments));
  CHECK(double(o.fragments) >= 0.7 * double(o.expected));
  CHECK(double(o.fragments) <= 1.02 * double(o.expected));
}

TEST_CASE("case 13: fragments of a ring become smaller with the root of its rate",
          "[accuracy][case13]") {
  const RingOutcome slow = run_ring({.rate = 1.5}), fast = run_ring({.rate = 6});
  const auto slope = [](std::size_t few, std::size_t many) {
    return std::log(double(many) / double(few)) / std::log(4.0);
  };
  const double seen = slope(slow.fragments, fast.fragments);
  INFO(slow.fragments << " and " << fast.fragments << ", by the rule " << slow.expected << " and "
                      << fast.expected);
  CHECK(seen == Approx(slope(slow.expected, fast.expected)).margin(0.12));
  CHECK(seen == Approx(0.5).margin(0.12));
}

TEST_CASE("case 13: a ring whose cracks take energy breaks as the one-dimensional program does",
          "[accuracy][case13]") {
  const double spread = GENERATE(0.5, 3.0);
  const RingBurst burst{.cells = 400, .rate = 1.5, .spread = spread, .fracture_energy = 33};
  const RingOutcome seen = run_ring(burst);
  const ChainRingOutcome fine = run_ring_on_chain(burst, 1600);
  INFO(seen.fragments << ", by the program " << fine.fragments << ", by Zhou "
                      << zhou_fragments(burst));
  // On 400 cells the viscosity of the sub-steps costs fragments: docs/lab/accuracy.md.
  CHECK(double(seen.fragments) == Approx(double(fine.fragments)).epsilon(spread < 1 ? 0.1 : 0.2));
  if (spread < 1) CHECK(double(seen.fragments) == Approx(zhou_fragments(burst)).epsilon(0.25));
}

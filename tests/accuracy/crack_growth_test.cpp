// SPDX-License-Identifier: MIT
// One clean crack through a notched bar.
#include "tests/accuracy/crack_growth.hpp"

#include <catch2/catch.hpp>

using namespace sunder;
using namespace sunder::accuracy;

TEST_CASE(
    "a notched bar of glass, pulled slowly, breaks in two along one plane when stresses are "
    "solved for again around each fan",
    "[accuracy][crack][relax]") {
  const auto criterion = GENERATE(FractureCriterion::stress, FractureCriterion::energy);
  NotchedBar bar{.material = {.young_modulus = 70e9,
                              .poisson_ratio = 0.22,
                              .density = 2500,
                              .tensile_strength = 45e6,
                              .toughness = 0.75e6},
                 .fracture = {.criterion = criterion, .relax = 2}};
  const GrowthAnswer answer = pulled_apart(bar);
  CHECK(answer.pieces == 2);
  CHECK(answer.area == Approx(1));
  CHECK(answer.farthest < 1e-9);
  CHECK(answer.smallest == Approx(0.5));
}

// SPDX-License-Identifier: MIT
// One clean crack through a notched bar.
#include "tests/experiments/cases/crack_growth.hpp"

#include <catch2/catch.hpp>

#include "tests/experiments/cases/disc_crack.hpp"

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

TEST_CASE(
    "where a load step takes many vertices over their strength at once, stresses solved for "
    "again leave one crack where fans on stale stresses shatter",
    "[accuracy][crack][relax]") {
  NotchedBar bar{.height = 0.4,
                 .cells = 8,
                 .material = {.young_modulus = 30e9,
                              .poisson_ratio = 0.2,
                              .density = 2400,
                              .tensile_strength = 3e6,
                              .toughness = 1e6},
                 .stress_rate = 3e8,
                 .shake = 0.15};
  const GrowthAnswer shattered = pulled_apart(bar, 5);
  bar.fracture.relax = 2;
  const GrowthAnswer clean = pulled_apart(bar, 5);
  CHECK(clean.pieces == 2);
  CHECK(clean.area < 1.5);
  CHECK(shattered.pieces > 2);
  CHECK(shattered.area > 3 * clean.area);
}

TEST_CASE(
    "a disc pressed on two arcs of 20 degrees breaks at the load of Hondros, along the "
    "loaded diameter",
    "[accuracy][crack][disc]") {
  const DiscAnswer disc = brazilian_disc(18);
  CHECK(disc.tension == Approx(1).margin(0.08));
  CHECK(disc.load == Approx(1).margin(0.08));
  CHECK(disc.first < 0.5);
  CHECK(disc.farthest < 1);
  CHECK(disc.upright > 0.95);
  CHECK(disc.area < 1.3);
  CHECK(disc.length >= 0.75);
}

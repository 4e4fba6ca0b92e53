// SPDX-License-Identifier: MIT
// Case 13, spall: the first layer that a pulse breaks off a flat bar, against plane waves.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/spall.hpp"

using namespace sunder::accuracy;

TEST_CASE("case 13: a pulse breaks a layer of (l - r) xi / (2 s0) off the free end",
          "[accuracy][case13]") {
  const double peak = GENERATE(1.5, 2.5);
  const int cells = GENERATE(150, 300);
  const SpallOutcome o = run_spall({.cells = cells, .peak = peak, .front = 8});
  REQUIRE(!o.thickness.empty());
  INFO(cells << " cells, s0 = " << peak << " xi: " << o.thickness.front() << " for "
             << o.exact_thickness << ", speed " << o.speed << ", time " << o.time);
  CHECK(o.thickness.front() == Approx(o.exact_thickness).margin(1.5 / cells));
  CHECK(o.speed == Approx(0.96).margin(0.03));
  CHECK(o.time == Approx(1.12).margin(0.08));
  CHECK(o.momentum == Approx(1).epsilon(1e-12));
}

TEST_CASE("case 13: a pulse below the strength breaks nothing off a free end",
          "[accuracy][case13]") {
  const SpallOutcome o = run_spall({.peak = 0.9, .front = 8});
  CHECK(o.thickness.empty());
}

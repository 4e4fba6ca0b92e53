// SPDX-License-Identifier: MIT
// Ten seconds of free flight.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/free_flight.hpp"

using namespace sunder::accuracy;

TEST_CASE("a rod of 30 GPa at 50 rad/s flies for 10 s with its momenta, its stress, and no crack",
          "[accuracy][flight]") {
  const double h = GENERATE(1e-3, 10e-3, 16.7e-3);
  const FlightDrift drift = run_free_flight({.time_step = h, .ladder = GENERATE(false, true)});
  INFO("step " << h << " s: P " << drift.momentum << ", L " << drift.angular_momentum << ", energy "
               << drift.energy << ", stress " << drift.least_stress << " to " << drift.most_stress);
  CHECK(drift.failure.empty());
  CHECK(drift.momentum < 1e-9);
  CHECK(drift.angular_momentum < 1e-9);
  CHECK(drift.least_stress > 0.99);
  CHECK(drift.most_stress < 1.01);
  CHECK(drift.fans == 0);
}

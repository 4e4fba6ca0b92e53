// SPDX-License-Identifier: MIT
// Case 12: a round body on a rigid wall against Hertz, as far as linear tetrahedra go.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/experiments/cases/hertz.hpp"

using namespace sunder::accuracy;

TEST_CASE("case 12: a round body stays on a wall for Hertz's time and presses with his force",
          "[accuracy][case12]") {
  // 3 cells in the radius of contact, 2 000 vertices: too stiff by a fifth, which is 0.08 of both.
  const double speed = GENERATE(0.3, 3.0);
  const double nu = speed < 1 ? 0 : 0.2;
  const double smallest = 0.02 * std::pow(speed / 3, 0.4);
  const HertzOutcome o =
      run_hertz({.cells = 8, .smallest = smallest, .speed = speed, .poisson_ratio = nu});
  INFO(speed << " m/s, nu " << nu << ", " << o.radius_cells << " cells in the radius");
  CHECK(o.contact_time == Approx(0.92).margin(0.03));
  CHECK(o.force == Approx(1.1).margin(0.03));
  CHECK(o.radius == Approx(0.98).margin(0.03));
  CHECK(o.pressure == Approx(0.95).margin(0.06));
  CHECK(o.rebound > 0.96);
  CHECK(o.rebound < 1);
}

TEST_CASE("case 12: with cells time and force of a round body come to Hertz's",
          "[accuracy][case12]") {
  const HertzOutcome coarse = run_hertz({.cells = 6});
  const HertzOutcome fine = run_hertz({.cells = 9});
  INFO("time " << coarse.contact_time << ", " << fine.contact_time << "; force " << coarse.force
               << ", " << fine.force);
  // Two thirds of the cells' width, two thirds of the error.
  CHECK((1 - fine.contact_time) / (1 - coarse.contact_time) == Approx(2.0 / 3).margin(0.15));
  CHECK((fine.force - 1) / (coarse.force - 1) == Approx(0.55).margin(0.2));
}

// SPDX-License-Identifier: MIT
// Long steps come to the static answer at once.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/sudden_load.hpp"

using namespace sunder::accuracy;

TEST_CASE("a suddenly loaded bar is within 2 per cent of static in 5 long steps, and stays there",
          "[accuracy][static]") {
  const double wh = GENERATE(10.0, 30.0, 100.0, 1000.0);
  const bool across = GENERATE(false, true);
  const int before = GENERATE(0, 1, 7);
  const double rho = GENERATE(0.0, 0.5);  // follows the step: 0 in long ones
  const auto steps = run_sudden_load({wh, across, before, rho}, 30);
  INFO("w h " << wh << (across ? ", across" : ", along") << ", after " << before << " steps, rho "
              << rho);
  for (std::size_t k = 4; k < steps.size(); ++k) {
    CHECK(steps[k].displacement < 0.02);
    CHECK(steps[k].stress < 0.02);
  }
}

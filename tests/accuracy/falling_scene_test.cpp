// SPDX-License-Identifier: MIT
// The breaking of a falling body does not depend on the step.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/falling_scene.hpp"

using namespace sunder;
using namespace sunder::accuracy;

TEST_CASE("a falling cube breaks at the same time and into the same largest piece at h, h/4, h/16",
          "[accuracy][impact]") {
  Scene scene = falling_cube(4);
  scene.bodies.front().velocity = {0, 0, -4};
  scene.duration = 0.008;
  scene.integrator.time_step = 1e-3;
  const FallOutcome coarse = run_fall(scene);
  REQUIRE(coarse.fans > 0);
  CHECK(coarse.largest_share < 0.99);
  for (const double part : {4, 16}) {
    scene.integrator.time_step = 1e-3 / part;
    const FallOutcome fine = run_fall(scene);
    INFO("step 1 ms / " << part << ": " << fine.fans << " fans, " << coarse.fans << " at 1 ms");
    CHECK(fine.first_fan == Approx(coarse.first_fan).epsilon(0.05));
    CHECK(fine.largest_share == Approx(coarse.largest_share).epsilon(0.15));
  }
}

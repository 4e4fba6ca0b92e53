// SPDX-License-Identifier: MIT
// Overlaps leave at their speed, and small ones stay.
#include "mechanics/contact/push_out.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("an overlap is pushed out at a speed, down to a depth that stays",
          "[mechanics][contact]") {
  ContactSettings settings;
  settings.allowed_penetration = 1e-5;
  settings.push_out_speed = 1e-3;
  const double h = 1e-2;
  CHECK(push_out_distance(settings, 1e-3, h) == 0);
  CHECK(push_out_distance(settings, -1e-5, h) == 0);
  CHECK(push_out_distance(settings, -1.5e-5, h) == Approx(5e-6));
  CHECK(push_out_distance(settings, -1e-3, h) == Approx(1e-5));
  double gap = -1e-4;
  int steps = 0;
  for (; push_out_distance(settings, gap, h) > 1e-12; ++steps) {
    gap += push_out_distance(settings, gap, h);
  }
  CHECK(steps == 9);
  CHECK(gap == Approx(-1e-5));
}

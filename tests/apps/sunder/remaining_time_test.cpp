// SPDX-License-Identifier: MIT
// The time left follows the measured rate.
#include "apps/sunder/run/remaining_time.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace sunder;

namespace {

/// The greatest error of the time left, as a factor, from a tenth of the run on: of a run that
/// takes 1 s per simulated second until `turn` and `late` from there to 1 s, in steps of 1 ms.
double worst_factor(const ExpectedTime& expected, double turn, double late, double from) {
  const auto cost = [&](double t) { return std::min(t, turn) + late * std::max(0.0, t - turn); };
  RemainingTime remaining(expected, 0, 1);
  double worst = 1;
  for (int k = 1; k <= 980; ++k) {
    const double t = 1e-3 * k;
    remaining.reach(t, cost(t));
    const double ratio = remaining.left() / (cost(1) - cost(t));
    if (t > from) worst = std::max({worst, ratio, 1 / ratio});
  }
  return worst;
}

}  // namespace

TEST_CASE("the time left follows the expected rate, then the measured one", "[run][progress]") {
  const ExpectedTime right{{{0, 1}, {0.3, 20}}};
  const RemainingTime start(right, 0, 1);
  CHECK(start.left() == Approx(14.3));
  CHECK(worst_factor(right, 0.3, 20, 0) < 1.1);
  // Nothing was expected, and a tenth of the run was expected to take a hundred times as long.
  CHECK(worst_factor({{{0, 0}}}, 1, 1, 0.1) < 2);
  CHECK(worst_factor({{{0, 1}, {0.3, 2000}}}, 0.3, 20, 0.6) < 2);
  // The blow comes earlier than expected, or never.
  CHECK(worst_factor({{{0, 1}, {0.5, 20}}}, 0.3, 20, 0.4) < 1.5);
  CHECK(worst_factor({{{0, 1}, {0.3, 20}}}, 1, 1, 0.5) < 2);
  // A run that goes on behind its middle.
  RemainingTime resumed(right, 0.8, 1);
  CHECK(resumed.left() == Approx(4));
  resumed.reach(0.9, 2);
  CHECK(resumed.left() == Approx(2));
  resumed.reach(1, 4);
  CHECK(resumed.left() == 0);
  // A run that has ended has nothing left.
  CHECK(RemainingTime(right, 1, 1).left() == 0);
  CHECK(RemainingTime(right, 1.1, 1).left() == 0);
}

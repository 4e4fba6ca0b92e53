// SPDX-License-Identifier: MIT
// The flat bar on a wall against its exact answer, at a smaller size than `impact_bar` prints.
#include <catch2/catch.hpp>

#include "tests/experiments/cases/impact_bar.hpp"

using namespace sunder;
using namespace sunder::accuracy;

TEST_CASE(
    "a flat bar struck at 1.5 xi / (rho c) sees rho c v, leaves after 2 L/c and stays whole, "
    "whatever the step",
    "[accuracy][impact]") {
  const auto cells = GENERATE(std::array{20, 1, 1}, std::array{12, 2, 2});
  const double step = GENERATE(0.02, 0.3, 1.0, 3.0, 10.0, 250.0);
  const BarOutcome o = run_bar({.cells = cells, .step = step, .impact = {}});
  INFO(cells[0] << " cells, step " << step << " L/c");
  CHECK(o.element_compression == Approx(1).margin(0.1));
  CHECK(o.node_compression == Approx(1).margin(0.1));
  CHECK(o.contact_time == Approx(1).margin(0.05));
  CHECK(o.rebound <= 1);
  CHECK(o.rebound > 0.7);
  CHECK(o.energy_peak <= 1 + 1e-12);
  // Any front that a mesh spreads over some cells is half reflected as tension when the bar parts
  // from the wall: up to 0.5 rho c v = 0.75 xi (docs/lab/impact.md).
  CHECK(o.element_tension < 0.75);
  CHECK(!o.broke);
}

TEST_CASE("where in a step the bar touches changes nothing that matters", "[accuracy][impact]") {
  const double at = GENERATE(0.0, 0.5, 0.9, 0.999);
  const double step = GENERATE(1.0, 25.0);
  const BarImpact middle{.cells = {20, 1, 1}, .step = step, .impact = {}};
  BarImpact other = middle;
  other.touches_at = at;
  const BarOutcome a = run_bar(middle), b = run_bar(other);
  INFO("touches at " << at << " of a step of " << step << " L/c");
  CHECK(b.element_compression == Approx(a.element_compression).margin(0.04));
  CHECK(b.contact_time == Approx(1).margin(0.05));
  CHECK(b.rebound == Approx(a.rebound).margin(0.04));
  CHECK(!b.broke);
}

TEST_CASE("a bar struck at three times its limit breaks at every step, and only with windows",
          "[accuracy][impact]") {
  // Off its limit by far it breaks in the tension that any mesh has on parting: 0.4 rho c v.
  const double step = GENERATE(0.3, 10.0, 250.0);
  BarImpact impact{.cells = {20, 1, 1}, .step = step, .blow = 4, .impact = {}};
  INFO("step " << step << " L/c");
  CHECK(run_bar(impact).broke);
  impact.impact.window = false;
  CHECK(run_bar(impact).broke == (step < 1));
}

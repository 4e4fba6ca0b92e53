// SPDX-License-Identifier: MIT
// The search for the finest mesh within a time.
#include "apps/sunder/break/budget.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace sunder;

namespace {

/// A mesh of so many tetrahedra that takes `seconds`.
Costed costing(double tetrahedra, double seconds) {
  Costed c;
  c.mesh.tetrahedra.resize(static_cast<std::size_t>(tetrahedra));
  c.seconds = seconds;
  return c;
}

}  // namespace

TEST_CASE("the mesh that fills a budget is found within five", "[break]") {
  for (const double growth : {1.0, 1.3, 1.8}) {
    for (const double budget : {5.0, 60.0, 300.0}) {
      int made = 0;
      const auto make = [&](double n) -> std::optional<Costed> {
        ++made;
        return costing(n, 10 * std::pow(n / 3000, growth));
      };
      const auto found = finest_within([&] { return budget; }, make);
      INFO(growth << ", " << budget);
      REQUIRE(found);
      CHECK(made <= 5);
      CHECK(found->seconds <= budget);
      CHECK(found->seconds >= 0.5 * budget);
    }
  }
}

TEST_CASE("where no mesh fits the cheapest is taken, and a mesher's floor ends the search",
          "[break]") {
  int made = 0;
  const auto floor = [&](double n) -> std::optional<Costed> {
    ++made;
    return costing(std::max(n, 4000.0), 100 + std::max(n, 4000.0) / 1000);
  };
  const auto found = finest_within([] { return 10.0; }, floor);
  REQUIRE(found);
  CHECK(found->mesh.tetrahedra.size() == 4000);
  CHECK(made <= 5);
  CHECK_FALSE(finest_within([] { return 10.0; },
                            [](double) -> std::optional<Costed> { return std::nullopt; }));
}

TEST_CASE("pictures take time by their number and size", "[break]") {
  CHECK(drawing_time(10, 1, 5000) == Approx(10 * drawing_time(1, 1, 5000)));
  CHECK(drawing_time(1, 2, 5000) > 1.5 * drawing_time(1, 1, 5000));
}

// SPDX-License-Identifier: MIT
// A short run of the checks that `sunder_random_cells 100000 1` makes at length.
#include "tests/topology/cells/random_cells.hpp"

#include <catch2/catch.hpp>

TEST_CASE("random operations on cells of ten bodies do as the twin says", "[topology][cells]") {
  const auto run = sunder::test::random_cells(800, 20261123);
  INFO(run.failure);
  CHECK(run.failure.empty());
  CHECK(run.inserted > 50);
  CHECK(run.refined > 10);
  CHECK(run.cut > 10);
  CHECK(run.splits > 50);
  CHECK(run.undone > 100);
  CHECK(run.redone > 20);
}

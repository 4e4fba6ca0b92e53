// SPDX-License-Identifier: MIT
#include "topology/base/sort_unique.hpp"

#include <catch2/catch.hpp>

TEST_CASE("sort_unique leaves each value once, ascending", "[kernel][sort_unique]") {
  std::vector<int> values = {3, 1, 3, 2, 1, 1};
  sunder::sort_unique(values);
  CHECK(values == std::vector<int>{1, 2, 3});
  values.clear();
  sunder::sort_unique(values);
  CHECK(values.empty());
}

// SPDX-License-Identifier: MIT
#include "topology/io/text/number_index.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace sunder::io;

TEST_CASE("numbers lead to their rows, dense or not", "[io][number_index]") {
  constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  const auto numbers =
      GENERATE_COPY(std::vector<std::int64_t>{3, 1, 2, 7}, std::vector<std::int64_t>{-2, -1, 0},
                    std::vector<std::int64_t>{lowest, 0, highest});
  NumberIndex index;
  std::array<std::int64_t, 2> twice{};
  REQUIRE(index_numbers(index, numbers, twice));
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    CHECK(row_of(index, numbers[row]) == static_cast<std::int64_t>(row));
  }
  CHECK(row_of(index, 12345) == -1);
  CHECK(row_of(index, -12345) == -1);
}

TEST_CASE("a number that comes twice is told with both its rows", "[io][number_index]") {
  const auto numbers = GENERATE(std::vector<std::int64_t>{5, 6, 7, 6},
                                std::vector<std::int64_t>{5, 1LL << 60, 7, 1LL << 60});
  NumberIndex index;
  std::array<std::int64_t, 2> twice{};
  CHECK_FALSE(index_numbers(index, numbers, twice));
  CHECK(twice == std::array<std::int64_t, 2>{1, 3});
}

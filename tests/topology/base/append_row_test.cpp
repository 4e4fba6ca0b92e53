// SPDX-License-Identifier: MIT
#include "topology/base/append_row.hpp"

#include <catch2/catch.hpp>
#include <cstddef>

TEST_CASE("a column that grows by rows holds at most an eighth too much", "[kernel][append_row]") {
  std::vector<std::size_t> column;
  std::size_t moves = 0;
  const std::size_t* home = column.data();
  constexpr std::size_t rows = 100000;
  for (std::size_t row = 0; row < rows; ++row) {
    sunder::append_row(column, row);
    if (column.data() != home) {
      moves += column.size();
      // The full column had `row` rows; eight more let a short one grow.
      REQUIRE(column.capacity() == row + row / 8 + 8);
    }
    home = column.data();
  }
  for (std::size_t row = 0; row < rows; ++row) REQUIRE(column[row] == row);
  CHECK(moves < 10 * rows);  // some eight copies of each row
}

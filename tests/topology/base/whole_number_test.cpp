// SPDX-License-Identifier: MIT
// The cast from real to whole numbers is defined for every number.
#include "topology/base/whole_number.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

using sunder::number_cast;
using sunder::whole_number;

TEST_CASE("whole numbers are cut, kept in their type, and 0 where there is no number", "[base]") {
  CHECK(whole_number<int>(2.9) == 2);
  CHECK(whole_number<int>(-2.9) == -2);
  CHECK(whole_number<int>(1e300) == INT32_MAX);
  CHECK(whole_number<int>(-1e300) == INT32_MIN);
  CHECK(whole_number<int>(std::nan("")) == 0);
  CHECK(whole_number<int>(300, 200) == 200);
  CHECK(whole_number<std::uint32_t>(-1) == 0);
  CHECK(whole_number<std::uint32_t>(4294967295.0) == UINT32_MAX);
  CHECK(whole_number<std::uint64_t>(HUGE_VAL) == UINT64_MAX);
  CHECK(whole_number<std::uint64_t>(18446744073709551615.0) == UINT64_MAX);
  CHECK(whole_number<std::uint64_t>(9007199254740992.0 * 1024) == 9007199254740992u * 1024);
  CHECK(whole_number<std::int64_t>(9223372036854775807.0) == INT64_MAX);
  CHECK(whole_number<std::int64_t>(-HUGE_VAL) == INT64_MIN);
}

TEST_CASE("numbers become other numbers as casts do, but where these are undefined", "[base]") {
  CHECK(number_cast<int>(1e300) == INT32_MAX);
  CHECK(number_cast<std::int8_t>(-129.5f) == -128);
  CHECK(number_cast<double>(3) == 3.0);
  CHECK(number_cast<std::uint8_t>(257) == 1);
  CHECK(number_cast<float>(0.5) == 0.5f);
}

// SPDX-License-Identifier: MIT
#include "topology/base/point_math.hpp"

#include <catch2/catch.hpp>

using sunder::Point;
namespace detail = sunder::detail;

TEST_CASE("cross products stand on both factors and turn right-handed", "[kernel][point_math]") {
  CHECK(detail::cross({1, 0, 0}, {0, 1, 0}) == Point{0, 0, 1});
  const Point a = {1, 2, -3}, b = {4, -5, 6};
  const Point c = detail::cross(a, b);
  CHECK(c == Point{-3, -18, -13});
  CHECK(detail::dot(a, c) == 0);
  CHECK(detail::dot(b, c) == 0);
  CHECK(detail::length({2, 3, 6}) == 7);
  CHECK(detail::difference(a, b) == Point{-3, 7, -9});
}

// SPDX-License-Identifier: MIT
#include "topology/base/point_math.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

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
  CHECK(detail::distance({1, 1, 1}, {3, 4, 7}) == 7);
  CHECK(detail::distance({5e-324, 0, 0}, {0, 0, 0}) > 0);
  CHECK(detail::distance({3e300, 0, 0}, {0, 4e300, 0}) == Approx(5e300));
  CHECK(detail::distance(a, a) == 0);
}

TEST_CASE("six volumes are the determinant, for whole numbers to the last one",
          "[kernel][point_math]") {
  // Every corner in general position, so that no product of the determinant is 0 or like another.
  const std::array<Point, 4> x = {{{2, 3, 5}, {9, 16, 22}, {19, 32, 48}, {43, 64, 10}}};
  const auto det = [](const Point& a, const Point& b, const Point& c) {
    double sum = 0;  // Leibniz
    const int orders[6][4] = {{0, 1, 2, 1},  {1, 2, 0, 1},  {2, 0, 1, 1},
                              {0, 2, 1, -1}, {2, 1, 0, -1}, {1, 0, 2, -1}};
    for (const auto& o : orders) sum += o[3] * a[o[0]] * b[o[1]] * c[o[2]];
    return sum;
  };
  std::array<int, 4> order = {0, 1, 2, 3};
  do {
    const Point &a = x[order[0]], &b = x[order[1]], &c = x[order[2]], &d = x[order[3]];
    const auto from_a = [&a](const Point& p) {
      return Point{p[0] - a[0], p[1] - a[1], p[2] - a[2]};
    };
    CHECK(detail::six_volumes(a, b, c, d) == det(from_a(b), from_a(c), from_a(d)));
  } while (std::next_permutation(order.begin(), order.end()));
  CHECK(detail::six_volumes({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
}

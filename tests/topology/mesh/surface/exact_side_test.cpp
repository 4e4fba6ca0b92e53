// SPDX-License-Identifier: MIT
// Signs of determinants against integers of any length, where doubles alone would lose them.
#include "topology/mesh/surface/exact_side.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace sunder;

namespace {

using Random = std::mt19937_64;
using Integer = boost::multiprecision::cpp_int;

template <std::size_t N>
using Vector = std::array<Integer, N>;

template <std::size_t N>
Vector<N> difference(const std::array<double, N>& a, const std::array<double, N>& b) {
  Vector<N> d;
  for (std::size_t k = 0; k < N; ++k) d[k] = Integer(a[k]) - Integer(b[k]);
  return d;
}

int sign_of(const Integer& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

int exact(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector<3> x = difference(b, a), y = difference(c, a), z = difference(d, a);
  return sign_of(x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
                 x[2] * (y[0] * z[1] - y[1] * z[0]));
}

int exact(const std::array<double, 2>& a, const std::array<double, 2>& b,
          const std::array<double, 2>& c) {
  const Vector<2> x = difference(b, a), y = difference(c, a);
  return sign_of(x[0] * y[1] - x[1] * y[0]);
}

/// A whole number of up to 53 bits, times a power of two.
double number(Random& random, int bits, int more) {
  const auto mantissa = static_cast<double>(random() >> (64 - bits));
  const double size =
      std::ldexp(mantissa, static_cast<int>(random() % static_cast<unsigned>(more + 1)));
  return random() % 2 == 0 ? size : -size;
}

/// Often moves a coordinate to a neighbouring number.
template <std::size_t N>
void shake(Random& random, std::array<double, N>& p) {
  double& x = p[random() % N];
  const int way = static_cast<int>(random() % 3) - 1;
  // Below 1 a number would no longer be whole.
  if (std::abs(x) >= 0x1p53)
    x = way == 0 ? x : std::nextafter(x, way * 0x1p1000);
  else
    x += way;
}

template <std::size_t N>
std::array<double, N> point(Random& random, int bits, int more) {
  std::array<double, N> p;
  for (double& x : p) x = number(random, bits, more);
  return p;
}

}  // namespace

TEST_CASE("the side of a plane is exact among points of all sizes", "[mesh][exact_side]") {
  Random random(20261125);
  std::array<int, 3> seen{};
  for (int round = 0; round < 6000; ++round) {
    std::array<Point, 4> p;
    if (round % 3 == 0) {
      for (Point& q : p) q = point<3>(random, 1 + static_cast<int>(random() % 53), 60);
      if (round % 2 == 0) p[3] = p[random() % 3];
    } else if (round % 4 == 1) {
      // About the origin, in one plane but for the rounding of all digits.
      p[1] = point<3>(random, 53, 0), p[2] = point<3>(random, 53, 0);
      const double i = std::ldexp(number(random, 20, 0), -20),
                   j = std::ldexp(number(random, 20, 0), -20);
      for (std::size_t k = 0; k < 3; ++k) {
        p[0][k] = -p[1][k];
        p[3][k] = std::nearbyint(p[0][k] + i * (p[1][k] - p[0][k]) + j * (p[2][k] - p[0][k]));
      }
    } else {
      // In the plane of the others, far from the origin; then a unit in the last place off it.
      p[0] = point<3>(random, 50, round % 3 == 1 ? 0 : 20);
      const Point u = point<3>(random, 20, 0), v = point<3>(random, 22, 0);
      const double i = number(random, 4, 0), j = number(random, 4, 0);
      for (std::size_t k = 0; k < 3; ++k) {
        p[1][k] = p[0][k] + u[k];
        p[2][k] = p[0][k] + v[k];
        p[3][k] = p[0][k] + i * u[k] + j * v[k];
      }
      for (std::size_t times = random() % 3; times > 0; --times) shake(random, p[random() % 4]);
    }
    INFO("round " << round);
    const int side = exact(p[0], p[1], p[2], p[3]);
    REQUIRE(side_of_plane(p[0], p[1], p[2], p[3]) == side);
    REQUIRE(side_of_plane(p[1], p[0], p[2], p[3]) == -side);
    REQUIRE(side_of_plane(p[3], p[1], p[2], p[0]) == -side);
    ++seen[static_cast<std::size_t>(side + 1)];
  }
  for (const int count : seen) CHECK(count > 500);
}

TEST_CASE("the side of a line is exact among points of all sizes", "[mesh][exact_side]") {
  Random random(7);
  std::array<int, 3> seen{};
  for (int round = 0; round < 6000; ++round) {
    using Flat = std::array<double, 2>;
    std::array<Flat, 3> p;
    if (round % 3 == 0) {
      for (Flat& q : p) q = point<2>(random, 1 + static_cast<int>(random() % 53), 60);
      if (round % 2 == 0) p[2] = p[random() % 2];
    } else if (round % 4 == 1) {
      p[1] = point<2>(random, 53, 0);
      const double i = std::ldexp(number(random, 20, 0), -20);
      for (std::size_t k = 0; k < 2; ++k) {
        p[0][k] = -p[1][k];
        p[2][k] = std::nearbyint(p[0][k] + i * (p[1][k] - p[0][k]));
      }
    } else {
      p[0] = point<2>(random, 50, round % 3 == 1 ? 0 : 20);
      const Flat u = point<2>(random, 30, 0);
      const double i = number(random, 6, 0);
      for (std::size_t k = 0; k < 2; ++k) {
        p[1][k] = p[0][k] + u[k];
        p[2][k] = p[0][k] + i * u[k];
      }
      for (std::size_t times = random() % 3; times > 0; --times) shake(random, p[random() % 3]);
    }
    INFO("round " << round);
    const int side = exact(p[0], p[1], p[2]);
    REQUIRE(side_of_line(p[0], p[1], p[2]) == side);
    REQUIRE(side_of_line(p[1], p[0], p[2]) == -side);
    ++seen[static_cast<std::size_t>(side + 1)];
  }
  for (const int count : seen) CHECK(count > 500);
}

// SPDX-License-Identifier: MIT
#include "topology/base/elementary.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace sunder;

namespace {

/// Distance of two doubles of like size in units of the last place of the second.
double in_last_places(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double unit = std::nextafter(std::abs(rounded), 1e300) - std::abs(rounded);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / unit;
}

}  // namespace

TEST_CASE("sine, cosine and cube root are right to about the last place", "[base][elementary]") {
  std::mt19937_64 random(19);
  const double reach = GENERATE(1e-9, 1e-3, 0.8, 7.0, 1000.0, 1.5e6);
  std::uniform_real_distribution<double> angle(-reach, reach);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = angle(random);
    worst = std::max(worst, in_last_places(sine(x), std::sin(static_cast<long double>(x))));
    worst = std::max(worst, in_last_places(cosine(x), std::cos(static_cast<long double>(x))));
    worst = std::max(worst, in_last_places(cube_root(x), std::cbrt(static_cast<long double>(x))));
  }
  INFO("angles up to " << reach);
  CHECK(worst <= (reach > 1000 ? 2 : 1.1));
}

TEST_CASE("exponentials and angles of directions are right to about the last place",
          "[base][elementary]") {
  std::mt19937_64 random(23);
  const double reach = GENERATE(1e-6, 0.1, 3.0, 690.0);
  std::uniform_real_distribution<double> any(-reach, reach);
  double worst_power = 0, worst_angle = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = any(random), y = any(random);
    worst_power = std::max(worst_power,
                           in_last_places(exponential(x), std::exp(static_cast<long double>(x))));
    worst_angle = std::max(worst_angle, in_last_places(direction_angle(y, x),
                                                       std::atan2(static_cast<long double>(y),
                                                                  static_cast<long double>(x))));
  }
  INFO("up to " << reach);
  CHECK(worst_power <= 2);
  CHECK(worst_angle <= 3);
}

TEST_CASE("logarithms are right to about the last place", "[base][elementary]") {
  std::mt19937_64 random(29);
  const double reach = GENERATE(1e-3, 0.3, 3.0, 700.0);
  std::uniform_real_distribution<double> any(-reach, reach);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = std::exp(any(random));
    worst = std::max(worst, in_last_places(logarithm(x), std::log(static_cast<long double>(x))));
  }
  INFO("up to e^" << reach);
  CHECK(worst <= 2);
}

TEST_CASE("directions along axes, and numbers beyond doubles", "[base][elementary]") {
  CHECK(direction_angle(0, 1) == 0);
  CHECK(direction_angle(1, 0) == Approx(M_PI / 2).epsilon(1e-16));
  CHECK(direction_angle(0, -1) == Approx(M_PI).epsilon(1e-16));
  CHECK(direction_angle(-1, 0) == Approx(-M_PI / 2).epsilon(1e-16));
  CHECK(direction_angle(1e300, 1e300) == Approx(M_PI / 4).epsilon(1e-16));
  CHECK(direction_angle(1e-300, 1e300) == 0);
  CHECK(direction_angle(0, 0) == 0);
  CHECK(logarithm(1) == 0);
  CHECK(logarithm(0) == -std::numeric_limits<double>::infinity());
  CHECK(std::isnan(logarithm(-1)));
  CHECK(std::isinf(logarithm(std::numeric_limits<double>::infinity())));
  CHECK(logarithm(5e-324) == Approx(-744.4400719213812).epsilon(1e-15));
  CHECK(exponential(0) == 1);
  CHECK(exponential(-800) == 0);
  CHECK(std::isinf(exponential(800)));
}

TEST_CASE("sine, cosine and cube root are these bits in every build", "[base][elementary]") {
  CHECK(sine(0.5) == 0x1.eaee8744b05fp-2);
  CHECK(cosine(0.5) == 0x1.c1528065b7d5p-1);
  CHECK(sine(1e5) == 0x1.24daa9c527e96p-5);
  CHECK(cube_root(2) == 0x1.428a2f98d728bp+0);
  CHECK(sine(0) == 0);
  CHECK(cosine(0) == 1);
  CHECK(cube_root(-8) == -2);
  CHECK(std::isnan(sine(std::numeric_limits<double>::infinity())));
}

// SPDX-License-Identifier: MIT
#include "mechanics/state/elementary.hpp"

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

TEST_CASE("sine, cosine and cube root are right to about the last place", "[mechanics][elementary]") {
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

TEST_CASE("sine, cosine and cube root are these bits in every build", "[mechanics][elementary]") {
  CHECK(sine(0.5) == 0x1.eaee8744b05fp-2);
  CHECK(cosine(0.5) == 0x1.c1528065b7d5p-1);
  CHECK(sine(1e5) == 0x1.24daa9c527e96p-5);
  CHECK(cube_root(2) == 0x1.428a2f98d728bp+0);
  CHECK(sine(0) == 0);
  CHECK(cosine(0) == 1);
  CHECK(cube_root(-8) == -2);
  CHECK(std::isnan(sine(std::numeric_limits<double>::infinity())));
}

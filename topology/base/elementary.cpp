// SPDX-License-Identifier: MIT
// Reduction by pi/2 in three parts, Taylor series below pi/4, Newton's method for the root.
#include "topology/base/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunder {
namespace {

/// pi/2 as a sum: the first two have 33 bits, so their products with a whole number below 2^20 are
/// exact.
constexpr double half_pi_1 = 1.57079632673412561417e+00;
constexpr double half_pi_2 = 6.07710050630396597660e-11;
constexpr double half_pi_3 = 2.02226624879595063154e-21;
constexpr double two_over_pi = 6.36619772367581382433e-01;
constexpr double two_pi = 6.28318530717958647693e+00;
constexpr double most_quarters = 1048576;  // 2^20
/// ln 2 as a sum: the first has 33 bits.
constexpr double ln2_1 = 6.93147180369123816490e-01, ln2_2 = 1.90821492927058770002e-10;

/// An angle as whole quarter turns and a rest of at most pi/4 = `rest` + `tail`.
struct ReducedAngle {
  int quarter;  ///< 0 to 3
  double rest, tail;
};

ReducedAngle reduced(double x) {
  if (std::abs(x) > most_quarters * half_pi_1) x = std::fmod(x, two_pi);  // exact in itself
  const double n = std::floor(x * two_over_pi + 0.5);
  const double w = x - n * half_pi_1;
  const double shift = n * half_pi_2;
  const double rest = w - shift;
  const double tail = ((w - rest) - shift) - n * half_pi_3;
  const int quarter = static_cast<int>(n - 4 * std::floor(n / 4));
  return {quarter, rest, tail};
}

/// sin(x + tail), |x| <= pi/4: the first term left out is below 1e-19.
double sine_series(double x, double tail) {
  const double z = x * x;
  const double v = z * x;
  const double r =
      1. / 120 + z * (-1. / 5040 +
                      z * (1. / 362880 + z * (-1. / 39916800 + z * (1. / 6227020800. +
                                                                    z * (-1. / 1307674368000.)))));
  return x - ((z * (0.5 * tail - v * r) - tail) + v / 6);
}

/// cos(x + tail), |x| <= pi/4.
double cosine_series(double x, double tail) {
  const double z = x * x;
  const double r =
      1. / 24 +
      z * (-1. / 720 +
           z * (1. / 40320 +
                z * (-1. / 3628800 + z * (1. / 479001600 +
                                          z * (-1. / 87178291200. + z * (1. / 20922789888000.))))));
  const double half = 0.5 * z;
  const double w = 1 - half;
  return w + (((1 - w) - half) + (z * z * r - x * tail));
}

double quarter_wave(const ReducedAngle& a, int quarter) {
  switch (quarter & 3) {
    case 0:
      return sine_series(a.rest, a.tail);
    case 1:
      return cosine_series(a.rest, a.tail);
    case 2:
      return -sine_series(a.rest, a.tail);
    default:
      return -cosine_series(a.rest, a.tail);
  }
}

}  // namespace

double sine(double angle) {
  if (!std::isfinite(angle)) return angle - angle;
  const ReducedAngle a = reduced(angle);
  return quarter_wave(a, a.quarter);
}

double cosine(double angle) {
  if (!std::isfinite(angle)) return angle - angle;
  const ReducedAngle a = reduced(angle);
  return quarter_wave(a, a.quarter + 1);
}

double logarithm(double x) {
  if (x == 0) return -std::numeric_limits<double>::infinity();
  if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(x)) return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // 0.5 to 1
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  // ln m = 2 artanh s; s is at most 0.172, and the first term left out below 1e-18.
  const double f = m - 1, s = f / (2 + f), z = s * s;
  double sum = 0;
  for (int k = 21; k > 1; k -= 2) sum = z * (1. / k + sum);
  // f - s f is 2 s: s alone is rounded, f is not.
  return exponent * ln2_1 + ((f - s * (f - 2 * sum)) + exponent * ln2_2);
}

double exponential(double x) {
  if (!(std::abs(x) <= 700)) {
    return x > 0 ? std::numeric_limits<double>::infinity() : x < 0 ? 0 : x;
  }
  const double n = std::floor(x / (ln2_1 + ln2_2) + 0.5);
  const double rest = (x - n * ln2_1) - n * ln2_2;  // at most 0.35
  double sum = 1;
  for (int k = 14; k > 0; --k) sum = 1 + rest * sum / k;
  return std::ldexp(sum, static_cast<int>(n));
}

double direction_angle(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double largest = std::max(std::abs(x), std::abs(y));
  if (largest == 0) return 0;
  const double a = std::abs(x) / largest, b = std::abs(y) / largest;
  const double length = std::sqrt(a * a + b * b);
  const double s = std::min(a, b) / length, c = std::max(a, b) / length;
  // Newton with the sine of the missing angle, below pi/4; three steps square it below all bits.
  double angle = s;
  for (int k = 0; k < 4; ++k) {
    const double missing = s * cosine(angle) - c * sine(angle);
    angle += missing * (1 + missing * missing / 6);
  }
  if (b > a) angle = (half_pi_1 - angle) + half_pi_2;
  if (x < 0) angle = 2 * (half_pi_1 + half_pi_2) - angle;
  return y < 0 ? -angle : angle;
}

double cube_root(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  int exponent = 0;
  double m = std::frexp(std::abs(x), &exponent);
  const int rest = ((exponent % 3) + 3) % 3;
  m = std::ldexp(m, rest);  // 0.5 to 4
  double y = 0.65 + 0.35 * m;
  for (int i = 0; i < 6; ++i) y -= (y * y * y - m) / (3 * y * y);
  y = std::ldexp(y, (exponent - rest) / 3);
  return x < 0 ? -y : y;
}

}  // namespace sunder

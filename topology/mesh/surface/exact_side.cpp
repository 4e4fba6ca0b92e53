// SPDX-License-Identifier: MIT
// Determinants as sums of doubles that do not overlap [Shewchuk 1997], where rounding leaves a
// doubt.
#include "topology/mesh/surface/exact_side.hpp"

#include <cmath>

namespace sunder {
namespace {

/// A number as the exact sum of its parts, the smallest first; no part is 0.
struct Sum {
  std::array<double, 200> part;
  int parts = 0;
};

void append(Sum& s, double x) {
  if (x != 0) s.part[static_cast<std::size_t>(s.parts++)] = x;
}

/// a + b = high + low.
struct Two {
  double high, low;
};
Two two_sum(double a, double b) {
  const double high = a + b, b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}
Two two_product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

void add(Sum& s, double x) {
  const int before = s.parts;
  s.parts = 0;  // in place: none is written that is still to be read
  for (int i = 0; i < before; ++i) {
    const Two t = two_sum(x, s.part[static_cast<std::size_t>(i)]);
    append(s, t.low);
    x = t.high;
  }
  append(s, x);
}

Sum difference_of(double a, double b) {
  Sum s;
  const Two t = two_sum(a, -b);
  append(s, t.low);
  append(s, t.high);
  return s;
}

Sum product_of(const Sum& a, const Sum& b, double sign = 1) {
  Sum s;
  for (int i = 0; i < a.parts; ++i) {
    for (int j = 0; j < b.parts; ++j) {
      const Two t = two_product(a.part[static_cast<std::size_t>(i)],
                                sign * b.part[static_cast<std::size_t>(j)]);
      if (t.low != 0) add(s, t.low);
      add(s, t.high);
    }
  }
  return s;
}

void add(Sum& s, const Sum& other) {
  for (int i = 0; i < other.parts; ++i) add(s, other.part[static_cast<std::size_t>(i)]);
}

int sign_of(double x) { return (x > 0) - (x < 0); }

/// The largest part decides.
int sign_of(const Sum& s) {
  return s.parts == 0 ? 0 : sign_of(s.part[static_cast<std::size_t>(s.parts - 1)]);
}

int exact_side(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<std::array<Sum, 3>, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    m[0][k] = difference_of(b[k], a[k]);
    m[1][k] = difference_of(c[k], a[k]);
    m[2][k] = difference_of(d[k], a[k]);
  }
  Sum det;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    Sum minor = product_of(m[1][i], m[2][j]);
    add(minor, product_of(m[1][j], m[2][i], -1));
    add(det, product_of(minor, m[0][k]));
  }
  return sign_of(det);
}

/// Half a unit in the last place of 1.
constexpr double rounding = 0x1p-53;

}  // namespace

int side_of_plane(const Point& a, const Point& b, const Point& c, const Point& d) {
  double det = 0, sizes = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double first = (c[i] - a[i]) * (d[j] - a[j]), second = (c[j] - a[j]) * (d[i] - a[i]);
    det += (b[k] - a[k]) * (first - second);
    sizes += std::abs(b[k] - a[k]) * (std::abs(first) + std::abs(second));
  }
  // Above the largest rounding error of differences, products and sums together.
  if (std::abs(det) > 10 * rounding * sizes) return sign_of(det);
  return exact_side(a, b, c, d);
}

int side_of_line(const std::array<double, 2>& a, const std::array<double, 2>& b,
                 const std::array<double, 2>& c) {
  const double first = (b[0] - a[0]) * (c[1] - a[1]), second = (b[1] - a[1]) * (c[0] - a[0]);
  const double det = first - second;
  if (std::abs(det) > 5 * rounding * (std::abs(first) + std::abs(second))) return sign_of(det);
  Sum sum = product_of(difference_of(b[0], a[0]), difference_of(c[1], a[1]));
  add(sum, product_of(difference_of(b[1], a[1]), difference_of(c[0], a[0]), -1));
  return sign_of(sum);
}

}  // namespace sunder

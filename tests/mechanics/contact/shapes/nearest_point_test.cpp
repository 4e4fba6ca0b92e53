// SPDX-License-Identifier: MIT
// Nearest points of tetrahedra against a search over a fine net of weights.
#include "mechanics/contact/shapes/nearest_point.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace sunder;

namespace {

Vec3 point_of(const std::array<Vec3, 4>& corners, const std::array<double, 4>& weights) {
  Vec3 point = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) point += weights[i] * corners[i];
  return point;
}

/// Least distance over all weights in steps of 1 / n.
double by_search(const std::array<Vec3, 4>& corners, const Vec3& x, int n) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      for (int k = 0; i + j + k <= n; ++k) {
        const std::array<double, 4> w = {double(i) / n, double(j) / n, double(k) / n,
                                         double(n - i - j - k) / n};
        least = std::min(least, (point_of(corners, w) - x).norm());
      }
    }
  }
  return least;
}

}  // namespace

TEST_CASE("the nearest point of a tetrahedron", "[mechanics][contact]") {
  const unsigned seed = 11;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in(-1, 1);
  const auto vector = [&] { return Vec3(in(random), in(random), in(random)); };
  const double flatness = GENERATE(1.0, 1e-3, 0.0);
  for (int k = 0; k < 60; ++k) {
    std::array<Vec3, 4> corners = {vector(), vector(), vector(), vector()};
    for (Vec3& c : corners) c.z() *= flatness;
    const Vec3 x = 1.5 * vector();
    const std::array<double, 4> weights = nearest_point(corners, x);
    double sum = 0;
    for (const double w : weights) {
      CHECK(w >= 0);
      CHECK(w <= 1);
      sum += w;
    }
    CHECK(std::abs(sum - 1) < 1e-12);
    const double found = (point_of(corners, weights) - x).norm();
    const double searched = by_search(corners, x, 24);
    CHECK(found <= searched + 1e-12);
    // The net's points are within a cell's diagonal of any point.
    CHECK(searched - found < 4 * 3.5 / 24);
  }
}

TEST_CASE("a point inside a tetrahedron is its own nearest point", "[mechanics][contact]") {
  const std::array<Vec3, 4> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)};
  const Vec3 x(0.2, 0.4, 0.6);
  const std::array<double, 4> weights = nearest_point(corners, x);
  CHECK((point_of(corners, weights) - x).norm() < 1e-15);
  CHECK(weights[0] == Approx(0.4));
  // And corners that coincide are one point.
  const std::array<Vec3, 4> one = {x, x, x, x};
  CHECK((point_of(one, nearest_point(one, Vec3::Zero())) - x).norm() < 1e-15);
}

TEST_CASE("a triangle's nearest point is that of the flat tetrahedron, in its plane too",
          "[mechanics][contact]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(-1, 1);
  const auto vector = [&] { return Vec3(in(random), in(random), in(random)); };
  for (int k = 0; k < 500; ++k) {
    const std::array<Vec3, 3> corners = {vector(), vector(), vector()};
    const double u = in(random), v = in(random);
    // Every other one in the triangle's plane, to rounding.
    const Vec3 x =
        k % 2 == 0
            ? vector()
            : Vec3(corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]));
    const std::array<double, 3> w = nearest_on_triangle(corners, x);
    const std::array<Vec3, 4> flat = {corners[0], corners[1], corners[2], corners[2]};
    const double found = (w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2] - x).norm();
    CHECK(found <= by_search(flat, x, 24) + 1e-12);
    CHECK(std::abs(found - (point_of(flat, nearest_point(flat, x)) - x).norm()) < 1e-9);
    if (k % 2 == 1 && u >= 0 && v >= 0 && u + v <= 1) CHECK(found < 1e-12);
  }
}

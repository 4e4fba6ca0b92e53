// SPDX-License-Identifier: MIT
// Shapes at the limits of numbers: needles, faces with vanishing areas, volumes without a number.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "topology/mesh/radius_ratio.hpp"
#include "topology/mesh/survey.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using suite::unit;

namespace {

using Corners = std::array<Point, 4>;

Quality shape_of(const std::vector<Point>& points,
                 const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
  TetMesh mesh;
  mesh.points = points;
  mesh.tetrahedra = tetrahedra;
  const std::optional<Quality> q = quality_of(survey_mesh(mesh, Severity::warning));
  REQUIRE(q);
  return *q;
}

Quality shape_of(const Corners& x) {
  return shape_of(std::vector(x.begin(), x.end()), {{0, 1, 2, 3}});
}

using Wide = std::array<long double, 3>;
Wide difference(const Point& a, const Point& b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}

/// From corner `from`: no digits are lost where another one is next to it.
double volume_of(const Corners& x, std::size_t from) {
  const Wide a = difference(x[(from + 1) % 4], x[from]), b = difference(x[(from + 2) % 4], x[from]),
             c = difference(x[(from + 3) % 4], x[from]);
  const long double six = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]);
  return static_cast<double>(std::abs(six) / 6);
}

double shortest_of(const Corners& x) {
  long double least = INFINITY;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Wide e = difference(x[i], x[j]);
      least = std::min(least, std::hypot(e[0], e[1], e[2]));
    }
  }
  return static_cast<double>(least);
}

}  // namespace

TEST_CASE("needles have their volume and their shortest edge", "[topology][quality]") {
  // One corner next to another, at a billionth of the length: cancellation in the formulas decides
  // how many digits are left. Here all are.
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 60; ++trial) {
    Corners x{};
    const auto random_point = [&](double size) {
      return Point{size * unit(random), size * unit(random), size * unit(random)};
    };
    for (std::size_t k = 1; k < 4; ++k) x[k] = random_point(1);
    const Point step = random_point(1e-9);
    const auto [moved, beside] = std::array<std::array<std::size_t, 2>, 3>{
        {{1, 3}, {1, 0}, {2, 0}}}[static_cast<std::size_t>(trial % 3)];
    for (std::size_t k = 0; k < 3; ++k) x[moved][k] = x[beside][k] + step[k];
    INFO("trial " << trial);
    const Quality q = shape_of(x);
    CHECK(q.shortest_edge.value == Approx(shortest_of(x)).epsilon(1e-13));
    if (moved == 1) CHECK(q.smallest_volume.value == Approx(volume_of(x, beside)).epsilon(1e-11));
  }
}

TEST_CASE("a regular tetrahedron has a ratio of 1 and no more, large and small, however it lies",
          "[topology][quality]") {
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 3000; ++trial) {
    // Alternate corners of a cube, turned by a quaternion.
    std::array<double, 4> q{};
    double square = 0;
    for (double& v : q) v = unit(random) - 0.5, square += v * v;
    const auto& [w, i, j, k] = q;
    const double size = std::ldexp(1.0, trial % 3 * 400 - 400) / square;
    const std::array<Point, 3> turn = {
        {{w * w + i * i - j * j - k * k, 2 * (i * j - w * k), 2 * (i * k + w * j)},
         {2 * (i * j + w * k), w * w - i * i + j * j - k * k, 2 * (j * k - w * i)},
         {2 * (i * k - w * j), 2 * (j * k + w * i), w * w - i * i - j * j + k * k}}};
    Corners x{};
    for (std::size_t c = 1; c < 4; ++c) {
      for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t e = 0; e < 3; ++e) x[c][d] += size * turn[d][e] * (e + 1 != c ? 1 : 0);
      }
    }
    const double ratio = radius_ratio(x);
    CHECK(ratio == Approx(1).epsilon(1e-13));
    CHECK(ratio <= 1);
  }
}

TEST_CASE("the shape does not depend on the side to which a tetrahedron reaches, tiny or huge",
          "[topology][quality]") {
  for (const double size : {1e-120, 1e120}) {
    for (int side = 0; side < 8; ++side) {
      Corners x = {{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
      for (Point& p : x) {
        for (std::size_t k = 0; k < 3; ++k) p[k] *= (side >> k & 1) != 0 ? -size : size;
      }
      CHECK(radius_ratio(x) == Approx(1));
      CHECK(shape_of(x).smallest_dihedral.value == Approx(70.5287793655));
    }
  }
}

TEST_CASE("faces whose areas are too small for a number have no angles", "[topology][quality]") {
  // Corners 1 and 2 are so near each other that two faces have none; the angle left is between the
  // other two, which lie on each other.
  const Quality q = shape_of({{{0, 0, 0}, {1, 0, 0}, {1, 1e-170, 0}, {0, 0.5, 1}}});
  CHECK(q.smallest_dihedral.value == Approx(0).margin(1e-6));
  CHECK(q.largest_dihedral.value == Approx(0).margin(1e-6));
}

TEST_CASE("extremes are told of the first tetrahedron that is measured, also where all are 0",
          "[topology][quality]") {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const Quality flat = shape_of(points, {{0, 0, 1, 2}, {0, 1, 2, 3}});
  CHECK(flat.largest_volume.value == 0);
  CHECK(flat.largest_volume.tetrahedron == 1);
  CHECK(flat.smallest_volume.tetrahedron == 1);
  // Of points in one place.
  const Quality point = shape_of(std::vector<Point>(4), {{0, 0, 1, 2}, {0, 1, 2, 3}});
  CHECK(point.longest_edge.value == 0);
  CHECK(point.longest_edge.tetrahedron == 1);
  const Quality huge = shape_of({{{0, 0, 0}, {1e150, 0, 0}, {0, 1e150, 0}, {0, 0, 1e150}}});
  CHECK(std::isinf(huge.smallest_volume.value));
  CHECK(huge.smallest_volume.tetrahedron == 0);
  CHECK(huge.longest_edge.value == Approx(std::sqrt(2.0) * 1e150));
}

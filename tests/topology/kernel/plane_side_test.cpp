// SPDX-License-Identifier: MIT
// The sign rule by itself: tolerance, independence of place and size, canonical directions.
#include "topology/kernel/plane_side.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using suite::unit;

namespace {

Point random_point(std::mt19937_64& random) {
  return {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

TEST_CASE("a centre is on the plane within a millionth of its tetrahedron's radius",
          "[topology][plane_side]") {
  const std::uint64_t seed = 41;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<Point, 4> corners;
    Point centre = {0, 0, 0};
    for (Point& x : corners) {
      x = random_point(random);
      for (std::size_t i = 0; i < 3; ++i) centre[i] += x[i] / 4;
    }
    double radius = 0;
    for (const Point& x : corners) {
      radius = std::max(radius, std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]));
    }
    const Point normal = random_point(random);
    const double length = std::sqrt(dot(normal, normal));
    // A point of the plane at some way along it, so that the centre lies `off` radii above.
    const auto side = [&](double off) {
      const Point along = random_point(random);
      const double slide = dot(along, normal) / dot(normal, normal);
      Point at;
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = centre[i] - off * radius * normal[i] / length + along[i] - slide * normal[i];
      }
      return plane_side(normal, centre_offset(corners, at));
    };
    CHECK(side(1.01e-6) == PlaneSide::positive);
    CHECK(side(0.99e-6) == PlaneSide::on);
    CHECK(side(-0.99e-6) == PlaneSide::on);
    CHECK(side(-1.01e-6) == PlaneSide::negative);
  }
}

TEST_CASE("a user's plane is the same whatever the length and the sign of its normal",
          "[topology][plane_side]") {
  const PlaneThrough plane = *read_plane({{1, -2, 2}, 3});
  CHECK(plane.normal == Point{-0.5, 1, -1});
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(plane.at[i] == Approx(std::array{1.0, -2.0, 2.0}[i] / 3));
  }
  for (const double factor : {-1.0, 1e200, -1e-200}) {
    const PlaneThrough other = *read_plane({{factor, -2 * factor, 2 * factor}, 3 * factor});
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(other.normal[i] == Approx(plane.normal[i]));
      CHECK(other.at[i] == Approx(plane.at[i]));
    }
  }
  // The largest number looks to the other side than one that equals it to a millionth.
  const PlaneThrough tilted = *read_plane({{-2 + 1e-6, 2, 0}, 3});
  CHECK(tilted.normal == Point{(2 - 1e-6) / 2, -1, 0});
  CHECK(dot(tilted.at, {-2 + 1e-6, 2, 0}) == Approx(3).epsilon(1e-14));
  CHECK_FALSE(read_plane({{0, 0, 0}, 1}));
  CHECK_FALSE(read_plane({{1, 0, 0}, std::nan("")}));
}

TEST_CASE("the canonical direction does not depend on sign or length", "[topology][plane_side]") {
  CHECK(*read_direction({0, -4, 2}) == Point{0, 1, -0.5});
  CHECK(*read_direction({0, 4, -2}) == Point{0, 1, -0.5});
  CHECK(canonical_direction({-3, 3, 0}) == Point{3, -3, 0});  // lowest axis on a tie
  CHECK_FALSE(read_direction({0, 0, 0}));
  CHECK_FALSE(read_direction({1, std::nan(""), 0}));
  CHECK_FALSE(read_direction({1, 0, std::numeric_limits<double>::infinity()}));
  // Ties hold to a millionth, so that the rounding of a solver does not decide.
  CHECK(canonical_direction({-1, 1 + 9e-7, 0})[0] > 0);
  CHECK(canonical_direction({-1, 1 + 2e-6, 0})[1] > 0);
  // Seen from another octant.
  CHECK(canonical_direction({-3, 2, 0}, {-1, 1, 1}) == Point{-3, 2, 0});
}

TEST_CASE("what lies at a limit itself counts as equal", "[topology][plane_side]") {
  const double nearly = 1 - equal_directions;
  CHECK(canonical_direction({-nearly, 1, 0}) == Point{nearly, -1, 0});
  for (const double x : {-0.5, 0.5}) {
    CHECK(plane_side({1, 0, 0}, {.away = {x, 0, 0}, .tolerance = 0.5}) == PlaneSide::on);
  }
  CHECK(CentreOffset{}.tolerance == 0);
  CHECK(CuttingPlane{}.offset == 0);
}

TEST_CASE("far from the origin rounding is added to a millionth of the radius",
          "[topology][plane_side]") {
  const std::array<Point, 4> corners = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}};
  const double radius = std::sqrt(11.0), far = 0x1p40;  // of the centre at 1 1 1
  const auto moved = [&](double by) {
    std::array<Point, 4> there = corners;
    for (Point& x : there) x[1] -= by;
    return there;
  };
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  CHECK(centre_offset(corners, {0, 0, 0}).tolerance == Approx(1e-6 * radius).epsilon(1e-8));
  // The corners are far, or the point of the plane is.
  for (const double tolerance : {centre_offset(moved(far), {0, 0, 0}).tolerance,
                                 centre_offset(corners, {0, 0, far}).tolerance}) {
    CHECK(tolerance == Approx(1e-6 * radius + rounding * far).epsilon(1e-3));
  }
  const CentreOffset beside = centre_offset(moved(far), {0, -far, 0});
  CHECK(beside.away == Point{1, 1, 1});
}

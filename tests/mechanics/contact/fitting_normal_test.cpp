// SPDX-License-Identifier: MIT
// Normals that two surfaces allow, compared with all directions of a sphere.
#include "mechanics/contact/detection/fitting_normal.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

double lowest(const Vec3& normal, const std::vector<Vec3>& ways) {
  double least = 1;
  for (const Vec3& way : ways) least = std::min(least, normal.dot(way));
  return least;
}

/// The largest cosine with a normal of any direction that all ways allow; below -1: there is none.
double best_of_sphere(const Vec3& normal, const std::vector<Vec3>& ways, double against) {
  double best = -2;
  constexpr int count = 4000;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2.0 * k + 1) / count, turn = k * pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Vec3 n(r * std::cos(turn), r * std::sin(turn), z);
    if (lowest(n, ways) >= -against) best = std::max(best, n.dot(normal));
  }
  return best;
}

}  // namespace

TEST_CASE("a normal that fits stays, and another one turns no more than it must",
          "[mechanics][contact]") {
  std::mt19937 random(7);
  int turned = 0, kept = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 normal = random_vector(random).normalized();
    std::vector<Vec3> ways;
    // Most of them lie above a plane that is tilted against the normal.
    const Vec3 up = (normal + 0.5 * random_vector(random)).normalized();
    for (std::size_t k = 0; k < 1 + random() % 5; ++k) {
      Vec3 way = random_vector(random).normalized();
      if (way.dot(up) < 0) way = -way;
      ways.push_back(way);
    }
    const std::optional<Vec3> fitting = fitting_normal(normal, ways);
    if (lowest(normal, ways) >= -0.05) {
      ++kept;
      REQUIRE(fitting.has_value());
      CHECK(*fitting == normal);
      continue;
    }
    if (!fitting) continue;
    ++turned;
    CHECK(std::abs(fitting->norm() - 1) < 1e-12);
    CHECK(lowest(*fitting, ways) >= -0.05);
    // No direction with these ways in front is much nearer to the normal.
    CHECK(fitting->dot(normal) > best_of_sphere(normal, ways, 0) - 0.25);
  }
  CHECK(turned > 300);
  CHECK(kept > 200);
}

TEST_CASE("ridges that cross give the normal across both", "[mechanics][contact]") {
  std::mt19937 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 a = random_vector(random).normalized(), b = random_vector(random).normalized();
    const Vec3 across = a.cross(b);
    if (across.norm() < 0.1) continue;
    const Vec3 normal = (across.normalized() + 0.7 * a - 0.4 * b).normalized();
    const std::optional<Vec3> fitting =
        fitting_normal(normal, std::array{a, Vec3(-a), b, Vec3(-b)});
    REQUIRE(fitting.has_value());
    CHECK((*fitting - across.normalized()).norm() < 0.2);
  }
}

TEST_CASE("ways all around allow no normal", "[mechanics][contact]") {
  const std::array<Vec3, 4> ways = {Vec3(1, 1, 1).normalized(), Vec3(1, -1, -1).normalized(),
                                    Vec3(-1, 1, -1).normalized(), Vec3(-1, -1, 1).normalized()};
  CHECK_FALSE(fitting_normal(Vec3::UnitZ(), ways).has_value());
}

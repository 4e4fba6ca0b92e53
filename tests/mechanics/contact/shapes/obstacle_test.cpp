// SPDX-License-Identifier: MIT
// Distances to planes, spheres and boxes, swept touches, and mistakes of users.
#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/contact/settings/contact_fields.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace sunder;

namespace {

std::vector<Shape> shapes() {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
  return {Plane{Vec3(1, -2, 2) / 3, 0.3}, Sphere{{0.2, -0.1, 0.4}, 0.6},
          Box{{-0.3, 0.2, 0.1}, turned, {0.4, 0.5, 0.2}}};
}

Vec3 random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> place(-size, size);
  return {place(random), place(random), place(random)};
}

}  // namespace

TEST_CASE("the normal is the gradient of the gap and of unit length",
          "[mechanics][contact][obstacle]") {
  std::mt19937 random(5);
  const Shape shape = shapes()[GENERATE(0u, 1u, 2u)];
  int compared = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 point = random_point(random, 1.5);
    const SurfaceDistance here = surface_distance(shape, point);
    CHECK(here.normal.norm() == Approx(1).margin(1e-14));
    constexpr double step = 1e-6;
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 shift = step * Vec3::Unit(axis);
      gradient[axis] = (surface_distance(shape, point + shift).gap -
                        surface_distance(shape, point - shift).gap) /
                       (2 * step);
    }
    // Kinks of the distance (edges inside a box) have no gradient: few random points are there.
    if ((gradient - here.normal).norm() < 1e-5) ++compared;
  }
  CHECK(compared >= 198);
}

TEST_CASE("a fast point does not pass a thin box unseen", "[mechanics][contact][obstacle]") {
  const Box wall{Vec3::Zero(), Eigen::Quaterniond::Identity(), {1e-3, 1, 1}};
  const FirstTouch touch = first_touch(wall, {{-5, 0.1, 0.2}, {7, 0.3, -0.1}, 0});
  CHECK((touch.normal - Vec3(-1, 0, 0)).norm() < 1e-12);
  CHECK(touch.gap_start == Approx(5 - 1e-3));
  // The tangent plane is the wall's near face, where sphere tracing stops: a millionth of the path.
  CHECK(touch.gap_end == Approx(-7 - 1e-3).margin(1e-5));
}

TEST_CASE("sphere tracing meets a ball where the quadratic equation does",
          "[mechanics][contact][obstacle]") {
  std::mt19937 random(8);
  const Sphere ball{{0.2, -0.1, 0.4}, 0.6};
  int hits = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 start = random_point(random, 3), end = random_point(random, 3);
    const double radius = 0.1;
    const Vec3 d = end - start, o = start - ball.center;
    const double reach = ball.radius + radius;
    if (o.norm() < reach) continue;
    const double b = o.dot(d) / d.squaredNorm();
    const double under = b * b - (o.squaredNorm() - reach * reach) / d.squaredNorm();
    const FirstTouch touch = first_touch(ball, {start, end, radius});
    if (under < 1e-3 || -b - std::sqrt(under) < 0 || -b - std::sqrt(under) > 1) continue;
    const double t = -b - std::sqrt(under);
    const Vec3 normal = (o + t * d).normalized();
    // The path's millionth, seen along a curved surface at a glancing angle.
    CHECK((touch.normal - normal).norm() < 1e-3);
    CHECK(touch.gap_end == Approx(normal.dot(d) * (1 - t)).margin(1e-2));
    ++hits;
  }
  CHECK(hits > 20);
}

TEST_CASE("a point that starts inside keeps the normal of its start",
          "[mechanics][contact][obstacle]") {
  const Sphere ball{Vec3::Zero(), 1};
  const FirstTouch touch = first_touch(ball, {{0, 0, 0.9}, {0, 0.5, 0.9}, 0});
  CHECK(touch.normal == Vec3::UnitZ());
  CHECK(touch.gap_start == Approx(-0.1));
  CHECK(touch.gap_end == Approx(-0.1));
}

TEST_CASE("distances at places without a gradient are finite", "[mechanics][contact][obstacle]") {
  CHECK(surface_distance(Sphere{{1, 2, 3}, 0.5}, {1, 2, 3}).normal.allFinite());
  CHECK(surface_distance(Box{}, Vec3::Zero()).normal.norm() == Approx(1));
  CHECK(surface_distance(Box{}, {0.5, 0.5, 0.5}).normal.norm() == Approx(1));
}

TEST_CASE("what is wrong with an obstacle is said with its place and a remedy",
          "[mechanics][contact][obstacle]") {
  CHECK(check_settings(Obstacle{Plane{}}, "o").empty());
  Obstacle ball{Sphere{}};
  ball.mass = 2;
  ball.spin = Vec3::UnitX();
  CHECK(check_settings(ball, "o").empty());

  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    Obstacle obstacle;
    std::string code, place;
  };
  std::vector<Case> cases = {
      {Obstacle{Plane{Vec3::Zero(), 0}}, "zero_direction", "plane.normal"},
      {Obstacle{Plane{{0, 0, 2}, 0}}, "not_a_unit_vector", "plane.normal"},
      {Obstacle{Plane{Vec3::UnitZ(), nan}}, "out_of_range", "plane.offset"},
      {Obstacle{Sphere{Vec3::Zero(), -1}}, "out_of_range", "sphere.radius"},
      {Obstacle{Sphere{{0, nan, 0}, 1}}, "out_of_range", "sphere.center.1"},
      {Obstacle{Box{Vec3::Zero(), Eigen::Quaterniond(0, 0, 0, 0), {1, 1, 1}}}, "not_a_rotation",
       "box.rotation"},
      {Obstacle{Box{Vec3::Zero(), Eigen::Quaterniond::Identity(), {1, 0, 1}}}, "out_of_range",
       "box.half_extent.1"},
  };
  Obstacle wrong{Plane{}};
  wrong.mass = 1;
  cases.push_back({wrong, "mass_without_volume", "mass"});
  wrong = Obstacle{Sphere{}};
  wrong.mass = -1;
  cases.push_back({wrong, "out_of_range", "mass"});
  wrong = Obstacle{Sphere{}};
  wrong.friction = -0.1;
  cases.push_back({wrong, "out_of_range", "friction"});
  wrong = Obstacle{Sphere{}};
  wrong.spin = Vec3::UnitZ();
  cases.push_back({wrong, "spin_without_mass", "spin"});
  for (const Case& c : cases) {
    const std::vector<SettingFinding> findings = setting_findings(c.obstacle, "obstacles.3");
    INFO(c.code);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].finding.code == c.code);
    CHECK(findings[0].place == "obstacles.3." + c.place);
    CHECK(findings[0].finding.text.find(findings[0].place) == 0);
    CHECK_FALSE(findings[0].finding.remedy.empty());
  }
}

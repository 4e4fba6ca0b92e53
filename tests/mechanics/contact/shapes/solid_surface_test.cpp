// SPDX-License-Identifier: MIT
// Closed surfaces: measures, signed distances against boxes and winding, and refusals.
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "mechanics/contact/shapes/solid_surface_check.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"

using namespace sunder;

namespace {

/// A box of 12 triangles from `low` to `high`.
TriangleSurface box_of(const Vec3& low, const Vec3& high) {
  TriangleSurface s;
  for (int k = 0; k < 8; ++k) {
    s.points.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                          k & 4 ? high.z() : low.z());
  }
  for (const auto& f : {std::array<std::uint32_t, 4>{0, 4, 6, 2},
                        {1, 3, 7, 5},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 2, 3, 1},
                        {4, 5, 7, 6}}) {
    s.triangles.push_back({f[0], f[1], f[2]});
    s.triangles.push_back({f[0], f[2], f[3]});
  }
  return s;
}

/// Both, as one surface.
TriangleSurface together(TriangleSurface a, const TriangleSurface& b) {
  const auto first = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (auto t : b.triangles) {
    for (std::uint32_t& p : t) p += first;
    a.triangles.push_back(t);
  }
  return a;
}

TriangleSurface turned(TriangleSurface s) {
  for (auto& t : s.triangles) std::swap(t[1], t[2]);
  return s;
}

/// A lens of `rings` circles with a dent: no corner of it is like another.
TriangleSurface dented(std::uint32_t around, std::uint32_t rings) {
  TriangleSurface s;
  s.points.emplace_back(0, 0, -0.3);
  for (std::uint32_t r = 1; r < rings; ++r) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = 2 * M_PI * k / around, b = M_PI * r / rings - M_PI / 2;
      const double radius = 1 + 0.3 * std::sin(3 * a) * std::cos(b);
      s.points.emplace_back(radius * std::cos(a) * std::cos(b), radius * std::sin(a) * std::cos(b),
                            0.7 * std::sin(b));
    }
  }
  s.points.emplace_back(0, 0, 0.2);
  const auto at = [&](std::uint32_t r, std::uint32_t k) {
    return 1 + (r - 1) * around + k % around;
  };
  const auto top = static_cast<std::uint32_t>(s.points.size() - 1);
  for (std::uint32_t k = 0; k < around; ++k) {
    s.triangles.push_back({0, at(1, k + 1), at(1, k)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      s.triangles.push_back({at(r, k), at(r, k + 1), at(r + 1, k + 1)});
      s.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r + 1, k)});
    }
    s.triangles.push_back({top, at(rings - 1, k), at(rings - 1, k + 1)});
  }
  return s;
}

/// Full turns of the surface around a point: 1 inside, 0 outside.
double winding(const SolidSurface& s, const Vec3& x) {
  double sum = 0;
  for (const auto& t : s.triangles) {
    const Vec3 a = s.points[t[0]] - x, b = s.points[t[1]] - x, c = s.points[t[2]] - x;
    sum += 2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                 b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return sum / (4 * M_PI);
}

std::string code_of(const TriangleSurface& s) {
  const Result<SolidSurface> made = make_solid_surface(s);
  if (made) return "";
  REQUIRE_FALSE(made.findings.empty());
  CHECK_FALSE(made.findings[0].text.empty());
  CHECK_FALSE(made.findings[0].remedy.empty());
  return made.findings[0].code;
}

Vec3 random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> place(-size, size);
  return {place(random), place(random), place(random)};
}

}  // namespace

TEST_CASE("a box by its surface has the box's measures and distances", "[contact][solid]") {
  const Vec3 low(-0.2, 0.1, 0.3), high(0.5, 0.4, 0.9);
  const bool inside_out = GENERATE(false, true);
  const TriangleSurface s = box_of(low, high);
  const Result<SolidSurface> made = make_solid_surface(inside_out ? turned(s) : s);
  REQUIRE(made);
  const Vec3 half = 0.5 * (high - low);
  CHECK(made.value->volume == Approx(8 * half.prod()));
  CHECK((made.value->centre - 0.5 * (low + high)).norm() < 1e-14);
  CHECK(made.value->radius == Approx(half.norm()));
  const Vec3 square = half.cwiseAbs2();
  CHECK(made.value->inertia(0, 0) == Approx(made.value->volume / 3 * (square.y() + square.z())));
  CHECK(made.value->inertia(2, 2) == Approx(made.value->volume / 3 * (square.x() + square.y())));
  CHECK(std::abs(made.value->inertia(0, 1)) < 1e-14);
  const Shape box = Box{0.5 * (low + high), Eigen::Quaterniond::Identity(), half};
  std::mt19937 random(3);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 x = random_point(random, 1.2);
    const SurfaceDistance wanted = surface_distance(box, x);
    const SurfacePoint here = distance_to_surface(*made.value, x);
    CHECK(here.gap == Approx(wanted.gap).margin(1e-14));
    CHECK((here.normal - wanted.normal).norm() < 1e-9);
  }
}

TEST_CASE("the sign of the distance is that of the winding, everywhere", "[contact][solid]") {
  const Result<SolidSurface> made = make_solid_surface(dented(24, 12));
  REQUIRE(made);
  std::mt19937 random(11);
  for (int k = 0; k < 3000; ++k) {
    // Near corners and edges too.
    Vec3 x = random_point(random, 1.4);
    if (k % 3 == 1)
      x = made.value->points[static_cast<std::size_t>(k) % made.value->points.size()] + 1e-3 * x;
    const SurfacePoint here = distance_to_surface(*made.value, x);
    CHECK((here.gap < 0) == (winding(*made.value, x) > 0.5));
    CHECK(here.normal.norm() == Approx(1));
    double nearest = 1e9;
    for (const Vec3& p : made.value->points) nearest = std::min(nearest, (p - x).norm());
    CHECK(std::abs(here.gap) <= nearest * (1 + 1e-12));
  }
}

TEST_CASE("a solid may have a hole, and parts that stand apart", "[contact][solid]") {
  const TriangleSurface outer = box_of(Vec3::Constant(-1), Vec3::Constant(1));
  const TriangleSurface inner = box_of(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  const Result<SolidSurface> hollow = make_solid_surface(together(outer, turned(inner)));
  REQUIRE(hollow);
  CHECK(hollow.value->volume == Approx(7));
  CHECK(distance_to_surface(*hollow.value, Vec3::Zero()).gap == Approx(0.5));
  CHECK(distance_to_surface(*hollow.value, Vec3(0.7, 0, 0)).gap == Approx(-0.2));
  CHECK(code_of(together(outer, inner)) == "wrong_orientation");
  const TriangleSurface beside = box_of(Vec3(2, 0, 0), Vec3(2.5, 1, 1));
  CHECK(code_of(together(outer, beside)) == "");
  CHECK(code_of(together(outer, turned(beside))) == "wrong_orientation");
}

TEST_CASE("surfaces that bound no solid are refused, with what to do", "[contact][solid]") {
  const TriangleSurface box = box_of(Vec3::Zero(), Vec3::Ones());
  CHECK(code_of(box) == "");
  CHECK(code_of({}) == "empty_surface");
  TriangleSurface s = box;
  s.triangles.pop_back();
  CHECK(code_of(s) == "open_surface");
  s = box;
  std::swap(s.triangles[3][0], s.triangles[3][1]);
  CHECK(code_of(s) == "wrong_orientation");
  s = box;
  s.points[2].y() = std::nan("");
  CHECK(code_of(s) == "nan_coordinate");
  s = box;
  s.triangles[0][0] = 99;
  CHECK(code_of(s) == "index_out_of_range");
  s = box;
  s.points[0] = s.points[1];
  CHECK(code_of(s) == "flat_triangle");
  s = box;
  s.triangles.push_back(s.triangles[0]);
  CHECK(code_of(s) == "non_manifold_surface");
  CHECK(code_of(together(box, box_of(Vec3::Constant(0.5), Vec3::Constant(1.5)))) ==
        "self_intersection");
  s = box;
  s.triangles.resize(most_obstacle_triangles + 1, s.triangles[0]);
  CHECK(code_of(s) == "too_many_triangles");
  // Two boxes that share one corner.
  s = together(box, box_of(Vec3::Ones(), Vec3::Constant(2)));
  for (auto& t : s.triangles) {
    for (std::uint32_t& p : t) p = p == 8 ? 7 : p;
  }
  CHECK(code_of(s) == "non_manifold_surface");
  CHECK(check_triangles(box).empty());
}

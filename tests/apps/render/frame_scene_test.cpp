// SPDX-License-Identifier: MIT
// Faults of a scene are named; colors and tints behave.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "apps/render/color.hpp"
#include "apps/render/frame_scene.hpp"

using namespace sunder;
using namespace sunder::render;

namespace {

FrameScene one_triangle() {
  FrameScene scene;
  scene.surfaces.push_back(
      {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
  return scene;
}

std::string only_code(const FrameScene& scene) {
  const auto findings = check(scene);
  return findings.size() == 1 ? findings[0].code : "";
}

}  // namespace

TEST_CASE("a sound scene has no findings", "[render][scene]") {
  FrameScene scene = one_triangle();
  scene.planes.emplace_back();
  scene.spheres.emplace_back();
  scene.boxes.emplace_back();
  CHECK(check(scene).empty());
  CHECK(check(FrameScene{}).empty());
}

TEST_CASE("every defect of a scene has its finding", "[render][scene]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  FrameScene scene = one_triangle();
  scene.surfaces[0].triangles.push_back({0, 1, 3});
  CHECK(only_code(scene) == "index_out_of_range");
  CHECK(check(scene)[0].ids == std::vector<std::int64_t>{1});

  scene = one_triangle();
  scene.surfaces[0].piece = {1, 2};
  CHECK(only_code(scene) == "length_mismatch");

  scene = one_triangle();
  scene.surfaces[0].positions[1].x() = nan;
  CHECK(only_code(scene) == "not_finite");
  CHECK_FALSE(has_error(check(scene)));

  scene = one_triangle();
  scene.spheres.push_back({.radius = 0});
  CHECK(only_code(scene) == "degenerate_shape");

  scene = one_triangle();
  scene.boxes.push_back({.half_extent = {1, -1, 1}});
  CHECK(only_code(scene) == "degenerate_shape");

  scene = one_triangle();
  scene.planes.push_back({.normal = {0, 0, 0}});
  CHECK(only_code(scene) == "degenerate_shape");

  scene = one_triangle();
  scene.light.to_key = {nan, 0, 1};
  CHECK(only_code(scene) == "degenerate_shape");

  scene = one_triangle();
  scene.extent = Bounds(Eigen::Vector3f::Zero(), Eigen::Vector3f(1, INFINITY, 1));
  CHECK(only_code(scene) == "degenerate_shape");
}

TEST_CASE("bounds hold surfaces, spheres and turned boxes, and nothing infinite",
          "[render][scene]") {
  CHECK(scene_bounds({}).isEmpty());
  FrameScene scene = one_triangle();
  scene.surfaces[0].positions.push_back({9, 9, 9});  // used by no triangle
  CHECK(scene_bounds(scene).max() == Eigen::Vector3f(1, 1, 0));
  scene.spheres.push_back({.center = {0, 0, 2}, .radius = 0.5f});
  CHECK(scene_bounds(scene).max() == Eigen::Vector3f(1, 1, 2.5f));
  const Eigen::Quaternionf eighth(Eigen::AngleAxisf(std::atan(1.0f), Eigen::Vector3f::UnitZ()));
  scene.boxes.push_back({.half_extent = {1, 1, 0.1f}, .rotation = eighth});
  CHECK(scene_bounds(scene).max().x() == Approx(std::sqrt(2.0f)));
  scene.surfaces[0].positions[0].x() = std::numeric_limits<float>::infinity();
  CHECK(scene_bounds(scene).max().x() == Approx(std::sqrt(2.0f)));
}

TEST_CASE("colors survive the way to linear light and back", "[render][color]") {
  for (int i = 0; i <= 255; ++i) {
    const float v = static_cast<float>(i) / 255;
    const Color back = to_srgb(to_linear({v, 1 - v, 0.5f}));
    CHECK(back.r == Approx(v).margin(1e-5));  // far below the 1/255 step of a byte
    CHECK(back.g == Approx(1 - v).margin(1e-5));
  }
  CHECK(to_linear({0.5f, 0, 1}).r == Approx(0.2140f).epsilon(1e-3));  // IEC 61966-2-1
}

TEST_CASE("a tint of nothing is the color itself, and pieces that follow each other differ",
          "[render][color]") {
  const Color base = SurfaceColors{}.skin;
  for (std::uint32_t piece = 0; piece < 64; ++piece) CHECK(tinted(base, piece, 0) == base);
  for (std::uint32_t piece = 0; piece < 64; ++piece) {
    for (std::uint32_t next = piece + 1; next < piece + 5; ++next) {
      const Color a = tinted(base, piece, 0.5f), b = tinted(base, next, 0.5f);
      const float apart = std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
      CHECK(apart > 0.05f);  // 12 steps of a byte: seen at a glance
    }
  }
}

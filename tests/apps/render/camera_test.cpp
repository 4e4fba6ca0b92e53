// SPDX-License-Identifier: MIT
// A camera placed by itself shows the whole box, centered; a camera that sees nothing is named.
#include "apps/render/camera.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace sunder;
using namespace sunder::render;

namespace {

/// Where the corners of a box fall on the picture; every corner lies in front of the eye.
Eigen::AlignedBox2f extent_on_picture(const Bounds& box, const Camera& camera, float aspect) {
  const Eigen::Matrix4f m = view_projection(camera, aspect, 1e-3f, 1e4f);
  Eigen::AlignedBox2f extent;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector4f p = m * box.corner(static_cast<Bounds::CornerType>(i)).homogeneous();
    REQUIRE(p.w() > 0);
    extent.extend(Eigen::Vector2f(p.head<2>() / p.w()));
  }
  return extent;
}

}  // namespace

TEST_CASE("a framed box lies inside the margin, centered, and touches it", "[render][camera]") {
  const unsigned seed = 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3f corner = Eigen::Vector3f(unit(random), unit(random), unit(random)) * 4;
    const Eigen::Vector3f size =
        Eigen::Vector3f(unit(random), unit(random), unit(random)).array() * 3 + 0.02f;
    const Bounds box(corner, corner + size);
    const Framing framing{.aspect = 0.5f + 2 * unit(random),
                          .azimuth = 6.28f * unit(random),
                          .elevation = 2.8f * unit(random) - 1.4f};
    const Eigen::AlignedBox2f seen =
        extent_on_picture(box, frame_bounds(box, framing), framing.aspect);
    const float half_pixel = 1.0f / 720;  // on a picture of 720 lines
    CHECK(seen.min().minCoeff() >= framing.margin - 1 - half_pixel);
    CHECK(seen.max().maxCoeff() <= 1 - framing.margin + half_pixel);
    CHECK(seen.sizes().maxCoeff() >= 2 * (1 - framing.margin) - 2 * half_pixel);
    CHECK(seen.center().cwiseAbs().maxCoeff() <= half_pixel);
  }
}

TEST_CASE("framing by default looks from the front right, from above, upright",
          "[render][camera]") {
  const Camera camera = frame_bounds({Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones()});
  const CameraAxes axes = camera_axes(camera);
  CHECK(axes.forward.y() > 0);
  CHECK(axes.forward.x() < 0);
  CHECK(axes.forward.z() < 0);
  CHECK(axes.up.z() > 0);
  CHECK(axes.right.z() == Approx(0).margin(1e-6));  // rounding of one normalization
  CHECK(axes.right.cross(axes.forward).dot(axes.up) == Approx(1));
}

TEST_CASE("framing an empty box, an infinite one or a point still gives a camera",
          "[render][camera]") {
  const float infinity = std::numeric_limits<float>::infinity();
  const Eigen::Vector3f far = {1e3f, 0, 0};
  for (const Bounds& box :
       {Bounds(), Bounds(Eigen::Vector3f::Constant(-infinity), Eigen::Vector3f::Ones()),
        Bounds(far, far)}) {
    CHECK(check(frame_bounds(box)).empty());
  }
}

TEST_CASE("a camera may look straight down", "[render][camera]") {
  const Camera camera{.eye = {0, 0, 5}};
  CHECK(check(camera).empty());
  const CameraAxes axes = camera_axes(camera);
  CHECK(axes.right.norm() == Approx(1));
  CHECK(axes.up.norm() == Approx(1));
}

TEST_CASE("a camera that gives no picture is a finding", "[render][camera]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Camera bad[] = {{.eye = {0, 0, 0}},
                        {.eye = {nan, 0, 1}},
                        {.up = {0, 0, 0}},
                        {.vertical_fov = 0},
                        {.vertical_fov = 4}};
  for (const Camera& camera : bad) {
    const auto findings = check(camera);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == "degenerate_camera");
  }
}

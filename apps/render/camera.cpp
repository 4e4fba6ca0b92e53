// SPDX-License-Identifier: MIT
// Places a camera so that a box fits, and turns it into a matrix.
#include "apps/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sunder::render {
namespace {

/// An axis that makes an angle of at least 54 degrees with `v`.
Eigen::Vector3f away_from(const Eigen::Vector3f& v) {
  Eigen::Index smallest = 0;
  v.cwiseAbs().minCoeff(&smallest);
  return Eigen::Vector3f::Unit(smallest);
}

Bounds usable(const Bounds& bounds) {
  if (bounds.isEmpty() || !bounds.min().allFinite() || !bounds.max().allFinite()) {
    return {Eigen::Vector3f::Constant(-0.5f), Eigen::Vector3f::Constant(0.5f)};
  }
  if (bounds.diagonal().norm() > 0) return bounds;
  const float r = std::max(1e-3f * bounds.center().norm(), 1e-6f);  // a point: any size will do
  return {bounds.min().array() - r, bounds.max().array() + r};
}

/// Extent of the box's corners on the picture, in units of half its width and height.
Eigen::AlignedBox2f project(const Bounds& box, const Camera& camera, float aspect) {
  const CameraAxes axes = camera_axes(camera);
  const float tangent = std::tan(camera.vertical_fov / 2);
  Eigen::AlignedBox2f extent;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f p = box.corner(static_cast<Bounds::CornerType>(i)) - camera.eye;
    const float depth = std::max(p.dot(axes.forward), 1e-6f);
    extent.extend(
        Eigen::Vector2f(p.dot(axes.right) / (tangent * aspect), p.dot(axes.up) / tangent) / depth);
  }
  return extent;
}

}  // namespace

CameraAxes camera_axes(const Camera& camera) {
  const Eigen::Vector3f forward = (camera.target - camera.eye).normalized();
  Eigen::Vector3f right = forward.cross(camera.up.normalized());
  if (right.norm() < 1e-4f) right = forward.cross(away_from(forward));  // looking straight down
  right.normalize();
  return {right, right.cross(forward), forward};
}

Camera frame_bounds(const Bounds& bounds, const Framing& framing) {
  const Bounds box = usable(bounds);
  const float aspect = std::clamp(framing.aspect, 1e-2f, 1e2f);
  const Eigen::Vector3f up = framing.up.normalized();
  Eigen::Vector3f right = Eigen::Vector3f::UnitY().cross(up);
  right = right.norm() < 1e-4f ? Eigen::Vector3f(up.cross(away_from(up)).normalized())
                               : Eigen::Vector3f(right.normalized());
  const Eigen::Vector3f front = right.cross(up);  // -y when up is z
  const Eigen::Vector3f level =
      std::cos(framing.azimuth) * front + std::sin(framing.azimuth) * right;
  const Eigen::Vector3f to_eye =
      std::cos(framing.elevation) * level + std::sin(framing.elevation) * up;

  const float radius = box.diagonal().norm() / 2;
  const float tangent = std::tan(framing.vertical_fov / 2);
  const float room = std::clamp(1 - framing.margin, 0.05f, 1.0f);
  Camera camera{.target = box.center(), .up = up, .vertical_fov = framing.vertical_fov};
  float distance = radius / (std::min(1.0f, aspect) * tangent) + radius;
  // Each round centers the picture of the box and scales the distance to it; perspective makes
  // that inexact, and four rounds leave less than a pixel.
  for (int round = 0; round < 6; ++round) {
    camera.eye = camera.target + distance * to_eye;
    const CameraAxes axes = camera_axes(camera);
    const Eigen::AlignedBox2f extent = project(box, camera, aspect);
    const Eigen::Vector2f middle = extent.center() * distance * tangent;
    camera.target += middle.x() * aspect * axes.right + middle.y() * axes.up;
    distance = std::max(distance * extent.sizes().maxCoeff() / (2 * room), 1.05f * radius);
  }
  camera.eye = camera.target + distance * to_eye;
  return camera;
}

std::vector<Finding> check(const Camera& camera) {
  const bool finite = camera.eye.allFinite() && camera.target.allFinite() &&
                      camera.up.allFinite() && std::isfinite(camera.vertical_fov);
  if (finite && (camera.target - camera.eye).norm() > 0 && camera.up.norm() > 0 &&
      camera.vertical_fov > 0 && camera.vertical_fov < std::numbers::pi_v<float>) {
    return {};
  }
  return {{.code = "degenerate_camera",
           .text = "the camera's eye, target, up or angle gives no picture",
           .remedy = "give finite numbers, an eye away from the target, an up that is not 0 and "
                     "an angle between 0 and pi"}};
}

Eigen::Matrix4f view_projection(const Camera& camera, float aspect, float near, float far) {
  const CameraAxes axes = camera_axes(camera);
  Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  view.block<1, 3>(0, 0) = axes.right.transpose();
  view.block<1, 3>(1, 0) = axes.up.transpose();
  view.block<1, 3>(2, 0) = -axes.forward.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * camera.eye;
  const float tangent = std::tan(camera.vertical_fov / 2);
  Eigen::Matrix4f projection = Eigen::Matrix4f::Zero();
  projection(0, 0) = 1 / (tangent * aspect);
  projection(1, 1) = 1 / tangent;
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2 * far * near / (far - near);
  projection(3, 2) = -1;
  return projection * view;
}

}  // namespace sunder::render

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

/// One axis of the picture: where the eye stands across the view, and how far back.
struct Fit {
  float across = 0;
  float back = 0;
};

/// The nearest eye from which points at `across` (row 0) and `depth` (row 1) keep to slopes of at
/// most `slope`. Each point bounds back * slope from both sides: |p - eye| <= slope (depth + back).
Fit fit_axis(const Eigen::Matrix<float, 2, 8>& points, float slope) {
  const float high = (points.row(0) - slope * points.row(1)).maxCoeff();
  const float low = (-points.row(0) - slope * points.row(1)).maxCoeff();
  return {(high - low) / 2, (high + low) / (2 * slope)};
}

/// The same, but from `back`, which is at least that of `fit_axis`: the slope at which the points
/// just fit from there is found by halving, and they touch it on both sides, centered.
float center_axis(const Eigen::Matrix<float, 2, 8>& points, float slope, float back) {
  float low = 0, high = slope;
  for (int halving = 0; halving < 40; ++halving) {
    const float middle = (low + high) / 2;
    (fit_axis(points, middle).back > back ? low : high) = middle;
  }
  return fit_axis(points, high).across;
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

  Camera camera{.eye = box.center() + to_eye,
                .target = box.center(),
                .up = up,
                .vertical_fov = framing.vertical_fov};
  const CameraAxes axes = camera_axes(camera);
  Eigen::Matrix<float, 2, 8> sideways, upright;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f p = box.corner(static_cast<Bounds::CornerType>(i)) - box.center();
    sideways.col(i) << p.dot(axes.right), p.dot(axes.forward);
    upright.col(i) << p.dot(axes.up), p.dot(axes.forward);
  }
  const float slope =
      std::tan(framing.vertical_fov / 2) * std::clamp(1 - framing.margin, 0.05f, 1.0f);
  const float least = 1e-3f * box.diagonal().norm() - sideways.row(1).minCoeff();
  const float back =
      std::max({fit_axis(sideways, slope * aspect).back, fit_axis(upright, slope).back, least});
  camera.target += center_axis(sideways, slope * aspect, back) * axes.right +
                   center_axis(upright, slope, back) * axes.up;
  camera.eye = camera.target + back * to_eye;
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

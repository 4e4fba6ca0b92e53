// SPDX-License-Identifier: MIT
// Fits the depth range, the shadow map and the grid to a scene.
#include "apps/render/frame_view.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sunder::render {
namespace {

float round_spacing(float wished) {
  const float power = std::pow(10.0f, std::floor(std::log10(wished)));
  const float digit = wished / power;
  return power * (digit < 1.5f ? 1.0f : digit < 3.5f ? 2.0f : digit < 7.5f ? 5.0f : 10.0f);
}

void place_light(FrameView& view, const Bounds& casters, const Lighting& light) {
  const bool any = !casters.isEmpty();
  view.to_light = light.to_key.normalized();
  std::tie(view.light_u, view.light_v) = axes_across(view.to_light);
  view.light_center = any ? Eigen::Vector3f(casters.center()) : view.center;
  view.light_radius = any ? std::max(0.51f * casters.diagonal().norm(), 1e-6f) : view.radius;
  Eigen::Matrix3f turn;
  turn << view.light_u.transpose(), view.light_v.transpose(), -view.to_light.transpose();
  view.world_to_light = Eigen::Matrix4f::Identity();
  view.world_to_light.topLeftCorner<3, 3>() = turn / view.light_radius;
  view.world_to_light.topRightCorner<3, 1>() = -turn * view.light_center / view.light_radius;
}

}  // namespace

std::pair<Eigen::Vector3f, Eigen::Vector3f> axes_across(const Eigen::Vector3f& n) {
  Eigen::Index largest = 0;
  n.cwiseAbs().maxCoeff(&largest);
  const Eigen::Vector3f axis = Eigen::Vector3f::Unit((largest + 1) % 3);
  const Eigen::Vector3f u = (axis - n * n.dot(axis)).normalized();
  return {u, n.cross(u)};
}

FrameView frame_view(const FrameScene& scene, const Bounds& casters, const Camera& camera,
                     float aspect) {
  FrameView view;
  const Bounds bounds = scene.extent.isEmpty() ? scene_bounds(scene) : scene.extent;
  const float reach = (camera.target - camera.eye).norm();
  view.center = bounds.isEmpty() ? camera.target : Eigen::Vector3f(bounds.center());
  // A scene of one point still needs a size: a part of the distance it is seen from.
  view.radius =
      bounds.isEmpty() ? reach / 4 : std::max(bounds.diagonal().norm() / 2, 1e-4f * reach);
  const float distance = (view.center - camera.eye).norm();
  view.near = 0.02f * std::max(std::min(distance, reach), view.radius);
  view.far = distance + 30 * view.radius;
  const CameraAxes axes = camera_axes(camera);
  const float tangent = std::tan(camera.vertical_fov / 2);
  view.eye = camera.eye;
  view.forward = axes.forward;
  view.ray_right = tangent * aspect * axes.right;
  view.ray_up = tangent * axes.up;
  view.world_to_clip = view_projection(camera, aspect, view.near, view.far);
  view.grid_spacing = round_spacing(view.radius / 4);
  place_light(view, casters, scene.light);
  return view;
}

}  // namespace sunder::render

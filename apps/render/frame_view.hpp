// SPDX-License-Identifier: MIT
// Internal: the lengths and matrices of one frame that follow from its scene and camera.
#pragma once

#include <Eigen/Dense>
#include <utility>

#include "apps/render/camera.hpp"
#include "apps/render/frame_scene.hpp"

namespace sunder::render {

/// Where things are, m: the camera's view and the key light's.
struct FrameView {
  /// Center and radius of the scene's extent.
  Eigen::Vector3f center;
  float radius = 1;
  /// Distances from the eye between which things are drawn.
  float near = 0, far = 1;
  Eigen::Vector3f eye, forward;
  /// `eye + depth * (forward + x * ray_right + y * ray_up)` is at (x, y) in [-1, 1] on the picture.
  Eigen::Vector3f ray_right, ray_up;
  Eigen::Matrix4f world_to_clip;
  /// Axes, center and radius of the ball that holds all shadow casters.
  Eigen::Vector3f to_light, light_u, light_v, light_center;
  float light_radius = 1;
  Eigen::Matrix4f world_to_light;
  /// Side of a small square of the grid: 1, 2 or 5 times a power of ten.
  float grid_spacing = 1;
};

/// `casters`: bounds of all shadow casters, may be empty. Needs: scene and camera without error.
FrameView frame_view(const FrameScene& scene, const Bounds& casters, const Camera& camera,
                     float aspect);

/// Two unit vectors across the unit vector `n`, with (first, second, n) right-handed. For a floor
/// they are the world's x and y, so that its grid follows the axes.
std::pair<Eigen::Vector3f, Eigen::Vector3f> axes_across(const Eigen::Vector3f& n);

}  // namespace sunder::render

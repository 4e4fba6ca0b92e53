// SPDX-License-Identifier: MIT
// The camera of a picture, and how one is placed so that a box fits. No OpenGL here.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "apps/render/frame_scene.hpp"
#include "topology/base/finding.hpp"

namespace sunder::render {

/// A perspective camera.
struct Camera {
  /// m.
  Eigen::Vector3f eye = {3, -4, 2};
  Eigen::Vector3f target = Eigen::Vector3f::Zero();
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  /// Angle from the lower to the upper edge of the picture, rad, in (0, pi).
  float vertical_fov = 0.48f;
};

/// From where a box is looked at.
struct Framing {
  /// Width of the picture over its height.
  float aspect = 16.0f / 9.0f;
  /// Turn about `up`, rad, counterclockwise from the side of -y.
  float azimuth = 0.60f;
  /// Height above the horizon, rad, in (-pi/2, pi/2).
  float elevation = 0.36f;
  float vertical_fov = 0.48f;
  /// Part of the picture's half width and height left free on every side.
  float margin = 0.10f;
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
};

/// A camera from which the whole of `bounds` is seen, centered, touching the margin on two sides.
/// An empty or infinite box is taken as the unit cube about the origin, a point as a small one.
Camera frame_bounds(const Bounds& bounds, const Framing& framing = {});

/// The axes of a camera in the world, orthonormal.
struct CameraAxes {
  Eigen::Vector3f right, up, forward;
};

/// Needs: `check(camera)` without error. An `up` along the view is replaced by another axis.
CameraAxes camera_axes(const Camera& camera);

/// Errors: `degenerate_camera` when a number is not finite, the eye is the target, `up` is 0 or
/// the angle lies outside (0, pi).
std::vector<Finding> check(const Camera& camera);

/// World to clip space (OpenGL's: depth -1 at `near`, 1 at `far`), both distances in m.
Eigen::Matrix4f view_projection(const Camera& camera, float aspect, float near, float far);

}  // namespace sunder::render

// SPDX-License-Identifier: MIT
// Where points and paths meet obstacles, and how obstacles move.
#pragma once

#include "mechanics/contact/shapes/obstacle.hpp"

namespace sunder {

/// The place of a point against a shape.
struct SurfaceDistance {
  /// Distance to the surface, m; negative inside.
  double gap = 0;
  /// Unit vector out of the shape: the gradient of the gap.
  Vec3 normal{0, 0, 1};
};

/// Signed distance of `point` (m) to a shape and its gradient. Inside a box the nearest face
/// counts; where the gradient is not unique (the middle of a sphere, ties) a fixed axis is taken.
SurfaceDistance surface_distance(const Shape& shape, const Vec3& point);

/// A point that moves straight from `start` to `end` (m) beside a shape at rest.
struct Path {
  Vec3 start{0, 0, 0};
  Vec3 end{0, 0, 0};
  /// Radius of a ball around the point, m; 0 for a bare point.
  double radius = 0;
};

/// The tangent plane that a moving point meets, if it meets the shape at all.
struct FirstTouch {
  /// Unit normal, out of the shape, where the point touches first, or where it is nearest.
  Vec3 normal{0, 0, 1};
  /// Signed distance at the start, m.
  double gap_start = 0;
  /// Signed distance of the end to the tangent plane at that place, m: negative if it passed it.
  double gap_end = 0;
  /// Where on the path that is: 0 at its start, 1 at its end.
  double part = 0;
};

/// Where a moving point first touches a shape. Sphere tracing: the signed distance never grows
/// faster than the path is long, so a fast point cannot pass a thin obstacle unseen. A path that
/// begins inside keeps the normal of its start. At most 48 evaluations of the distance.
FirstTouch first_touch(const Shape& shape, const Path& path);

/// Velocity of an obstacle's material at `point` of its surface, m/s.
Vec3 surface_velocity(const Obstacle& obstacle, const Vec3& point);

/// Moves an obstacle by `displacement` (m); planes shift along their normal.
void translate(Shape& shape, const Vec3& displacement);

/// Moment of inertia of a free sphere about its centre, 2/5 m r^2, kg m^2.
/// Needs: a sphere with a mass.
double moment_of_inertia(const Obstacle& free_sphere);

}  // namespace sunder

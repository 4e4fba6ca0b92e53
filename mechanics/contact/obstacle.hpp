// SPDX-License-Identifier: MIT
// Obstacles, which do not break: planes, spheres and boxes. No contact is solved here.
#pragma once

#include <optional>
#include <variant>

#include "mechanics/state/vec3.hpp"

#include <Eigen/Geometry>

namespace sunder {

/// The half-space `normal . x <= offset` is solid.
struct Plane {
  /// Unit vector out of the solid.
  Vec3 normal{0, 0, 1};
  /// Distance of the plane from the origin along the normal, m.
  double offset = 0;
};

/// A solid ball.
struct Sphere {
  Vec3 center{0, 0, 0};
  /// m, > 0.
  double radius = 1;
};

/// A solid box with its own axes.
struct Box {
  Vec3 center{0, 0, 0};
  /// Turns the box's own axes into the world's.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// Half the length of each side along the box's own axes, m, > 0.
  Vec3 half_extent{0.5, 0.5, 0.5};
};

using Shape = std::variant<Plane, Sphere, Box>;

/// A shape with its motion. Without a mass it is driven: it keeps its velocity whatever it hits.
/// With a mass it must be a sphere: a projectile that falls, is pushed back and hits other
/// obstacles.
struct Obstacle {
  Shape shape = Plane{};
  /// m/s; zero for a static obstacle.
  Vec3 velocity{0, 0, 0};
  /// Angular velocity, rad/s; used by free spheres only.
  Vec3 spin{0, 0, 0};
  /// Coulomb's coefficient, >= 0. Two surfaces in contact have the mean of theirs.
  double friction = 0.5;
  /// kg, > 0, of a free sphere; none for a driven obstacle.
  std::optional<double> mass = {};
};

/// Where a point is relative to a shape.
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

// SPDX-License-Identifier: MIT
// Signed distances of planes, spheres and boxes, and sphere tracing.
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

SurfaceDistance distance_to(const Plane& plane, const Vec3& point) {
  return {plane.normal.dot(point) - plane.offset, plane.normal};
}

SurfaceDistance distance_to(const Sphere& sphere, const Vec3& point) {
  const Vec3 arm = point - sphere.center;
  const double length = arm.norm();
  const Vec3 normal = length > 0 ? Vec3{arm / length} : Vec3::UnitZ();
  return {length - sphere.radius, normal};
}

SurfaceDistance distance_to(const Box& box, const Vec3& point) {
  const Vec3 local = box.orientation.conjugate() * (point - box.center);
  const Vec3 beyond = local.cwiseAbs() - box.half_extent;
  Eigen::Index axis = 0;
  const double deepest = beyond.maxCoeff(&axis);
  Vec3 normal = Vec3::Zero();
  double gap = deepest;
  if (deepest <= 0) {
    normal[axis] = std::copysign(1.0, local[axis]);
  } else {
    const Vec3 out = beyond.cwiseMax(0.0);
    gap = out.norm();
    for (Eigen::Index k = 0; k < 3; ++k) normal[k] = std::copysign(out[k] / gap, local[k]);
  }
  return {gap, box.orientation * normal};
}

FirstTouch touch_plane(const Plane& plane, const Path& path) {
  const double start = plane.normal.dot(path.start) - plane.offset - path.radius;
  const double end = plane.normal.dot(path.end) - plane.offset - path.radius;
  const double part = start <= 0 ? 0 : end >= start ? 0 : std::min(1.0, start / (start - end));
  return {plane.normal, start, end, part};
}

}  // namespace

SurfaceDistance surface_distance(const Shape& shape, const Vec3& point) {
  return std::visit([&](const auto& s) { return distance_to(s, point); }, shape);
}

FirstTouch first_touch(const Shape& shape, const Path& path) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return touch_plane(*plane, path);
  const Vec3 motion = path.end - path.start;
  const double length = motion.norm();
  SurfaceDistance here = surface_distance(shape, path.start);
  here.gap -= path.radius;
  const double gap_start = here.gap;
  SurfaceDistance nearest = here;
  double nearest_travelled = 0;
  // A millionth of the path is far below what one step can mean for the result.
  const double arrived = 1e-6 * length;
  constexpr int max_evaluations = 48;
  double travelled = 0;
  for (int k = 1; k < max_evaluations && here.gap > arrived && travelled < length; ++k) {
    travelled = std::min(length, travelled + here.gap);
    const Vec3 point = path.start + motion * (travelled / length);
    here = surface_distance(shape, point);
    here.gap -= path.radius;
    if (here.gap < nearest.gap) {
      nearest = here;
      nearest_travelled = travelled;
    }
  }
  const double part = length > 0 ? nearest_travelled / length : 0;
  return {nearest.normal, gap_start, nearest.gap + nearest.normal.dot(motion) * (1 - part), part};
}

Vec3 surface_velocity(const Obstacle& obstacle, const Vec3& point) {
  if (!obstacle.mass) return obstacle.velocity;
  return obstacle.velocity + obstacle.spin.cross(point - std::get<Sphere>(obstacle.shape).center);
}

void translate(Shape& shape, const Vec3& displacement) {
  if (auto* plane = std::get_if<Plane>(&shape)) {
    plane->offset += plane->normal.dot(displacement);
  } else if (auto* sphere = std::get_if<Sphere>(&shape)) {
    sphere->center += displacement;
  } else if (auto* box = std::get_if<Box>(&shape)) {
    box->center += displacement;
  }
}

double moment_of_inertia(const Obstacle& free_sphere) {
  SUNDER_ASSERT(free_sphere.mass.has_value(), "only a free sphere has a moment of inertia");
  const double radius = std::get<Sphere>(free_sphere.shape).radius;
  return 0.4 * *free_sphere.mass * radius * radius;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Signed distances of obstacles, sphere tracing, and free obstacles as rigid bodies.
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mechanics/contact/shapes/solid_surface.hpp"
#include "mechanics/state/dense_solve.hpp"
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

SurfaceDistance distance_to(const Solid& solid, const Vec3& point) {
  const Vec3 own = solid.orientation.conjugate() * (point - solid.translation);
  const SurfacePoint at = distance_to_surface(*solid.surface, own);
  return {at.gap, solid.orientation * at.normal};
}

// Every shape has an overload of each of these; `std::visit` does not compile without one. Those of
// planes stand for calls that callers must not make.

void move_by(Plane& plane, const Vec3& displacement) {
  plane.offset += plane.normal.dot(displacement);
}
void move_by(Sphere& sphere, const Vec3& displacement) { sphere.center += displacement; }
void move_by(Box& box, const Vec3& displacement) { box.center += displacement; }
void move_by(Solid& solid, const Vec3& displacement) { solid.translation += displacement; }

double own_volume(const Plane&) {
  SUNDER_ASSERT(false, "a plane has no volume");
  return 0;
}
double own_volume(const Sphere& sphere) {
  return 4 * M_PI / 3 * (sphere.radius * sphere.radius * sphere.radius);
}
double own_volume(const Box& box) { return 8 * box.half_extent.prod(); }
double own_volume(const Solid& solid) { return solid.surface->volume; }

Pose own_pose(const Plane&) {
  SUNDER_ASSERT(false, "a plane has no mass centre");
  return {};
}
Pose own_pose(const Sphere& sphere) { return {.centre = sphere.center}; }
Pose own_pose(const Box& box) { return {box.center, box.orientation}; }
Pose own_pose(const Solid& solid) {
  return {solid.translation + solid.orientation * solid.surface->centre, solid.orientation};
}

void put_at(Plane&, const Pose&) {}
void put_at(Sphere& sphere, const Pose& pose) { sphere.center = pose.centre; }
void put_at(Box& box, const Pose& pose) {
  box.center = pose.centre;
  box.orientation = pose.orientation;
}
void put_at(Solid& solid, const Pose& pose) {
  solid.orientation = pose.orientation;
  solid.translation = pose.centre - pose.orientation * solid.surface->centre;
}

double own_radius(const Plane&) {
  SUNDER_ASSERT(false, "a plane has no radius");
  return 0;
}
double own_radius(const Sphere& sphere) { return sphere.radius; }
double own_radius(const Box& box) { return box.half_extent.norm(); }
double own_radius(const Solid& solid) { return solid.surface->radius; }

Mat3 inertia_of(const Plane&, double) {
  SUNDER_ASSERT(false, "a plane has no inertia");
  return Mat3::Zero();
}
Mat3 inertia_of(const Sphere& sphere, double mass) {
  return 0.4 * mass * sphere.radius * sphere.radius * Mat3::Identity();
}
Mat3 inertia_of(const Box& box, double mass) {
  const Vec3 square = box.half_extent.cwiseAbs2();
  const Vec3 sums(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
  return Mat3((mass / 3 * sums).asDiagonal());
}
Mat3 inertia_of(const Solid& solid, double mass) {
  return mass / solid.surface->volume * solid.surface->inertia;
}

/// Whether a path is farther from the ball around a solid than twice its length. Then the path can
/// meet no part of the solid.
std::optional<FirstTouch> pass_by(const Solid& solid, const Path& path) {
  const Vec3 arm = path.start - (solid.orientation * solid.surface->centre + solid.translation);
  const double length = (path.end - path.start).norm();
  const double gap = arm.norm() - solid.surface->radius - path.radius;
  if (!(gap > 2 * length)) return std::nullopt;
  return FirstTouch{arm.normalized(), gap, gap - length, 0};
}

/// A face of a shape: its unit normal out of the shape and a place on it, m.
struct FacePlane {
  Vec3 normal, place;
};

std::vector<FacePlane> planes_near(const Box& box, const Vec3& point, double distance) {
  std::vector<FacePlane> planes;
  const Vec3 local = box.orientation.conjugate() * (point - box.center);
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(local[k]) < box.half_extent[k] - distance) continue;
    const Vec3 normal = box.orientation * Vec3(std::copysign(1.0, local[k]) * Vec3::Unit(k));
    planes.push_back({normal, box.center + box.half_extent[k] * normal});
  }
  return planes;
}

/// None where the surface is not convex.
std::vector<FacePlane> planes_near(const Solid& solid, const Vec3& point, double distance) {
  const SolidSurface& surface = *solid.surface;
  const Vec3 own = solid.orientation.conjugate() * (point - solid.translation);
  const std::vector<std::uint32_t> near = triangles_near(surface, own, distance);
  std::vector<FacePlane> planes;
  constexpr double same = 1e-6;
  for (const std::uint32_t t : near) {
    const Vec3 normal = surface.face_normal[t], place = surface.points[surface.triangles[t][0]];
    for (const std::uint32_t other : near) {
      for (const std::uint32_t corner : surface.triangles[other]) {
        if (normal.dot(surface.points[corner] - place) > same * surface.radius) return {};
      }
    }
    const bool is_known = std::ranges::any_of(planes, [&](const FacePlane& plane) {
      return (solid.orientation.conjugate() * plane.normal - normal).norm() < same;
    });
    if (is_known) continue;
    planes.push_back({solid.orientation * normal, solid.orientation * place + solid.translation});
  }
  return planes;
}

std::vector<FacePlane> planes_near(const Shape& shape, const Vec3& point, double distance) {
  if (const auto* box = std::get_if<Box>(&shape)) return planes_near(*box, point, distance);
  if (const auto* solid = std::get_if<Solid>(&shape)) return planes_near(*solid, point, distance);
  return {};
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
  if (const auto* solid = std::get_if<Solid>(&shape)) {
    if (const std::optional<FirstTouch> far = pass_by(*solid, path)) return *far;
  }
  const Vec3 motion = path.end - path.start;
  const double length = motion.norm();
  SurfaceDistance here = surface_distance(shape, path.start);
  here.gap -= path.radius;
  const double gap_start = here.gap;
  SurfaceDistance nearest = here;
  double nearest_travelled = 0;
  // A millionth of the path is far below any effect on the result of a step.
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

bool grazes(const Shape& shape, const Path& path, const FirstTouch& touch, double rim) {
  if (!(touch.gap_start > 0 && touch.gap_end < 0) || std::holds_alternative<Plane>(shape)) {
    return false;
  }
  constexpr int places = 16;
  for (int k = 1; k <= places; ++k) {
    // From the end, where it is deepest unless it only cuts a corner.
    const double part = touch.part + (1 - touch.part) * (places + 1 - k) / places;
    const Vec3 point = path.start + part * (path.end - path.start);
    if (surface_distance(shape, point).gap - path.radius < -rim) return false;
  }
  return true;
}

void choose_face(FirstTouch& touch, const Shape& shape, const Path& path, const Vec3& place,
                 double rim) {
  const std::vector<FacePlane> planes = planes_near(shape, place, rim + path.radius);
  if (planes.size() < 2) return;
  const Vec3 motion = path.end - path.start;
  const double rounding = 1e-12 * (path.end.norm() + radius_of(shape));
  bool any = false;
  for (const FacePlane& plane : planes) {
    const double from = plane.normal.dot(path.start - plane.place) - path.radius;
    const double to = from + plane.normal.dot(motion);
    if (!(to < -rounding) || (any && to <= touch.gap_end)) continue;
    any = true;
    touch = {plane.normal, from, to, 0};
  }
}

Vec3 surface_velocity(const Obstacle& obstacle, const Vec3& point) {
  if (!obstacle.mass) return obstacle.velocity;
  return obstacle.velocity + obstacle.spin.cross(point - pose_of(obstacle.shape).centre);
}

void translate(Shape& shape, const Vec3& displacement) {
  std::visit([&](auto& s) { move_by(s, displacement); }, shape);
}

bool has_volume(const Shape& shape) {
  const auto* solid = std::get_if<Solid>(&shape);
  return !std::holds_alternative<Plane>(shape) && (!solid || solid->surface);
}

double volume_of(const Shape& shape) {
  return std::visit([](const auto& s) { return own_volume(s); }, shape);
}

Pose pose_of(const Shape& shape) {
  return std::visit([](const auto& s) { return own_pose(s); }, shape);
}

void put(Shape& shape, const Pose& pose) {
  std::visit([&](auto& s) { put_at(s, pose); }, shape);
}

double radius_of(const Shape& shape) {
  return std::visit([](const auto& s) { return own_radius(s); }, shape);
}

double moment_of_inertia(const Obstacle& free_sphere) {
  SUNDER_ASSERT(free_sphere.mass.has_value(), "only a free sphere has a moment of inertia");
  const double radius = std::get<Sphere>(free_sphere.shape).radius;
  return 0.4 * *free_sphere.mass * radius * radius;
}

Mat3 own_inertia(const Obstacle& free) {
  SUNDER_ASSERT(free.mass.has_value(), "only a free obstacle has an inertia");
  return std::visit([&](const auto& s) { return inertia_of(s, *free.mass); }, free.shape);
}

Mat3 inverse_inertia(const Obstacle& free) {
  if (std::holds_alternative<Sphere>(free.shape)) return Mat3::Identity() / moment_of_inertia(free);
  const Mat3 R = pose_of(free.shape).orientation.toRotationMatrix();
  return R * own_inertia(free).inverse() * R.transpose();
}

Vec3 angular_momentum_of(const Obstacle& free) {
  if (std::holds_alternative<Sphere>(free.shape)) return moment_of_inertia(free) * free.spin;
  const Eigen::Quaterniond R = pose_of(free.shape).orientation;
  return R * Vec3(own_inertia(free) * (R.conjugate() * free.spin));
}

Vec3 spin_of(const Obstacle& free, const Vec3& angular_momentum) {
  if (std::holds_alternative<Sphere>(free.shape)) return angular_momentum / moment_of_inertia(free);
  const Eigen::Quaterniond R = pose_of(free.shape).orientation;
  return R * solve3(own_inertia(free), R.conjugate() * angular_momentum);
}

double kinetic_energy(const Obstacle& free, const Vec3& velocity) {
  const double turning = std::holds_alternative<Sphere>(free.shape)
                             ? moment_of_inertia(free) * free.spin.squaredNorm()
                             : angular_momentum_of(free).dot(free.spin);
  return 0.5 * (*free.mass * (free.velocity - velocity).squaredNorm() + turning);
}

Vec3 carried_point(const Shape& before, const Shape& after, const Vec3& point) {
  const Pose from = pose_of(before), to = pose_of(after);
  return to.centre + to.orientation * (from.orientation.conjugate() * (point - from.centre));
}

std::size_t corner_count(const Shape& shape) {
  if (std::holds_alternative<Box>(shape)) return 8;
  const auto* solid = std::get_if<Solid>(&shape);
  return solid ? solid->surface->points.size() : 0;
}

Vec3 corner_at(const Shape& shape, std::uint32_t corner) {
  if (const auto* box = std::get_if<Box>(&shape)) {
    const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    return box->center + box->orientation * sign.cwiseProduct(box->half_extent);
  }
  const Solid& solid = std::get<Solid>(shape);
  return solid.translation + solid.orientation * solid.surface->points[corner];
}

std::size_t edge_count(const Shape& shape) {
  if (std::holds_alternative<Box>(shape)) return 12;
  const auto* solid = std::get_if<Solid>(&shape);
  return solid ? solid->surface->sharp_edges.size() : 0;
}

SolidSurface::Edge edge_at(const Shape& shape, std::uint32_t edge) {
  if (const auto* solid = std::get_if<Solid>(&shape)) return solid->surface->sharp_edges[edge];
  // Four along each axis, distinguished by the other two axes.
  const std::uint32_t axis = edge / 4, along = 1u << axis;
  const std::uint32_t next = 1u << (axis + 1) % 3, last = 1u << (axis + 2) % 3;
  const std::uint32_t from = (edge & 1 ? next : 0) | (edge & 2 ? last : 0);
  return {{from, from ^ along}, {from ^ next, from ^ last}};
}

std::span<const std::uint32_t> ring_of(const Solid& solid, std::uint32_t point) {
  const SolidSurface& surface = *solid.surface;
  const std::uint32_t first = surface.ring_first[point];
  return std::span(surface.ring).subspan(first, surface.ring_first[point + 1] - first);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Where points and paths meet obstacles, and how obstacles move.
#pragma once

#include <cstdint>
#include <span>

#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "mechanics/state/pose.hpp"

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

/// A point that moves straight from `start` to `end` (m) near a shape at rest.
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

/// Whether a path that enters a shape from outside stays in it no deeper than `rim` (m), as that of
/// a point that slides over the seam of two boxes: at its end and at 15 places on its way.
bool grazes(const Shape& shape, const Path& path, const FirstTouch& touch, double rim);

/// Where a place of a path (m) lies within `rim` (m) of more than one face of a box or a mesh, at
/// an edge where it is convex: the face that counts. Of those that the path ends behind it is the
/// one that it ends least deep behind. A point that slides over the edge along one face is not
/// stopped by the other.
void choose_face(FirstTouch& touch, const Shape& shape, const Path& path, const Vec3& place,
                 double rim);

/// Velocity of an obstacle's material at `point` of its surface, m/s.
Vec3 surface_velocity(const Obstacle& obstacle, const Vec3& point);

/// Moves an obstacle by `displacement` (m); planes shift along their normal.
void translate(Shape& shape, const Vec3& displacement);

inline bool is_sphere(const Obstacle& obstacle) {
  return std::holds_alternative<Sphere>(obstacle.shape);
}

/// Whether a shape has a volume: all but planes and meshes that were not read.
bool has_volume(const Shape& shape);

/// m^3. Needs: `has_volume`.
double volume_of(const Shape& shape);

/// Pose of a shape: its mass centre and, except for a sphere, its turn. Needs: a shape with a
/// volume, like the functions below.
Pose pose_of(const Shape& shape);

/// Puts it there.
void put(Shape& shape, const Pose& pose);

/// m, of the ball around the mass centre that holds the shape.
double radius_of(const Shape& shape);

/// Moment of inertia of a free sphere about its centre, 2/5 m r^2, kg m^2.
/// Needs: a sphere with a mass.
double moment_of_inertia(const Obstacle& free_sphere);

/// Inertia of a free obstacle about its mass centre, of the same density everywhere: in its own
/// axes (those of the mesh), kg m^2.
Mat3 own_inertia(const Obstacle& free);

/// The inverse of that in the world's axes.
Mat3 inverse_inertia(const Obstacle& free);

/// About the mass centre, world, kg m^2/s.
Vec3 angular_momentum_of(const Obstacle& free);

/// The spin (rad/s, world) that an angular momentum means for a free obstacle as it is turned.
Vec3 spin_of(const Obstacle& free, const Vec3& angular_momentum);

/// J, of motion against `velocity` (m/s).
double kinetic_energy(const Obstacle& free, const Vec3& velocity = Vec3::Zero());

/// Where `point` (m) of an obstacle's matter, fast to it in `before`, is in `after`.
Vec3 carried_point(const Shape& before, const Shape& after, const Vec3& point);

/// Number of corners: 8 of a box, the points of a mesh; 0 of planes and spheres.
std::size_t corner_count(const Shape& shape);

/// A corner, m; of a box number k has the sign of bit i of k along axis i.
Vec3 corner_at(const Shape& shape, std::uint32_t corner);

/// Number of edges at which a shape is sharp: 12 of a box, `sharp_edges` of a mesh.
std::size_t edge_count(const Shape& shape);

/// One of them: its ends, and a further corner of each of its two faces.
SolidSurface::Edge edge_at(const Shape& shape, std::uint32_t edge);

/// Points of a mesh that are joined to one by an edge.
std::span<const std::uint32_t> ring_of(const Solid& solid, std::uint32_t point);

/// The other ends of the edges at a corner: of a box three, of a mesh as many as there are.
/// Calls `visit(corner)`.
template <class Visit>
void for_each_neighbour(const Shape& shape, std::uint32_t corner, Visit visit) {
  if (std::holds_alternative<Box>(shape)) {
    for (std::uint32_t bit = 1; bit < 8; bit <<= 1) visit(corner ^ bit);
  } else if (const auto* solid = std::get_if<Solid>(&shape)) {
    for (const std::uint32_t end : ring_of(*solid, corner)) visit(end);
  }
}

}  // namespace sunder

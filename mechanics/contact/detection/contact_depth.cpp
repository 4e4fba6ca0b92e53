// SPDX-License-Identifier: MIT
// Depths of contacts on the solids themselves.
#include "mechanics/contact/detection/contact_depth.hpp"

#include <algorithm>
#include <limits>

#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {
namespace {

double depth_in_obstacle(const ContactPoint& contact, const StepPaths& paths) {
  const Shape shape = shape_about_reference(paths.obstacles[contact.obstacle]);
  const double gap = surface_distance(shape, path_of(contact, paths).end).gap;
  return contact.is_sphere_a() ? radius_of(paths.obstacles[contact.ball].shape) - gap : -gap;
}

/// Of a point, or of a sphere about it, in a tetrahedron; infinite for a point within.
double depth_in_tetrahedron(const ContactPoint& contact, const StepPaths& paths) {
  const Places x = places_at_end(paths, contact.tetrahedron);
  const Vec3 point = end_of_side_a(contact, paths);
  const std::array<double, 4> shares = nearest_point(x, point);
  const bool is_within = std::ranges::all_of(shares, [](double share) { return share > 0; });
  if (is_within) return std::numeric_limits<double>::infinity();
  if (!contact.is_sphere_a()) return 0;
  Vec3 nearest = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) nearest += shares[i] * x[i];
  return radius_of(paths.obstacles[contact.ball].shape) - (point - nearest).norm();
}

double depth_of_solids(const ContactPoint& contact, const StepPaths& paths) {
  const Places a = places_at_end(paths, contact.tetrahedron_a);
  const Places b = places_at_end(paths, contact.tetrahedron);
  return -common_gap(a, b, a, b, 0);
}

}  // namespace

double depth_at_end(const ContactPoint& contact, const StepPaths& paths) {
  const double in_plane = -gap_end(contact, path_of(contact, paths));
  if (!(in_plane > 0)) return 0;
  const auto of_solids = [&] {
    if (contact.obstacle != ContactPoint::none) return depth_in_obstacle(contact, paths);
    if (!contact.tetrahedron_a.is_none()) return depth_of_solids(contact, paths);
    return depth_in_tetrahedron(contact, paths);
  };
  return std::clamp(of_solids(), 0.0, in_plane);
}

}  // namespace sunder

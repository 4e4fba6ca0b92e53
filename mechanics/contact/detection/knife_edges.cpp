// SPDX-License-Identifier: MIT
// Normals of flat vertices on edges of boxes.
#include "mechanics/contact/detection/knife_edges.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "mechanics/contact/detection/fitting_normal.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {
namespace {

/// m: how far a shape reaches along a direction.
double reach_along(const Shape& shape, const Vec3& direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t c = 0; c < corner_count(shape); ++c) {
    farthest = std::max(farthest, direction.dot(corner_at(shape, c)));
  }
  return farthest;
}

/// Turns a contact, if its vertex calls for it. Gives whether it still comes near.
bool turn(ContactPoint& contact, double& gap_end, std::vector<Vec3>& ways,
          const DetectScratch& scratch, const StepPaths& paths, double band) {
  ways.clear();
  add_ways(ways, paths, scratch.surface, contact.vertex);
  const std::optional<Vec3> normal = fitting_normal(contact.normal, ways);
  if (!normal || *normal == contact.normal) return true;
  const Shape shape = shape_about_reference(paths.obstacles[contact.obstacle]);
  const ContactPath path = path_of(contact, paths);
  const double way = contact.gap_start - gap_end;
  const double part = way > 0 ? std::clamp(contact.gap_start / way, 0.0, 1.0) : 0;
  const Vec3 touches = (1 - part) * path.start + part * path.end;
  const SurfaceDistance nearest = surface_distance(shape, touches);
  const double reach = reach_along(shape, *normal);
  if (reach - normal->dot(touches - nearest.gap * nearest.normal) > 10 * band) return true;
  contact.normal = *normal;
  contact.gap_start = normal->dot(path.start) - reach;
  contact.offset = -reach;
  gap_end = normal->dot(path.end) - reach;
  return gap_end < (path.end - path.start).norm();
}

bool has_edges(const Obstacle& obstacle) { return edge_count(obstacle.shape) > 0; }

}  // namespace

void turn_to_flat_surfaces(DetectScratch& scratch, const StepPaths& paths, double band) {
  const auto is_at_edges = [&](const ContactPoint& contact) {
    return has_edges(paths.obstacles[contact.obstacle]);
  };
  if (paths.neighbours.empty() || std::ranges::none_of(scratch.found, is_at_edges)) return;
  update_surface(scratch.surface, paths.state.elements, paths.corners, paths.neighbours,
                 paths.state.vertices.size());
  std::vector<Vec3> ways;
  keep_found(scratch, [&](std::size_t k) {
    ContactPoint& contact = scratch.found[k];
    return !is_at_edges(contact) || turn(contact, scratch.found_gap[k], ways, scratch, paths, band);
  });
}

}  // namespace sunder

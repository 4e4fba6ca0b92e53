// SPDX-License-Identifier: MIT
// Normals of flat vertices on edges of boxes.
#include "mechanics/contact/detection/knife_edges.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {
namespace {

/// Sine of the angle by which neighbours of a vertex may lie below the plane of its contact: that
/// of a wave of strain, and far below that of an edge.
constexpr double level = 0.1;

/// The way from a vertex to the neighbour on its surface that lies farthest below a plane, unit.
std::optional<Vec3> lowest_way(const DetectScratch& scratch, const StepPaths& paths, VertexId v,
                               const Vec3& normal) {
  std::optional<Vec3> lowest;
  double least = -level;
  for (const VertexId end : scratch.surface.ring_of(v)) {
    const Vec3 way = (paths.at_start(end) - paths.at_start(v)).normalized();
    if (!(normal.dot(way) < least)) continue;
    least = normal.dot(way);
    lowest = way;
  }
  return lowest;
}

/// The normal without what goes against the surface at a vertex; nothing where that is no plane.
std::optional<Vec3> along_surface(const DetectScratch& scratch, const StepPaths& paths, VertexId v,
                                  Vec3 normal) {
  constexpr int most = 4;
  for (int k = 0; k < most; ++k) {
    const std::optional<Vec3> way = lowest_way(scratch, paths, v, normal);
    if (!way) return normal;
    normal -= normal.dot(*way) * *way;
    // A cosine of more than a right angle less this is no side of the edge.
    if (!(normal.norm() > level)) return std::nullopt;
    normal.normalize();
  }
  return std::nullopt;
}

/// m: how far a shape reaches along a direction.
double reach_along(const Shape& shape, const Vec3& direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t c = 0; c < corner_count(shape); ++c) {
    farthest = std::max(farthest, direction.dot(corner_at(shape, c)));
  }
  return farthest;
}

/// Turns a contact, if its vertex calls for it. Gives whether it still comes near.
bool turn(ContactPoint& contact, double& gap_end, const DetectScratch& scratch,
          const StepPaths& paths, double band) {
  if (!lowest_way(scratch, paths, contact.vertex, contact.normal)) return true;
  const std::optional<Vec3> normal = along_surface(scratch, paths, contact.vertex, contact.normal);
  if (!normal) return true;
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
  if (paths.neighbours.empty() || std::ranges::none_of(paths.obstacles, has_edges)) return;
  update_surface(scratch.surface, paths.state.elements, paths.corners, paths.neighbours,
                 paths.state.vertices.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < scratch.found.size(); ++k) {
    ContactPoint contact = scratch.found[k];
    double gap_end = scratch.found_gap[k];
    if (has_edges(paths.obstacles[contact.obstacle]) &&
        !turn(contact, gap_end, scratch, paths, band))
      continue;
    scratch.found[kept] = contact;
    scratch.found_gap[kept++] = gap_end;
  }
  scratch.found.resize(kept);
  scratch.found_gap.resize(kept);
}

}  // namespace sunder

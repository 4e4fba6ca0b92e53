// SPDX-License-Identifier: MIT
// Projections of normals by the ways of surfaces.
#include "mechanics/contact/detection/fitting_normal.hpp"

#include <algorithm>
#include <vector>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {
namespace {

/// Sine of the angle by which a surface may go against the normal of a contact: a wave of strain
/// bends faces by less, and an edge by more.
constexpr double against = 0.05;

/// The way that goes against a normal most, if by more than `against`.
std::optional<Vec3> worst_way(const Vec3& normal, std::span<const Vec3> ways) {
  std::optional<Vec3> worst;
  double least = -against;
  for (const Vec3& way : ways) {
    if (!(normal.dot(way) < least)) continue;
    least = normal.dot(way);
    worst = way;
  }
  return worst;
}

/// Calls `visit(way)` for each way along the surface of side A from its vertex, m.
template <class Visit>
void for_each_way_of_a(const FaceTouch& touch, const StepPaths& paths, const PieceSurface& surface,
                       Visit visit) {
  const Vec3& from = paths.at_start(touch.vertex);
  if (!paths.is_corner(touch.vertex)) {
    for (const VertexId end : surface.ring_of(touch.vertex)) {
      visit(Vec3(paths.at_start(end) - from));
    }
    return;
  }
  const CornerPath& corner = paths.corner_of(touch.vertex);
  const Shape& shape = paths.obstacles[corner.obstacle].shape;
  for_each_neighbour(shape, corner.corner,
                     [&](std::uint32_t end) { visit(Vec3(corner_at(shape, end) - from)); });
}

/// Unit ways against the surface of side B from its edge or corner at the place that is touched.
/// None inside a face.
void add_ways_of_b(std::vector<Vec3>& ways, const FaceTouch& touch, const StepPaths& paths,
                   const PieceSurface& surface, double rim) {
  const std::array<VertexId, 3> corners = corners_of(paths, touch.face);
  const std::array<Vec3, 3> x = places_at(paths, corners, 0);
  const Vec3 at = touch.foot[0] * x[0] + touch.foot[1] * x[1] + touch.foot[2] * x[2];
  for (std::size_t k = 0; k < 3; ++k) {
    if ((at - x[k]).norm() > rim) continue;
    for (const VertexId end : surface.ring_of(corners[k])) {
      ways.push_back((x[k] - paths.at_start(end)).normalized());
    }
    return;
  }
  const auto row = std::ranges::lower_bound(surface.faces, touch.face) - surface.faces.begin();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = (x[(k + 1) % 3] - x[k]).normalized();
    if ((at - x[k]).cross(along).norm() > rim) continue;
    ways.insert(ways.end(), {along, -along});
    const SurfaceEdge& edge = surface.edges[surface.face_edges[static_cast<std::size_t>(row)][k]];
    for (const VertexId beside : edge.beside) {
      if (!beside.is_none()) ways.push_back((at - paths.at_start(beside)).normalized());
    }
    return;
  }
}

}  // namespace

void add_ways(std::vector<Vec3>& ways, const StepPaths& paths, const PieceSurface& surface,
              VertexId v) {
  for (const VertexId end : surface.ring_of(v)) {
    ways.push_back((paths.at_start(end) - paths.at_start(v)).normalized());
  }
}

bool fits(const FaceTouch& touch, const StepPaths& paths, const PieceSurface& surface) {
  bool all = true;
  for_each_way_of_a(touch, paths, surface, [&](const Vec3& way) {
    all = all && touch.normal.dot(way) >= -against * way.norm();
  });
  return all;
}

std::optional<Vec3> fitting_normal(const Vec3& normal, std::span<const Vec3> ways) {
  constexpr double least_cosine = 0.1;
  const std::optional<Vec3> first = worst_way(normal, ways);
  if (!first) return normal;
  const Vec3 without = normal - normal.dot(*first) * *first;
  if (!(without.norm() > least_cosine)) return std::nullopt;
  Vec3 fitting = without.normalized();
  const std::optional<Vec3> second = worst_way(fitting, ways);
  if (!second) return fitting;
  const Vec3 across = first->cross(*second);
  if (!(across.norm() > against)) return std::nullopt;
  fitting = across.normalized();
  if (fitting.dot(normal) < 0) fitting = -fitting;
  if (fitting.dot(normal) < least_cosine || worst_way(fitting, ways)) return std::nullopt;
  return fitting;
}

void turn_to_fit(FaceTouch& touch, const StepPaths& paths, const PieceSurface& surface,
                 double rim) {
  // A vertex inside leaves by the face that it is nearest to.
  if (touch.gap_start < -rim || fits(touch, paths, surface)) return;
  std::vector<Vec3> ways;
  add_ways_of_b(ways, touch, paths, surface, rim);
  if (ways.empty()) return;
  for_each_way_of_a(touch, paths, surface,
                    [&](const Vec3& way) { ways.push_back(way.normalized()); });
  const std::optional<Vec3> normal = fitting_normal(touch.normal, ways);
  if (!normal) return;
  touch.normal = *normal;
  const std::array<VertexId, 3> corners = corners_of(paths, touch.face);
  const auto gap_at = [&](double part) {
    const std::array<Vec3, 3> x = places_at(paths, corners, part);
    return normal->dot(paths.at(touch.vertex, part) - touch.foot[0] * x[0] - touch.foot[1] * x[1] -
                       touch.foot[2] * x[2]);
  };
  touch.gap_start = gap_at(0);
  touch.gap_end = gap_at(1);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Contacts of vertices, balls and tetrahedron spheres along their paths through a step.
#include "mechanics/contact/detection/contact_detect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <variant>

#include "mechanics/contact/detection/contact_balls.hpp"
#include "mechanics/contact/detection/contact_edges.hpp"
#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/detection/contact_pieces.hpp"
#include "mechanics/contact/detection/knife_edges.hpp"
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/assert.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// Whether a path ends nearer to the plane that it meets than it is long, or than `margin` (m).
bool is_near(const FirstTouch& touch, const Path& path, double margin) {
  return touch.gap_end < std::max(margin, (path.end - path.start).norm());
}

/// Adds a contact with sides that are `end` apart at the end of the step.
void add(DetectScratch& scratch, ContactPoint contact, const FirstTouch& touch, const Vec3& end) {
  contact.normal = touch.normal;
  contact.gap_start = touch.gap_start;
  contact.offset = touch.gap_end - touch.normal.dot(end);
  scratch.found.push_back(contact);
  scratch.found_gap.push_back(touch.gap_end);
}

/// Adds the contact if its path ends near. `rim`: m, `rim_of`; `margin`: m, `StepPaths::margin`.
void add_if_near(DetectScratch& scratch, const ContactPoint& contact, const Shape& shape,
                 const Path& path, double rim, double margin) {
  FirstTouch touch = first_touch(shape, path);
  if (std::abs(touch.gap_start) <= rim) choose_face(touch, shape, path, path.start, rim);
  if (!is_near(touch, path, margin)) return;
  if (grazes(shape, path, touch, rim)) choose_face(touch, shape, path, path.end, rim);
  add(scratch, contact, touch, path.end);
}

VertexReach reach_of_vertices(const StepPaths& paths) {
  VertexReach reach;
  double squared = 0;
  for (std::size_t v = 0; v < paths.predicted.size(); ++v) {
    if (!paths.members.has(paths.state.vertices.component[v])) continue;
    const Vec3 &start = paths.state.vertices.position[v], &end = paths.predicted[v];
    reach.low = reach.low.cwiseMin(start).cwiseMin(end);
    reach.high = reach.high.cwiseMax(start).cwiseMax(end);
    squared = std::max(squared, (end - start).squaredNorm());
  }
  reach.farthest = std::sqrt(squared);
  return reach;
}

/// Whether no vertex comes near a ball (`is_near`): each would have to go half of the way between.
bool is_far(const StepPaths& paths, std::uint32_t row, const VertexReach& reach) {
  const Obstacle& obstacle = paths.obstacles[row];
  const auto* ball = std::get_if<Sphere>(&obstacle.shape);
  if (!ball) return false;
  const double own = obstacle.mass ? (paths.ball_end[row].centre - ball->center).norm()
                                   : paths.time_step * obstacle.velocity.norm();
  const Vec3 apart = (reach.low - ball->center).cwiseMax(ball->center - reach.high).cwiseMax(0);
  return apart.norm() - ball->radius > 2 * (reach.farthest + own) + paths.margin;
}

void find_vertex_obstacle(DetectScratch& scratch, const StepPaths& paths, std::uint32_t row,
                          double friction, double rim) {
  const Obstacle& obstacle = paths.obstacles[row];
  const Shape shape = shape_about_reference(obstacle);
  ContactPoint contact;
  contact.obstacle = row;
  contact.friction = 0.5 * (friction + obstacle.friction);
  if (obstacle.mass && !paths.members.has_ball(row)) return;
  for (std::size_t v = 0; v < paths.predicted.size(); ++v) {
    if (!paths.members.has(paths.state.vertices.component[v])) continue;
    contact.vertex = VertexId{v};
    const ContactPath path = path_of(contact, paths);
    add_if_near(scratch, contact, shape, {path.start, path.end, 0}, rim, paths.margin);
  }
}

/// Leaves out contacts of vertices that rest on one obstacle with another one that lies flush with
/// it: a vertex that is lifted off the first is clear of the second.
void leave_out_seams(DetectScratch& scratch, const StepPaths& paths, double rim) {
  std::vector<std::uint32_t>& order = scratch.order;
  order.resize(scratch.found.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t k) { return scratch.found[k].vertex; });
  std::vector<char> is_out(order.size(), 0);
  const auto leave_out = [&](std::uint32_t of, std::uint32_t rest) {
    const ContactPoint& contact = scratch.found[of];
    const ContactPoint& support = scratch.found[rest];
    if (of == rest || is_out[rest] || support.gap_start > rim) return false;
    const Vec3 lift = (rim - std::min(0.0, scratch.found_gap[rest])) * support.normal;
    const Shape shape = shape_about_reference(paths.obstacles[contact.obstacle]);
    return surface_distance(shape, path_of(contact, paths).end + lift).gap >= 0;
  };
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    const VertexId v = scratch.found[order[first]].vertex;
    while (end < order.size() && scratch.found[order[end]].vertex == v) ++end;
    const std::span<const std::uint32_t> same(order.data() + first, end - first);
    for (const std::uint32_t k : same) {
      is_out[k] = same.size() > 1 &&
                  std::ranges::any_of(same, [&](std::uint32_t rest) { return leave_out(k, rest); });
    }
    first = end;
  }
  keep_found(scratch, [&](std::size_t k) { return !is_out[k]; });
}

/// Adds a contact of side A, as in `contact`, with another obstacle.
void find_from_side_a(DetectScratch& scratch, const StepPaths& paths, ContactPoint contact,
                      const Shape& about_reference, double radius, double rim) {
  const ContactPath path = path_of(contact, paths);
  add_if_near(scratch, contact, about_reference, {path.start, path.end, radius}, rim, paths.margin);
}

/// Free obstacles against all others: balls by themselves, the rest by corners, those of both.
void find_between_obstacles(DetectScratch& scratch, const StepPaths& paths, double rim) {
  const auto rows = static_cast<std::uint32_t>(paths.obstacles.size());
  const auto moves = [&](std::uint32_t row) {
    return !paths.obstacles[row].mass || paths.members.has_ball(row);
  };
  for (std::uint32_t a = 0; a < rows; ++a) {
    const Obstacle& one = paths.obstacles[a];
    if (!moves(a)) continue;
    const bool is_ball = one.mass && is_sphere(one);
    if (!is_ball && corner_count(one.shape) == 0) continue;
    for (std::uint32_t b = 0; b < rows; ++b) {
      const Obstacle& other = paths.obstacles[b];
      if (a == b || !moves(b) || (!one.mass && !other.mass)) continue;
      // Of two balls the first is side A.
      if (is_ball && other.mass && is_sphere(other) && b < a) continue;
      ContactPoint contact;
      contact.ball = a;
      contact.obstacle = b;
      contact.friction = 0.5 * (one.friction + other.friction);
      const Shape shape = shape_about_reference(other);
      if (is_ball) {
        find_from_side_a(scratch, paths, contact, shape, radius_of(one.shape), rim);
        continue;
      }
      for (contact.corner = 0; contact.corner < corner_count(one.shape); ++contact.corner) {
        find_from_side_a(scratch, paths, contact, shape, 0, rim);
      }
    }
  }
}

/// Corners of obstacles on their ways, those that come into the box of all pieces on theirs.
void find_corners(std::vector<CornerPath>& corners, const StepPaths& paths,
                  const VertexReach& reach) {
  corners.clear();
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    const Obstacle& obstacle = paths.obstacles[row];
    if (obstacle.mass && !paths.members.has_ball(row)) continue;
    ContactPoint contact;
    contact.ball = row;
    for (contact.corner = 0; contact.corner < corner_count(obstacle.shape); ++contact.corner) {
      const CornerPath path{row, contact.corner, start_of_side_a(contact, paths),
                            end_of_side_a(contact, paths)};
      if (reach.meets(path.start.cwiseMin(path.end), path.start.cwiseMax(path.end))) {
        corners.push_back(path);
      }
    }
  }
}

/// Contacts of vertices with obstacles. `reach`: of the vertices.
void find_vertex_contacts(DetectScratch& scratch, const StepPaths& paths,
                          const ContactSettings& settings, const VertexReach& reach) {
  scratch.found.clear();
  scratch.found_gap.clear();
  const double rim = rim_of(settings);
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    if (!is_far(paths, row, reach))
      find_vertex_obstacle(scratch, paths, row, settings.friction, rim);
  }
  turn_to_flat_surfaces(scratch, paths, settings.allowed_penetration);
  if (paths.obstacles.size() > 1) leave_out_seams(scratch, paths, rim);
}

}  // namespace

Shape shape_about_reference(const Obstacle& obstacle) {
  Shape shape = obstacle.shape;
  if (obstacle.mass) put(shape, {Vec3::Zero(), pose_of(shape).orientation});
  return shape;
}

void add_found(DetectScratch& scratch, const StepPaths& paths, ContactPoint contact,
               double gap_end) {
  contact.offset = gap_end - contact.normal.dot(path_of(contact, paths).end);
  scratch.found.push_back(contact);
  scratch.found_gap.push_back(gap_end);
}

bool has_several_pieces(const StepPaths& paths, const ContactSettings& settings) {
  const std::vector<ComponentId>& all = paths.state.elements.component;
  return settings.between_pieces &&
         std::ranges::any_of(all, [&](ComponentId c) { return c != all.front(); });
}

bool may_overlap(const StepPaths& paths, const ContactSettings& settings) {
  return !paths.neighbours.empty() &&
         (has_several_pieces(paths, settings) || std::ranges::any_of(paths.obstacles, is_sphere));
}

void find_on_obstacles(DetectScratch& scratch, const StepPaths& paths,
                       const ContactSettings& settings) {
  find_vertex_contacts(scratch, paths, settings, reach_of_vertices(paths));
}

void find_contacts(DetectScratch& scratch, const ContactMemory& memory, const StepPaths& paths,
                   const ContactSettings& settings) {
  SUNDER_ASSERT(paths.predicted.size() == paths.state.vertices.size(), "predict before contact");
  const VertexReach reach = reach_of_vertices(paths);
  find_vertex_contacts(scratch, paths, settings, reach);
  const double rim = rim_of(settings);
  find_between_obstacles(scratch, paths, rim);
  find_edges_of_obstacles(scratch, paths, settings);
  if (settings.between_pieces) find_between_partners(scratch, memory, paths, settings);
  if (paths.neighbours.empty()) return;
  StepPaths with_corners = paths;
  find_corners(scratch.corner, paths, reach);
  with_corners.corner = scratch.corner;
  const bool among_pieces = has_several_pieces(paths, settings);
  const bool any_spheres = std::ranges::any_of(paths.obstacles, is_sphere);
  const bool any_edges = among_pieces || has_obstacle_edges(paths, reach);
  if (!among_pieces && with_corners.corner.empty() && !any_spheres && !any_edges) return;
  measure_balls(scratch, paths, 1);
  update_surface(scratch.surface, paths.state.elements, paths.corners, paths.neighbours,
                 paths.state.vertices.size());
  update_near(scratch, paths);
  if (among_pieces || !with_corners.corner.empty()) {
    find_between_pieces(scratch, with_corners, settings, among_pieces);
  }
  if (any_spheres) find_balls_on_pieces(scratch, paths, settings.friction);
  if (any_edges) find_between_edges(scratch, paths, settings, reach);
}

}  // namespace sunder

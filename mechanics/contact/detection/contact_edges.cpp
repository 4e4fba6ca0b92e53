// SPDX-License-Identifier: MIT
// Pairs of edges by their boxes; the normal by the product of their directions.
#include "mechanics/contact/detection/contact_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/detection/pairs/edge_pairs.hpp"
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/box_pairs.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

/// An edge of a piece or of an obstacle on its way.
struct MovingEdge {
  std::array<Vec3, 2> start, end;  ///< m, of its ends
  std::array<Vec3, 2> beside;      ///< m, at the start: a point of each of its faces
  std::uint32_t besides = 0;       ///< how many of them
  std::uint32_t row = 0;           ///< of `surface.edges`, or the obstacle
  std::uint32_t number = 0;        ///< of an obstacle: `edge_at`
  bool is_obstacle = false;

  Vec3 along(double part) const {
    return (1 - part) * (start[1] - start[0]) + part * (end[1] - end[0]);
  }
  Vec3 at(double share, double part) const {
    return (1 - part) * start[0] + part * end[0] + share * along(part);
  }
};

/// Two edges where their lines are nearest.
struct EdgeTouch {
  Vec3 normal{0, 0, 1};               ///< unit, from B to A
  double share_a = 0, share_b = 0;    ///< of the ways along the edges
  double gap_start = 0, gap_end = 0;  ///< m
};

MovingEdge moving_edge(const StepPaths& paths, const SurfaceEdge& edge, std::uint32_t row) {
  MovingEdge moving{.row = row};
  for (std::size_t k = 0; k < 2; ++k) {
    moving.start[k] = paths.at_start(edge.end[k]);
    moving.end[k] = paths.at_end(edge.end[k]);
    if (edge.beside[k].is_none()) continue;
    moving.beside[moving.besides++] = paths.at_start(edge.beside[k]);
  }
  return moving;
}

bool is_inside(const StepPaths& paths, const SurfaceEdge& edge) {
  return paths.is_inside(paths.state.vertices.component[edge.end[0].index()]);
}

MovingEdge moving_edge(const StepPaths& paths, std::uint32_t row, std::uint32_t number) {
  const Shape& shape = paths.obstacles[row].shape;
  const SolidSurface::Edge edge = edge_at(shape, number);
  MovingEdge moving{.besides = 2, .row = row, .number = number, .is_obstacle = true};
  for (std::size_t k = 0; k < 2; ++k) {
    const ContactPoint corner{.ball = row, .corner = edge.end[k]};
    moving.start[k] = start_of_side_a(corner, paths);
    moving.end[k] = end_of_side_a(corner, paths);
    moving.beside[k] = corner_at(shape, edge.beside[k]);
  }
  return moving;
}

/// The box around the straight way of an edge.
Bounds bounds_of(const MovingEdge& e) {
  return {e.start[0].cwiseMin(e.start[1]).cwiseMin(e.end[0]).cwiseMin(e.end[1]),
          e.start[0].cwiseMax(e.start[1]).cwiseMax(e.end[0]).cwiseMax(e.end[1])};
}

Bounds widened(const Bounds& box, double beside) {
  return {box.low - Vec3::Constant(beside), box.high + Vec3::Constant(beside)};
}

/// Calls `visit(edge)` for each sharp edge of an obstacle that comes into a box on its way.
template <class Visit>
void for_each_edge_within(const StepPaths& paths, std::uint32_t row, const Bounds& box,
                          Visit visit) {
  const Obstacle& obstacle = paths.obstacles[row];
  if (obstacle.mass && !paths.members.has_ball(row)) return;
  const auto count = static_cast<std::uint32_t>(edge_count(obstacle.shape));
  for (std::uint32_t number = 0; number < count; ++number) {
    const MovingEdge edge = moving_edge(paths, row, number);
    if (bounds_of(edge).overlaps(box)) visit(edge);
  }
}

/// The box around the ways of all corners of an obstacle; empty without corners, or where it keeps
/// out of the step.
Bounds way_of_obstacle(const StepPaths& paths, std::uint32_t row) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Bounds box{Vec3::Constant(far), Vec3::Constant(-far)};
  const Obstacle& obstacle = paths.obstacles[row];
  if (obstacle.mass && !paths.members.has_ball(row)) return box;
  ContactPoint contact{.ball = row};
  for (contact.corner = 0; contact.corner < corner_count(obstacle.shape); ++contact.corner) {
    for (const Vec3& x : {start_of_side_a(contact, paths), end_of_side_a(contact, paths)}) {
      box.low = box.low.cwiseMin(x);
      box.high = box.high.cwiseMax(x);
    }
  }
  return box;
}

/// Whether a plane through an edge leaves the faces of A above and those of B below. `normal`:
/// unit.
bool fits(const MovingEdge& a, const MovingEdge& b, const Vec3& normal) {
  // Strains bend the flat faces that lie on edges of obstacles. Faces of pieces that lie on each
  // other are in the plane but for rounding.
  const double level = a.is_obstacle || b.is_obstacle ? flat_sine : 1e-6;
  const auto is_above = [&](const MovingEdge& edge, const Vec3& up) {
    for (std::uint32_t k = 0; k < edge.besides; ++k) {
      const Vec3 beside = edge.beside[k] - edge.start[0];
      if (up.dot(beside) < -level * beside.norm()) return false;
    }
    return true;
  };
  return is_above(a, normal) && is_above(b, -normal);
}

/// Shares at which the lines of two edges are nearest after a part of the step.
std::array<double, 2> nearest_shares(const MovingEdge& a, const MovingEdge& b, double part) {
  const Vec3 u = a.along(part), v = b.along(part), r = a.at(0, part) - b.at(0, part);
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double across = uu * vv - uv * uv;
  return {(uv * v.dot(r) - vv * u.dot(r)) / across, (uu * v.dot(r) - uv * u.dot(r)) / across};
}

/// Whether a place of an edge is far enough from its ends, which are left to their vertices.
/// `rim`: m. Vertices of pieces also see the faces next to edges of other pieces.
bool is_within(double share, const Vec3& edge, bool of_pieces, double rim) {
  constexpr double share_of_vertices = 0.02;
  const double length = edge.norm();
  const double ends = of_pieces ? std::max(rim, share_of_vertices * length) : rim;
  return share * length > ends && (1 - share) * length > ends;
}

std::optional<EdgeTouch> touch_of(const MovingEdge& a, const MovingEdge& b, double band) {
  const auto normal_at = [&](double part) { return Vec3(a.along(part).cross(b.along(part))); };
  const Vec3 normal = normal_at(0);
  const double length = a.along(0).norm() * b.along(0).norm();
  if (!(normal.norm() > flat_sine * length)) return std::nullopt;
  double sign = 1;
  const Vec3 unit = normal.normalized();
  if (!fits(a, b, unit)) {
    if (!fits(a, b, -unit)) return std::nullopt;
    sign = -1;
  }
  const auto gap_at = [&](double part) {
    return sign * normal_at(part).normalized().dot(a.at(0, part) - b.at(0, part));
  };
  const double start = gap_at(0), end = gap_at(1);
  if (start < -10 * band) return std::nullopt;
  double part = 0;
  if (start > band) part = end < 0 ? start / (start - end) : (end < start ? 1.0 : 0.0);
  EdgeTouch touch;
  touch.normal = sign * normal_at(part).normalized();
  const auto [s, t] = nearest_shares(a, b, part);
  const bool of_pieces = !a.is_obstacle && !b.is_obstacle;
  if (!is_within(s, a.along(part), of_pieces, 2 * band)) return std::nullopt;
  if (!is_within(t, b.along(part), of_pieces, 2 * band)) return std::nullopt;
  touch.share_a = s;
  touch.share_b = t;
  const Vec3 from = a.at(s, 0) - b.at(t, 0), to = a.at(s, 1) - b.at(t, 1);
  touch.gap_start = touch.normal.dot(from);
  touch.gap_end = touch.normal.dot(to);
  // Boxes find no edges farther apart than this, or only by how they lie to the axes.
  if (std::min(touch.gap_start, touch.gap_end) > 10 * band) return std::nullopt;
  // Pieces that fall together will press once the lowest is stopped.
  const bool counts = touch.gap_end < (to - from).norm() || touch.gap_end <= 0.01 * band;
  return counts ? std::optional(touch) : std::nullopt;
}

/// Shares of the corners of the tetrahedron in which an edge has its place.
std::array<double, 4> weights_of(const SurfaceEdge& edge, double share, const StepPaths& paths) {
  std::array<double, 4> weights{};
  const Corners& corners = paths.corners[tetrahedron_of(edge.face[0]).index()];
  for (std::size_t i = 0; i < 4; ++i) {
    if (corners[i] == edge.end[0]) weights[i] = 1 - share;
    if (corners[i] == edge.end[1]) weights[i] = share;
  }
  return weights;
}

std::uint8_t place_of(const SurfaceEdge& edge) {
  return static_cast<std::uint8_t>(ContactPoint::edge_place + edge.place);
}

void add(DetectScratch& scratch, const StepPaths& paths, const MovingEdge& a, const MovingEdge& b,
         const EdgeTouch& touch, double friction) {
  ContactPoint contact;
  double friction_a = friction, friction_b = friction;
  if (a.is_obstacle) {
    contact.ball = a.row;
    contact.edge_a = a.number;
    contact.weights_a = {1 - touch.share_a, touch.share_a, 0, 0};
    friction_a = paths.obstacles[a.row].friction;
  } else {
    const SurfaceEdge& own = scratch.surface.edges[a.row];
    contact.tetrahedron_a = tetrahedron_of(own.face[0]);
    contact.place_a = place_of(own);
    contact.weights_a = weights_of(own, touch.share_a, paths);
  }
  if (b.is_obstacle) {
    contact.obstacle = b.row;
    contact.edge_b = b.number;
    friction_b = paths.obstacles[b.row].friction;
  } else {
    const SurfaceEdge& other = scratch.surface.edges[b.row];
    contact.tetrahedron = tetrahedron_of(other.face[0]);
    contact.place = place_of(other);
    contact.weights = weights_on(contact, weights_of(other, touch.share_b, paths), paths);
  }
  contact.friction = 0.5 * (friction_a + friction_b);
  contact.normal = touch.normal;
  contact.gap_start = touch.gap_start;
  add_found(scratch, paths, contact, touch.gap_end);
}

/// Whether the edges are of crack faces that still face each other.
bool are_partners(const DetectScratch& scratch, const SurfaceEdge& a, const SurfaceEdge& b) {
  return std::ranges::any_of(a.end, [&](VertexId v) {
    return std::ranges::any_of(b.end, [&](VertexId w) {
      return std::ranges::binary_search(scratch.facing, std::pair(v, w));
    });
  });
}

/// Row = edge of the surface: the boxes around their ways, widened.
void box_edges(std::vector<Bounds>& boxes, const std::vector<SurfaceEdge>& edges,
               const StepPaths& paths, double beside) {
  const Vec3 wide = Vec3::Constant(beside);
  boxes.clear();
  for (const SurfaceEdge& edge : edges) {
    const auto& [a, b] = edge.end;
    const Vec3 &p = paths.at_start(a), &q = paths.at_start(b);
    const Vec3 &r = paths.at_end(a), &s = paths.at_end(b);
    boxes.push_back({p.cwiseMin(q).cwiseMin(r).cwiseMin(s) - wide,
                     p.cwiseMax(q).cwiseMax(r).cwiseMax(s) + wide});
  }
}

}  // namespace

bool has_obstacle_edges(const StepPaths& paths, const VertexReach& reach) {
  bool any = false;
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    for_each_edge_within(paths, row, {reach.low, reach.high},
                         [&](const MovingEdge&) { any = true; });
  }
  return any;
}

void find_between_edges(DetectScratch& scratch, const StepPaths& paths,
                        const ContactSettings& settings, const VertexReach& reach) {
  const double band = settings.allowed_penetration;
  const auto meet_edges = [&](const MovingEdge& a, const MovingEdge& b) {
    const std::optional<EdgeTouch> touch = touch_of(a, b, band);
    if (touch) add(scratch, paths, a, b, *touch, settings.friction);
  };
  const std::vector<SurfaceEdge>& edges = scratch.surface.edges;
  std::vector<Bounds>& boxes = scratch.edge_boxes;
  box_edges(boxes, edges, paths, 10 * band);
  for (std::uint32_t obstacle = 0; obstacle < paths.obstacles.size(); ++obstacle) {
    for_each_edge_within(paths, obstacle, {reach.low, reach.high}, [&](const MovingEdge& other) {
      const Bounds way = bounds_of(other);
      for (std::uint32_t row = 0; row < edges.size(); ++row) {
        if (!way.overlaps(boxes[row]) || !is_inside(paths, edges[row])) continue;
        // Flat edges too: a face that lies on a long edge may have no vertex there.
        meet_edges(moving_edge(paths, edges[row], row), other);
      }
    });
  }
  if (!has_several_pieces(paths, settings)) return;
  if (!keeps_pairs(scratch, paths)) {
    find_swept_edges(scratch, paths, 10 * band);
    for (const auto& [a, b] : scratch.swept) {
      if (!boxes[a].overlaps(boxes[b]) || are_partners(scratch, edges[a], edges[b])) continue;
      meet_edges(moving_edge(paths, edges[a], a), moving_edge(paths, edges[b], b));
    }
    return;
  }
  refresh_edges(scratch, paths, 10 * band);
  const Travel& travel = scratch.travel;
  std::vector<PairContacts> noted;
  for (NearPair& pair : scratch.near_edges.found) {
    if (!is_due(pair, travel)) continue;
    if (!paths.may_meet(ComponentId{pair.body_a}, ComponentId{pair.body_b})) continue;
    const std::uint32_t a = scratch.edge_row[pair.a], b = scratch.edge_row[pair.b];
    pair.facing = 0;
    pair.quiet = travel.start_of(pair.body_a, pair.body_b) +
                 std::min(distance_at_start(paths, edges[a], edges[b]), scratch.mean_edge) -
                 10 * band;
    if (!is_due(pair, travel)) continue;
    if (are_partners(scratch, edges[a], edges[b])) {
      pair.facing = 1 + travel.parted[pair.body_a] + travel.parted[pair.body_b];
      continue;
    }
    if (!boxes[a].overlaps(boxes[b])) continue;
    if (!is_sharp(paths, edges[a]) || !is_sharp(paths, edges[b])) continue;
    const std::size_t first = scratch.found.size();
    meet_edges(moving_edge(paths, edges[a], a), moving_edge(paths, edges[b], b));
    note_contacts(noted, pair, scratch, first);
  }
  sort_contacts(scratch, noted);
}

void find_edges_of_obstacles(DetectScratch& scratch, const StepPaths& paths,
                             const ContactSettings& settings) {
  const auto rows = static_cast<std::uint32_t>(paths.obstacles.size());
  const double band = settings.allowed_penetration;
  std::vector<Bounds>& ways = scratch.obstacle_ways;
  ways.clear();
  for (std::uint32_t row = 0; row < rows; ++row) {
    ways.push_back(widened(way_of_obstacle(paths, row), 10 * band));
  }
  const auto edges_within = [&](std::uint32_t row, const Bounds& box) {
    std::vector<MovingEdge> edges;
    for_each_edge_within(paths, row, box, [&](const MovingEdge& e) { edges.push_back(e); });
    return edges;
  };
  for (std::uint32_t a = 0; a < rows; ++a) {
    for (std::uint32_t b = a + 1; b < rows; ++b) {
      if (!paths.obstacles[a].mass && !paths.obstacles[b].mass) continue;
      if (!ways[a].overlaps(ways[b])) continue;
      const std::vector<MovingEdge> others = edges_within(b, ways[a]);
      for (const MovingEdge& one : edges_within(a, ways[b])) {
        const Bounds box = widened(bounds_of(one), 10 * band);
        for (const MovingEdge& other : others) {
          if (!box.overlaps(bounds_of(other))) continue;
          const std::optional<EdgeTouch> touch = touch_of(one, other, band);
          if (touch) add(scratch, paths, one, other, *touch, settings.friction);
        }
      }
    }
  }
}

}  // namespace sunder

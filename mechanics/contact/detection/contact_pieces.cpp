// SPDX-License-Identifier: MIT
// Vertices of pieces against faces of others, swept through the step.
#include "mechanics/contact/detection/contact_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/detection/face_touch.hpp"
#include "mechanics/contact/detection/fitting_normal.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// A tetrahedron as the step begins, and how it moves.
struct Hull {
  std::array<Vec3, 4> normal, corner;  ///< of each face: unit, outward; one of its corners
  Vec3 way;                            ///< m, of the centre
  double spread = 0;                   ///< m: how much farther a corner may go than that
};

Hull hull_of(const StepPaths& paths, TetId t) {
  Hull hull;
  for (int place = 0; place < 4; ++place) {
    const auto x = places_at(paths, corners_of(paths, half_face(t, place)), 0);
    hull.normal[static_cast<std::size_t>(place)] = normal_of(x);
    hull.corner[static_cast<std::size_t>(place)] = x[0];
  }
  const Corners& corners = paths.corners[t.index()];
  hull.way =
      centre_of(corners, paths.predicted) - centre_of(corners, paths.state.vertices.position);
  for (VertexId v : corners) {
    hull.spread = std::max(hull.spread, (paths.at(v, 1) - paths.at(v, 0) - hull.way).norm());
  }
  return hull;
}

/// A vertex and a component that it begins on or in.
struct Resting {
  VertexId vertex;
  ComponentId component;
  bool is_inside = false;
  friend constexpr auto operator<=>(const Resting&, const Resting&) = default;
};

/// Pairs that may meet: corners of obstacles with all pieces, vertices with other pieces.
bool move_against_each_other(const DetectScratch& scratch, const StepPaths& paths,
                             const SpherePair& pair) {
  if (paths.is_corner(pair.vertex)) {
    return paths.is_inside(paths.state.elements.component[pair.tetrahedron.index()]);
  }
  return !scratch.surface.ring_of(pair.vertex).empty() &&
         paths.may_meet(paths.state.vertices.component[pair.vertex.index()],
                        paths.state.elements.component[pair.tetrahedron.index()]);
}

/// Adds `make(face)` for every face of the pair's tetrahedron that is `near` and on the surface,
/// where it gives a touch.
template <class Make>
void add_touches(std::vector<FaceTouch>& touches, const DetectScratch& scratch,
                 const StepPaths& paths, const SpherePair& pair, const std::array<bool, 4>& near,
                 Make make) {
  for (int place = 0; place < 4; ++place) {
    const auto i = static_cast<std::size_t>(place);
    if (!near[i] || !paths.neighbours[pair.tetrahedron.index()][i].is_none()) continue;
    std::optional<FaceTouch> touch = make(half_face(pair.tetrahedron, place));
    if (!touch) continue;
    touch->are_partners = faces(scratch, pair, paths);
    touches.push_back(*touch);
  }
}

/// Vertices outside with every face of the tetrahedra that they could reach: at the start they are
/// no farther from it than twice their relative motion. Gives the vertices that begin inside or
/// within `band` (m) of the surface, sorted.
std::vector<Resting> gather_swept(std::vector<FaceTouch>& touches, const DetectScratch& scratch,
                                  const StepPaths& paths, double band) {
  std::vector<Resting> resting;
  if (scratch.pairs.empty()) return {};
  TetId last = scratch.pairs.front().tetrahedron;
  Hull hull = hull_of(paths, last);
  for (const SpherePair& pair : scratch.pairs) {
    const auto [t, v] = pair;
    if (t != last) hull = hull_of(paths, t);
    last = t;
    const Vec3& from = paths.at_start(v);
    const double motion = (paths.at_end(v) - from - hull.way).norm() + hull.spread;
    const double reach = 2 * motion + on_face * scratch.radius[t.index()];
    double gap = -std::numeric_limits<double>::infinity();
    std::array<bool, 4> near{};
    for (std::size_t i = 0; i < 4; ++i) {
      const double gap_of_face = hull.normal[i].dot(from - hull.corner[i]);
      near[i] = std::abs(gap_of_face) <= reach;
      gap = std::max(gap, gap_of_face);
    }
    if (!(gap <= std::max(reach, band))) continue;
    const ComponentId other = paths.state.elements.component[t.index()];
    if (gap <= band) resting.push_back({v, other, gap < 0});
    if (gap < 0) continue;
    // Boxes on long ways find farther touches or not, by how they lie to the axes.
    const double farthest = scratch.beside_share * scratch.radius[t.index()];
    add_touches(touches, scratch, paths, pair, near, [&](HalfFaceId face) {
      std::optional<FaceTouch> touch = swept_touch(paths, v, face);
      if (touch && std::min(touch->gap_start, touch->gap_end) > farthest) touch.reset();
      return touch;
    });
  }
  sort_unique(resting);
  return resting;
}

/// Those with every face that is near them: they may lie behind another tetrahedron's.
void gather_resting(std::vector<FaceTouch>& touches, const DetectScratch& scratch,
                    const StepPaths& paths, const std::vector<Resting>& resting, double band) {
  if (resting.empty()) return;
  std::vector<char> any(paths.state.vertices.size() + paths.corner.size());
  for (const Resting& r : resting) {
    any[r.vertex.index()] = 1;
    if (r.is_inside) touches.push_back({.vertex = r.vertex, .component = r.component});
  }
  for (const SpherePair& pair : scratch.pairs) {
    const VertexId v = pair.vertex;
    if (!any[v.index()]) continue;
    const ComponentId id = paths.state.elements.component[pair.tetrahedron.index()];
    const bool is_inside = std::ranges::binary_search(resting, Resting{v, id, true});
    if (!is_inside && !std::ranges::binary_search(resting, Resting{v, id, false})) continue;
    add_touches(touches, scratch, paths, pair, {true, true, true, true},
                [&](HalfFaceId face) { return resting_touch(paths, v, face, band, is_inside); });
  }
}

/// Of a vertex deep inside a component: the face of all its surface that it is nearest to.
std::optional<FaceTouch> way_out(const StepPaths& paths, VertexId v, ComponentId id) {
  std::optional<FaceTouch> nearest;
  double least = std::numeric_limits<double>::infinity();
  const Vec3 from = paths.at(v, 0);
  for (TetId t : paths.state.components[id.index()].tetrahedra) {
    for (int place = 0; place < 4; ++place) {
      if (!paths.neighbours[t.index()][static_cast<std::size_t>(place)].is_none()) continue;
      const auto c = corners_of(paths, half_face(t, place));
      const Vec3 middle = (paths.at(c[0], 0) + paths.at(c[1], 0) + paths.at(c[2], 0)) / 3;
      const double distance = (middle - from).squaredNorm();
      if (!(distance < least)) continue;
      const std::optional<FaceTouch> touch = resting_touch(paths, v, half_face(t, place), 0, true);
      if (!touch) continue;
      least = distance;
      nearest = touch;
    }
  }
  return nearest;
}

/// Of the touches of a vertex that begins on or in a component the nearest: one that does not fit
/// must be clearly nearer. `band`, m: how far from a face is still on it; on several, as at a
/// corner, that one counts from which the vertex ends farthest.
const FaceTouch* nearest_rest(std::span<const FaceTouch> touches, const StepPaths& paths,
                              const PieceSurface& surface, double band) {
  const FaceTouch* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const FaceTouch& touch : touches) {
    if (touch.is_swept || touch.face.is_none()) continue;
    const double depth = std::max(0.0, -touch.gap_start - band) +
                         (fits(touch, paths, surface) ? 0 : 0.01 * touch.size);
    if (best && std::pair(depth, -touch.gap_end) >= std::pair(least, -best->gap_end)) continue;
    best = &touch;
    least = depth;
  }
  return best;
}

/// Supports of vertices as the step begins.
struct Supports {
  std::span<const ContactPoint> on_obstacles;
  std::span<const FaceTouch> on_pieces;  ///< sorted by vertex
  double rim = 0;                        ///< m

  /// Whether a vertex, or the component that it comes to by a corner, rests on a plane with this
  /// normal out of that component.
  bool lie_flush(const FaceTouch& touch, const StepPaths& paths, const Vec3& normal) const {
    constexpr double same = 0.999;
    const bool on_obstacle = std::ranges::any_of(on_obstacles, [&](const ContactPoint& c) {
      if (c.vertex.is_none() || c.gap_start > rim) return false;
      if (c.vertex == touch.vertex) return c.normal.dot(normal) > same;
      return component_of_a(c, paths.state) == touch.component && c.normal.dot(normal) < -same;
    });
    if (on_obstacle) return true;
    const auto own = std::ranges::equal_range(on_pieces, touch.vertex, {}, &FaceTouch::vertex);
    return std::ranges::any_of(own, [&](const FaceTouch& rest) {
      return !rest.is_swept && !rest.face.is_none() && rest.component != touch.component &&
             rest.gap_start <= rim && rest.normal.dot(normal) > same;
    });
  }
};

/// Whether a vertex that meets a face on its way does so within `rim` of one of its edges, ends no
/// deeper behind the face beyond, and something rests flush with that: it slides over the edge.
bool grazes(const FaceTouch& touch, const StepPaths& paths, const PieceSurface& surface,
            const Supports& supports) {
  if (!(touch.gap_start > 0)) return false;
  const auto row = static_cast<std::size_t>(std::ranges::lower_bound(surface.faces, touch.face) -
                                            surface.faces.begin());
  const std::array<VertexId, 3> corners = corners_of(paths, touch.face);
  const std::array<Vec3, 3> x = places_at(paths, corners, touch.part);
  const Vec3 at = touch.foot[0] * x[0] + touch.foot[1] * x[1] + touch.foot[2] * x[2];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = (x[(k + 1) % 3] - x[k]).normalized();
    const SurfaceEdge& edge = surface.edges[surface.face_edges[row][k]];
    if ((at - x[k]).cross(along).norm() > supports.rim || edge.face[1].is_none()) continue;
    const HalfFaceId beyond = edge.face[edge.face[0] == touch.face ? 1 : 0];
    const std::array<Vec3, 3> y = places_at(paths, corners_of(paths, beyond), 1);
    const Vec3 normal = normal_of(y);
    const bool is_convex = normal.dot(paths.at_end(corners[(k + 2) % 3]) - y[0]) < 0;
    const bool slides = normal.dot(paths.at_end(touch.vertex) - y[0]) >= -supports.rim;
    if (is_convex && slides && supports.lie_flush(touch, paths, normal)) return true;
  }
  return false;
}

/// Of the touches of a vertex on its way the one that it ends deepest behind, those that fit first.
const FaceTouch* deepest_on_way(std::span<const FaceTouch> touches, const StepPaths& paths,
                                const PieceSurface& surface, const Supports& supports) {
  const FaceTouch* best = nullptr;
  bool best_fits = false;
  for (const FaceTouch& touch : touches) {
    if (!touch.is_swept || touch.are_partners || grazes(touch, paths, surface, supports)) continue;
    const bool now = fits(touch, paths, surface);
    if (best && std::pair(!now, touch.gap_end) >= std::pair(!best_fits, best->gap_end)) continue;
    best = &touch;
    best_fits = now;
  }
  return best;
}

/// Of the touches of one vertex with one component the one that counts, if any.
std::optional<FaceTouch> choose(std::span<const FaceTouch> touches, const StepPaths& paths,
                                const PieceSurface& surface, const Supports& supports,
                                double band) {
  const auto if_any = [](const FaceTouch* touch) {
    return touch ? std::optional(*touch) : std::nullopt;
  };
  const bool is_inside = touches.front().face.is_none() || touches.back().face.is_none();
  const FaceTouch* rest = nearest_rest(touches, paths, surface, band);
  if (rest && rest->are_partners) return std::nullopt;
  // Vertices that stay together during a fall will press once the lowest is stopped.
  constexpr double together = 0.01;
  if (rest && (is_inside || is_near(paths, *rest) || rest->gap_end <= together * band)) {
    return *rest;
  }
  if (!is_inside) return if_any(deepest_on_way(touches, paths, surface, supports));
  return way_out(paths, touches.front().vertex, touches.front().component);
}

/// How far the face of second order bulges at the touched place, m, along the normal:
/// touches are found on the flat triangle between its corners.
double bulge_at(const ContactPoint& contact, const Corners& corners, const TouchedNodes& touched,
                std::span<const Vec3> positions) {
  Vec3 flat = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) flat += contact.weights[i] * positions[corners[i].index()];
  return contact.normal.dot(touched.sum(positions) - flat);
}

void add(DetectScratch& scratch, const StepPaths& paths, const FaceTouch& touch, double friction) {
  ContactPoint contact;
  contact.friction = friction;
  if (paths.is_corner(touch.vertex)) {
    const CornerPath& corner = paths.corner_of(touch.vertex);
    contact.ball = corner.obstacle;
    contact.corner = corner.corner;
    contact.friction = 0.5 * (friction + paths.obstacles[corner.obstacle].friction);
  } else {
    contact.vertex = touch.vertex;
  }
  contact.tetrahedron = tetrahedron_of(touch.face);
  contact.place = static_cast<std::uint8_t>(place_of(touch.face));
  contact.normal = touch.normal;
  contact.gap_start = touch.gap_start;
  std::array<double, 4> weights{};
  double sum = 0;
  const auto& places = outward_face[static_cast<std::size_t>(place_of(touch.face))];
  for (std::size_t k = 0; k < 3; ++k) {
    weights[places[k]] = std::clamp(touch.foot[k], 0.0, 1.0);
    sum += weights[places[k]];
  }
  for (double& w : weights) w /= sum;
  contact.weights = weights_on(contact, weights, paths);
  double gap_end = touch.gap_end;
  if (is_second_order(paths.state.elements, contact.tetrahedron)) {
    const Corners& corners = paths.corners[contact.tetrahedron.index()];
    const TouchedNodes touched = touched_nodes(contact, paths.state, paths.corners);
    contact.gap_start -= bulge_at(contact, corners, touched, paths.state.vertices.position);
    gap_end -= bulge_at(contact, corners, touched, paths.predicted);
  }
  add_found(scratch, paths, contact, gap_end);
}

/// The node that the foot of a touch is, or none().
VertexId foot_node(const FaceTouch& touch, const StepPaths& paths) {
  constexpr double rounding = 1e-6;
  const auto is = [&](std::size_t k, double share) {
    return std::abs(touch.foot[k] - share) < rounding;
  };
  const TetId t = tetrahedron_of(touch.face);
  const auto& places = outward_face[static_cast<std::size_t>(place_of(touch.face))];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (touch.foot[k] > 1 - rounding) return paths.corners[t.index()][places[k]];
    if (!is_second_order(paths.state.elements, t) || !is(k, 0.5) || !is(next, 0.5)) continue;
    const auto edge = static_cast<std::size_t>(edge_between(places[k], places[next]));
    return paths.state.elements.edge_nodes[t.index()][edge];
  }
  return VertexId::none();
}

/// Whether a node lies on a lower one that lies on it, face to face: the two touches are one.
bool is_mirror(const FaceTouch& touch, std::span<const FaceTouch> all, const StepPaths& paths) {
  const VertexId other = foot_node(touch, paths);
  if (other.is_none() || touch.vertex < other) return false;
  const auto of_other = std::ranges::equal_range(all, other, {}, &FaceTouch::vertex);
  return std::ranges::any_of(of_other, [&](const FaceTouch& mirror) {
    return foot_node(mirror, paths) == touch.vertex && mirror.normal.dot(touch.normal) < -0.9;
  });
}

}  // namespace

void find_between_pieces(DetectScratch& scratch, const StepPaths& paths,
                         const ContactSettings& settings, bool among_pieces) {
  pair_up(scratch, paths);
  std::erase_if(scratch.pairs, [&](const SpherePair& p) {
    if (!among_pieces && !paths.is_corner(p.vertex)) return true;
    return !move_against_each_other(scratch, paths, p);
  });
  std::vector<FaceTouch> touches, chosen;
  const double band = settings.allowed_penetration;
  gather_resting(touches, scratch, paths, gather_swept(touches, scratch, paths, band), band);
  const auto key = [](const FaceTouch& t) {
    return std::tuple(t.vertex, t.component, t.face, t.is_swept);
  };
  std::ranges::sort(touches, {}, key);
  const Supports supports{scratch.found, touches, rim_of(settings)};
  for (std::size_t first = 0; first < touches.size();) {
    std::size_t end = first;
    while (end < touches.size() && touches[end].vertex == touches[first].vertex &&
           touches[end].component == touches[first].component) {
      ++end;
    }
    const std::optional<FaceTouch> best = choose(std::span(touches).subspan(first, end - first),
                                                 paths, scratch.surface, supports, band);
    if (best) chosen.push_back(*best);
    if (best) turn_to_fit(chosen.back(), paths, scratch.surface, supports.rim);
    first = end;
  }
  for (const FaceTouch& touch : chosen) {
    if (!is_mirror(touch, chosen, paths)) add(scratch, paths, touch, settings.friction);
  }
}

}  // namespace sunder

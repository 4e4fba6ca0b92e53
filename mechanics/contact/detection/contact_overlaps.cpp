// SPDX-License-Identifier: MIT
// Overlaps as a step ends, by separating axes.
#include "mechanics/contact/detection/contact_overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/manifold.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {
namespace {

/// Share of an edge: such an overlap is left alone between tetrahedra with crack faces that face
/// each other.
constexpr double facing_overlap = 0.01;
/// m: the overlap that is left alone, by the edge at hand. A first look takes a thousandth of it
/// and more; later ones take five thousandths and more, since solved contacts bear the rest.
double least_overlap(const ContactSettings& settings, std::uint8_t pass, double edge) {
  const double share = pass <= 2 ? 1e-3 : 5e-3;
  return 2 * settings.allowed_penetration + share * edge;
}

/// Adds a contact that ends with a gap, m.
void add_with_gap(DetectScratch& scratch, const StepPaths& paths, ContactPoint contact,
                  double gap_end) {
  const ContactPath path = path_of(contact, paths);
  contact.gap_start = gap_end + contact.normal.dot(path.start - path.end);
  add_found(scratch, paths, contact, gap_end);
}

/// Shares of the corners in a point of a tetrahedron's surface: the least is none.
std::array<double, 4> on_surface(const Places& x, const Vec3& point) {
  std::array<double, 4> shares = nearest_point(x, point);
  double& least = *std::ranges::min_element(shares);
  const double sum = 1 - least;
  least = 0;
  for (double& share : shares) share /= sum;
  return shares;
}

/// One point of the patch between two tetrahedra as a contact.
void add(DetectScratch& scratch, const StepPaths& paths, TetId a, TetId b, const Vec3& normal,
         const Manifold::Point& point, std::uint8_t pass, std::uint8_t number, double friction) {
  ContactPoint contact;
  contact.tetrahedron_a = a;
  contact.tetrahedron = b;
  contact.place_a = static_cast<std::uint8_t>(ContactPoint::overlap_place + pass);
  contact.place = static_cast<std::uint8_t>(ContactPoint::overlap_place + number);
  contact.weights_a = on_surface(places_at_end(paths, a), point.on_a);
  contact.weights = weights_on(contact, on_surface(places_at_end(paths, b), point.on_b), paths);
  contact.normal = normal;
  contact.friction = friction;
  add_with_gap(scratch, paths, contact, point.separation);
}

/// Overlaps of a ball with pieces as the step ends.
void find_ball_overlaps(DetectScratch& scratch, const StepPaths& paths, const BallWay& ball,
                        const ContactSettings& settings, std::uint8_t pass) {
  for_each_near(scratch.solid_pairs, ball, [&](TetId t) {
    const Places x = places_at_end(paths, t);
    const Manifold patch =
        collide_ball(ball.end, ball.radius, make_tetrahedron(x, outer_faces(paths, t)), {});
    if (patch.count == 0) return;
    const double least = least_overlap(settings, pass, std::min(mean_edge(x), ball.radius));
    if (!(patch.point[0].separation < -least)) return;
    ContactPoint contact;
    contact.ball = ball.row;
    contact.tetrahedron = t;
    contact.place = static_cast<std::uint8_t>(ContactPoint::overlap_place + pass);
    contact.weights = weights_on(contact, on_surface(x, patch.point[0].on_b), paths);
    contact.normal = patch.normal;
    contact.friction = 0.5 * (settings.friction + paths.obstacles[ball.row].friction);
    add_with_gap(scratch, paths, contact, patch.point[0].separation);
  });
}

/// Whether two tetrahedra begin so deep in each other that no contact of this step made it: bodies
/// of a scene that overlap, or pieces as waves left them. Vertices and faces push them apart.
bool begins_inside(const StepPaths& paths, TetId a, TetId b) {
  const Places p = places_of(paths.corners[a.index()], paths);
  const Places q = places_of(paths.corners[b.index()], paths);
  constexpr double deep = 0.05;
  const double least = -deep * std::min(mean_edge(p), mean_edge(q));
  return common_gap(p, q, p, q, least) < least;
}

/// m: how far the boxes of two tetrahedra are apart as the step ends; negative where they overlap.
double boxes_apart(const StepPaths& paths, TetId a, TetId b) {
  const Bounds p = sunder::bounds_of(places_at_end(paths, a));
  const Bounds q = sunder::bounds_of(places_at_end(paths, b));
  return (p.low - q.high).cwiseMax(q.low - p.high).maxCoeff();
}

/// Two tetrahedra that may overlap as the step ends, and the axis that decided them last. Gives how
/// much nearer they may come before they do, m.
double find_overlap(DetectScratch& scratch, const StepPaths& paths, const ContactSettings& settings,
                    std::uint8_t pass, TetId a, TetId b, PairAxis& axis) {
  const Places x = places_at_end(paths, a), y = places_at_end(paths, b);
  const Polytope one = make_tetrahedron(x, outer_faces(paths, a));
  const Polytope other = make_tetrahedron(y, outer_faces(paths, b));
  const Manifold patch = collide(one, other, {}, axis);
  if (patch.count == 0) return separation_along(one, other, axis);
  const double edge = std::min(mean_edge(x), mean_edge(y));
  double least = least_overlap(settings, pass, edge);
  // Crack faces hold these apart, as far as they face each other still.
  const bool are_facing = are_partners(scratch, paths, a, b);
  if (are_facing) least = std::max(least, facing_overlap * edge);
  const auto count = static_cast<std::size_t>(patch.count);
  double lowest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    lowest = std::min(lowest, patch.point[k].separation);
  }
  if (lowest >= -least) return are_facing ? least + lowest : 0;
  if (begins_inside(paths, a, b)) return 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (patch.point[k].separation >= 0) continue;
    add(scratch, paths, a, b, patch.normal, patch.point[k], pass, static_cast<std::uint8_t>(k),
        settings.friction);
  }
  return 0;
}

/// Overlaps of pieces as the step ends.
void find_solid_overlaps(DetectScratch& scratch, const StepPaths& paths,
                         const ContactSettings& settings, std::uint8_t pass) {
  update_near(scratch, paths);
  if (!keeps_pairs(scratch, paths)) {
    pair_at_end(scratch, paths);
    for (const auto& [a, b] : scratch.swept) {
      if (boxes_apart(paths, TetId{a}, TetId{b}) > 0) continue;
      PairAxis axis;
      find_overlap(scratch, paths, settings, pass, TetId{a}, TetId{b}, axis);
    }
    return;
  }
  refresh_solids(scratch, paths);
  const Travel& travel = scratch.travel;
  std::vector<PairContacts> noted;
  for (NearPair& pair : scratch.near_solids.found) {
    if (!is_due(pair, travel)) continue;
    if (!paths.may_meet(ComponentId{pair.body_a}, ComponentId{pair.body_b})) continue;
    const TetId a{pair.a}, b{pair.b};
    double apart = boxes_apart(paths, a, b);
    if (apart <= 0) {
      const std::size_t first = scratch.found.size();
      apart = find_overlap(scratch, paths, settings, pass, a, b, pair.axis);
      note_contacts(noted, pair, scratch, first);
    }
    const double end = travel.end_of(pair.body_a, pair.body_b);
    // They are as far apart as the step ends, and began no nearer than that less its ways.
    const double start = travel.start_of(pair.body_a, pair.body_b);
    pair.quiet = start + std::clamp(apart, 0.0, scratch.mean_edge) - (end - start);
  }
  sort_contacts(scratch, noted);
}

}  // namespace

void find_overlaps(DetectScratch& scratch, const StepPaths& paths, const ContactSettings& settings,
                   std::uint8_t pass) {
  find_solid_overlaps(scratch, paths, settings, pass);
  const std::vector<BallWay> balls = moving_balls(paths);
  if (!balls.empty()) box_at_end(scratch, paths);
  for (BallWay ball : balls) {
    ball.start = ball.end;
    find_ball_overlaps(scratch, paths, ball, settings, pass);
  }
}

}  // namespace sunder

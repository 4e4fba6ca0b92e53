// SPDX-License-Identifier: MIT
// Boxes, pairs, manifolds, and the impulses of the same manifolds in the last tick.
#include "mechanics/rubble/rubble_find.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/frame/rotation.hpp"
#include "mechanics/rubble/merge_patches.hpp"
#include "mechanics/rubble/rubble.hpp"
#include "mechanics/rubble/rubble_partners.hpp"
#include "mechanics/solver/parallel.hpp"

namespace sunder {
namespace {

using Kind = RubbleShape::Kind;

Vec3 centre_of(const RubbleShape& shape, const MovingBody& body) {
  return body.centre + body.turned * shape.corner[0];
}

bool is_free(const RubbleBody& body) { return body.mass > 0 && !body.asleep; }

/// How a body goes on in the time.
FindScratch::Turn turn_of(const FindInput& input, std::uint32_t row) {
  const MovingBody& body = input.moving[row];
  FindScratch::Turn turn;
  turn.way = input.time * body.velocity;
  if (!is_free(input.bodies[row])) return turn;
  turn.way += input.time * input.time * input.settings.gravity;
  turn.turn = input.time * body.spin;
  const double angle = turn.turn.norm();
  if (angle == 0) return turn;
  turn.chord = rotation_of(turn.turn).toRotationMatrix();
  turn.chord -= Mat3::Identity();
  return turn;
}

/// Adds the effect of turning to the way of a part with its centre at `arm`, and to its reach
/// across the way. The latter is the height of the arc over its chord, and turning about its own
/// centre.
void add_turn(Vec3& way, double& beside, const FindScratch::Turn& turn, const Vec3& arm,
              double radius) {
  way += turn.chord * arm;
  beside = 0.125 * turn.turn.squaredNorm() * arm.norm() + std::min(0.5, turn.turn.norm()) * radius;
}

Bounds box_of(const RubbleShape& shape, const MovingBody& body, const Polytope& solid) {
  if (shape.kind == Kind::half_space) {
    const Vec3 all = Vec3::Constant(std::numeric_limits<double>::max());
    return {-all, all};
  }
  if (shape.kind == Kind::ball) {
    const Vec3 r = Vec3::Constant(shape.radius);
    return {centre_of(shape, body) - r, centre_of(shape, body) + r};
  }
  Bounds bounds{solid.vertex[0], solid.vertex[0]};
  for (std::size_t v = 1; v < solid.kind->vertices; ++v) {
    bounds.low = bounds.low.cwiseMin(solid.vertex[v]);
    bounds.high = bounds.high.cwiseMax(solid.vertex[v]);
  }
  return bounds;
}

/// A point of a solid against a half-space or ball, for both of which `normal` is out of B.
void add_point(Manifold& m, const Vec3& on_a, const Vec3& on_b, double separation) {
  if (m.count == 4) {
    // Of a box on a plane: the four deepest.
    auto* highest = &m.point[0];
    for (Manifold::Point& p : m.point) {
      if (p.separation > highest->separation) highest = &p;
    }
    if (highest->separation > separation) *highest = {on_a, on_b, separation};
    return;
  }
  m.point[static_cast<std::size_t>(m.count++)] = {on_a, on_b, separation};
}

Manifold on_half_space(const FindInput& input, std::uint32_t a, std::uint32_t plane,
                       const Polytope& solid, const Approach& approach) {
  const RubbleShape& shape = input.shapes[a];
  const RubbleShape& half = input.shapes[plane];
  const MovingBody& ground = input.moving[half.body];
  Manifold m;
  m.normal = ground.turned * half.normal;
  const auto try_point = [&](const Vec3& at) {
    const double separation = m.normal.dot(at - ground.centre);
    if (separation > approach.along(-m.normal)) return;
    add_point(m, at, at - separation * m.normal, separation);
  };
  if (shape.kind == Kind::ball) {
    const Vec3 lowest = centre_of(shape, input.moving[shape.body]) - shape.radius * m.normal;
    try_point(lowest);
    return m;
  }
  for (std::uint32_t v = 0; v < solid.kind->vertices; ++v) try_point(solid.vertex[v]);
  return m;
}

Manifold between_balls(const FindInput& input, std::uint32_t a, std::uint32_t b,
                       const Approach& approach) {
  const RubbleShape& p = input.shapes[a];
  const RubbleShape& q = input.shapes[b];
  const Vec3 from = centre_of(q, input.moving[q.body]), to = centre_of(p, input.moving[p.body]);
  Manifold m;
  const double distance = (to - from).norm();
  m.normal = distance > 0 ? Vec3((to - from) / distance) : Vec3(0, 0, 1);
  const double separation = distance - p.radius - q.radius;
  if (separation <= approach.along(-m.normal)) {
    add_point(m, to - p.radius * m.normal, from + q.radius * m.normal, separation);
  }
  return m;
}

Approach turned_round(const Approach& approach) { return {-approach.way, approach.margin}; }

Manifold turned_round(Manifold m) {
  m.normal = -m.normal;
  for (Manifold::Point& p : m.point) std::swap(p.on_a, p.on_b);
  return m;
}

/// The manifold of a pair of shapes, A the first.
Manifold manifold_of(const FindInput& input, const FindScratch& scratch, const RowPair& pair,
                     const Approach& approach, PairAxis& axis) {
  const auto [a, b] = pair;
  const Kind p = input.shapes[a].kind, q = input.shapes[b].kind;
  const auto& solids = scratch.solids;
  if (q == Kind::half_space) {
    return p == Kind::half_space ? Manifold{} : on_half_space(input, a, b, solids[a], approach);
  }
  if (p == Kind::half_space)
    return turned_round(on_half_space(input, b, a, solids[b], turned_round(approach)));
  if (p == Kind::ball && q == Kind::ball) return between_balls(input, a, b, approach);
  const auto ball = [&](std::uint32_t row, std::uint32_t other, const Approach& its) {
    const RubbleShape& shape = input.shapes[row];
    return collide_ball(centre_of(shape, input.moving[shape.body]), shape.radius, solids[other],
                        its);
  };
  if (p == Kind::ball) return ball(a, b, approach);
  if (q == Kind::ball) return turned_round(ball(b, a, turned_round(approach)));
  return collide(solids[a], solids[b], approach, axis);
}

Vec3 any_across(const Vec3& n) {
  const Vec3 axis = std::abs(n[0]) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  return n.cross(axis).normalized();
}

/// Walks axes along with pairs that are sorted by the same keys.
class Walk {
 public:
  using Row = FindScratch::Axis;
  Walk(const std::vector<Row>& rows, std::uint64_t a, std::uint64_t b)
      : at_(std::lower_bound(rows.begin(), rows.end(), std::pair(a, b), is_before)),
        end_(rows.end()) {}
  /// The row of the pair, or null. Needs: pairs in rising order.
  const Row* find(std::uint64_t a, std::uint64_t b) {
    while (at_ != end_ && is_before(*at_, std::pair(a, b))) ++at_;
    return at_ != end_ && at_->a == a && at_->b == b ? &*at_ : nullptr;
  }

 private:
  static bool is_before(const Row& row, const std::pair<std::uint64_t, std::uint64_t>& keys) {
    return std::pair(row.a, row.b) < keys;
  }
  std::vector<Row>::const_iterator at_, end_;
};

/// m; infinite for bodies without mass.
double radius_of(const FindInput& input, std::uint32_t body) {
  const RubbleBody& b = input.bodies[body];
  return b.mass > 0 ? b.radius : std::numeric_limits<double>::infinity();
}

/// Impulses of points in the last tick: of the nearest points of the same two shapes, each used
/// once.
void take_memory(RubblePatch& patch, const FindInput& input, const RubbleMemory& memory) {
  const auto key_of = [](const RubbleMemory::Point& q) { return std::pair(q.a, q.b); };
  std::vector<const RubbleMemory::Point*> used;
  const double near = 0.2 * std::min(radius_of(input, patch.a), radius_of(input, patch.b));
  for (std::size_t k = 0; k < static_cast<std::size_t>(patch.count); ++k) {
    RubblePatch::Point& p = patch.point[k];
    const std::pair key(input.shapes[p.shape_a].key, input.shapes[p.shape_b].key);
    const RubbleMemory::Point* nearest = nullptr;
    double least = near * near;
    for (const auto& q : std::ranges::equal_range(memory.points, key, {}, key_of)) {
      const double distance = (q.at - p.local_a).squaredNorm();
      if (distance > least || std::ranges::find(used, &q) != used.end()) continue;
      least = distance;
      nearest = &q;
    }
    if (!nearest) continue;
    used.push_back(nearest);
    p.impulse = nearest->force;
    patch.slip_impulse[0] += nearest->friction.dot(patch.along);
    patch.slip_impulse[1] += nearest->friction.dot(patch.across);
    patch.twist_impulse += nearest->twist;
  }
}

}  // namespace

Approach approach_of(const FindScratch& scratch, const FindInput& input, const RowPair& pair) {
  // At the centre of the smaller one: a part that turns with the other comes no nearer.
  const auto [i, j] = pair;
  const std::uint32_t small = scratch.radius[i] < scratch.radius[j] ? i : j;
  const Vec3& at = scratch.centre[small];
  const std::uint32_t a = scratch.body[i], b = scratch.body[j];
  const auto way = [&](std::uint32_t body) -> Vec3 {
    const FindScratch::Turn& turn = scratch.turns[body];
    return turn.way + turn.chord * (at - input.moving[body].centre);
  };
  const auto bend = [&](std::uint32_t body) -> Vec3 {
    const Vec3& spin = scratch.turns[body].turn;
    return spin.cross(spin.cross(at - input.moving[body].centre));
  };
  const double turning = (scratch.turns[a].turn - scratch.turns[b].turn).norm();
  // An arc is that high over its chord.
  const double arc = 0.125 * (bend(a) - bend(b)).norm();
  return {way(a) - way(b),
          std::min(0.5, turning) * scratch.radius[small] + arc + 2 * input.settings.slop};
}

RubblePatch patch_of(const FindInput& input, const RowPair& pair, const Manifold& manifold) {
  // One side for all patches of two bodies.
  if (input.shapes[pair.first].body > input.shapes[pair.second].body) {
    return patch_of(input, {pair.second, pair.first}, turned_round(manifold));
  }
  RubblePatch patch;
  patch.a = input.shapes[pair.first].body;
  patch.b = input.shapes[pair.second].body;
  patch.normal = manifold.normal;
  patch.along = any_across(manifold.normal);
  patch.across = manifold.normal.cross(patch.along);
  patch.friction = 0.5 * (input.bodies[patch.a].friction + input.bodies[patch.b].friction);
  patch.count = manifold.count;
  const MovingBody& a = input.moving[patch.a];
  const MovingBody& b = input.moving[patch.b];
  for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k) {
    RubblePatch::Point& point = patch.point[k];
    point.local_a = a.turned.transpose() * (manifold.point[k].on_a - a.centre);
    point.local_b = b.turned.transpose() * (manifold.point[k].on_b - b.centre);
    point.separation = manifold.point[k].separation;
    point.shape_a = pair.first;
    point.shape_b = pair.second;
  }
  return patch;
}

void find_pairs(FindScratch& scratch, const FindInput& input) {
  const std::size_t bodies = input.bodies.size(), shapes = input.shapes.size();
  scratch.moves.resize(bodies);
  scratch.turns.resize(bodies);
  for (std::size_t k = 0; k < bodies; ++k) {
    const RubbleBody& body = input.bodies[k];
    scratch.moves[k] = is_free(body) || (body.mass == 0 && !body.velocity.isZero(0));
    scratch.turns[k] = turn_of(input, static_cast<std::uint32_t>(k));
  }
  scratch.boxes.resize(shapes);
  scratch.solids.resize(shapes);
  scratch.body.resize(shapes);
  scratch.ways.resize(shapes);
  scratch.centre.resize(shapes);
  scratch.radius.resize(shapes);
  for (std::size_t k = 0; k < shapes; ++k) {
    const RubbleShape& shape = input.shapes[k];
    const std::uint32_t body = shape.body;
    scratch.body[k] = body;
    if (shape.kind != Kind::ball && shape.kind != Kind::half_space) {
      scratch.solids[k] = polytope_of(shape, input.moving[body].centre, input.moving[body].turned);
    }
    Bounds& box = scratch.boxes[k] = box_of(shape, input.moving[body], scratch.solids[k]);
    scratch.ways[k] = scratch.turns[body].way;
    scratch.radius[k] = std::numeric_limits<double>::infinity();
    if (shape.kind == Kind::half_space) continue;
    scratch.centre[k] = 0.5 * (box.low + box.high);
    scratch.radius[k] = 0.5 * (box.high - box.low).norm();
    double beside = 0;
    add_turn(scratch.ways[k], beside, scratch.turns[body],
             scratch.centre[k] - input.moving[body].centre, scratch.radius[k]);
    const Vec3 widen = Vec3::Constant(beside + input.settings.slop);
    box.low -= widen;
    box.high += widen;
  }
  find_box_pairs(scratch.pairs, scratch.grid,
                 {scratch.boxes, scratch.body, scratch.moves, scratch.ways});
  find_facing(scratch, input);
}

void find_patches(std::vector<RubblePatch>& patches, FindScratch& scratch, const FindInput& input,
                  const RubbleMemory& memory) {
  constexpr std::size_t chunk = 512;
  const std::size_t chunks = (scratch.pairs.size() + chunk - 1) / chunk;
  if (scratch.found.size() < chunks) scratch.found.resize(chunks);
  std::swap(scratch.axes, scratch.last_axes);
  scratch.axes.resize(scratch.pairs.size());
  parallel_for(input.settings.threads, chunks, [&](std::size_t c, unsigned) {
    std::vector<RubblePatch>& found = scratch.found[c];
    found.clear();
    const RowPair& first = scratch.pairs[c * chunk];
    const std::uint64_t key_a = input.shapes[first.first].key;
    const std::uint64_t key_b = input.shapes[first.second].key;
    Walk axes(scratch.last_axes, key_a, key_b);
    const std::size_t end = std::min(scratch.pairs.size(), (c + 1) * chunk);
    for (std::size_t row = c * chunk; row < end; ++row) {
      const auto [i, j] = scratch.pairs[row];
      const RubbleShape& p = input.shapes[i];
      const RubbleShape& q = input.shapes[j];
      if (touch_as_partners(scratch, input, scratch.pairs[row])) {
        scratch.axes[row] = {p.key, q.key, {}};
        continue;
      }
      const FindScratch::Axis* last = axes.find(p.key, q.key);
      FindScratch::Axis& axis = scratch.axes[row] = {p.key, q.key, last ? last->axis : PairAxis{}};
      const Approach approach = approach_of(scratch, input, scratch.pairs[row]);
      const Manifold m = manifold_of(input, scratch, scratch.pairs[row], approach, axis.axis);
      if (m.count == 0) continue;
      found.push_back(patch_of(input, scratch.pairs[row], m));
    }
  });
  patches.clear();
  add_partner_patches(patches, scratch, input);
  for (std::size_t c = 0; c < chunks; ++c) {
    patches.insert(patches.end(), scratch.found[c].begin(), scratch.found[c].end());
  }
  merge_patches(patches, input.moving);
  for (RubblePatch& patch : patches) take_memory(patch, input, memory);
}

}  // namespace sunder

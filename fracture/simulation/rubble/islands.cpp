// SPDX-License-Identifier: MIT
// Candidates, islands, certificates.
#include "fracture/simulation/rubble/islands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fracture/simulation/rubble/rubble_world.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/impact/impact_energy.hpp"
#include "mechanics/contact/shapes/box_pairs.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();

/// A node is a component, or a free obstacle ("ball") behind all components.
struct Nodes {
  const SimulationState& s;
  std::size_t components() const { return s.mechanics.components.size(); }
  std::size_t count() const { return components() + s.obstacles.size(); }
  bool is_ball(std::size_t node) const { return node >= components(); }
  const Obstacle& ball(std::size_t node) const { return s.obstacles[node - components()]; }
  const Component& component(std::size_t node) const { return s.mechanics.components[node]; }
  bool lives(std::size_t node) const {
    return is_ball(node) ? ball(node).mass.has_value() : !component(node).tetrahedra.empty();
  }
  bool sleeps(std::size_t node) const {
    return !is_ball(node) && component(node).rung == Rung::asleep;
  }
  double mass(std::size_t node) const {
    return is_ball(node) ? *ball(node).mass : component(node).mass;
  }
  Vec3 velocity(std::size_t node) const {
    if (is_ball(node)) return ball(node).velocity;
    const Component& c = component(node);
    return c.supported ? c.frame_velocity : Vec3(c.momentum / c.mass);
  }
};

/// Deformable bodies may become faster than now during the tick, by this factor.
constexpr double haste = 2;

std::vector<char> find_candidates(const Simulation& sim, const Nodes& nodes,
                                  const RubbleInput& input) {
  const SimulationState& s = *sim.state;
  std::vector<char> may(nodes.count(), 0);
  const bool certifies = sim.scene.fracture.node_stress != NodeStress::fit;
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    if (!nodes.lives(k)) continue;
    if (nodes.is_ball(k)) {
      may[k] = has_rubble_shape(nodes.ball(k));
      continue;
    }
    const Component& c = nodes.component(k);
    const bool is_open = k < s.impact.quiet.size() && s.impact.quiet[k] != ImpactWindow::closed;
    const bool cannot_break = input.threshold[k] == boundless || input.declared[k];
    may[k] = !c.supported && (cannot_break || (certifies && !is_open));
  }
  for (const CornerLoad& load : s.loads) {
    may[s.mechanics.elements.component[tetrahedron_of(load.corner).index()].index()] = 0;
  }
  for (const Tie& tie : s.contact.ties) {
    may[s.mechanics.elements.component[tetrahedron_of(tie.face).index()].index()] = 0;
  }
  return may;
}

/// Boxes of bodies that may meet, by node.
struct Reach {
  std::vector<Bounds> boxes;
  std::vector<std::uint32_t> node;
  void add(const Bounds& box, std::size_t of) {
    boxes.push_back(box);
    node.push_back(static_cast<std::uint32_t>(of));
  }
};

Bounds swept(Bounds box, const Vec3& way, double widen) {
  box.low += way.cwiseMin(0) - Vec3::Constant(widen);
  box.high += way.cwiseMax(0) + Vec3::Constant(widen);
  return box;
}

/// A ball round all that a node can reach in the tick, as a box.
Bounds bounds_of(const Nodes& nodes, std::size_t node, const Vec3& gravity, double tick) {
  const bool is_ball = nodes.is_ball(node);
  const Vec3 centre =
      is_ball ? pose_of(nodes.ball(node).shape).centre : nodes.component(node).centre;
  const double radius =
      is_ball ? radius_of(nodes.ball(node).shape) : 1.1 * nodes.component(node).rest_radius;
  const Vec3 way = nodes.sleeps(node)
                       ? Vec3::Zero()
                       : Vec3(haste * tick * (nodes.velocity(node) + tick * gravity));
  return swept({centre, centre}, way, radius);
}

/// Surface tetrahedra of a component along their ways.
void add_surface(Reach& reach, const SimulationState& s, const Component& c, const Vec3& gravity,
                 double tick) {
  const VertexColumns& vertices = s.mechanics.vertices;
  const bool sleeps = c.rung == Rung::asleep;
  for (TetId t : c.tetrahedra) {
    const auto& neighbours = s.cells.map.neighbours()[t.index()];
    if (std::ranges::none_of(neighbours, [](HalfFaceId f) { return f.is_none(); })) continue;
    const Corners& corners = s.cells.map.corners()[t.index()];
    Bounds box{Vec3::Constant(boundless), Vec3::Constant(-boundless)};
    for (VertexId v : corners) {
      const Vec3& x = vertices.position[v.index()];
      const Vec3 way = sleeps
                           ? Vec3::Zero()
                           : Vec3(haste * tick * (vertices.velocity[v.index()] + tick * gravity));
      box.low = box.low.cwiseMin(x).cwiseMin(x + way);
      box.high = box.high.cwiseMax(x).cwiseMax(x + way);
    }
    reach.add(box, c.id.index());
  }
}

/// Marks nodes that something awake could meet, be it through others that sleep.
std::vector<char> near_awake(const Nodes& nodes, const std::vector<char>& may, const Vec3& gravity,
                             double tick) {
  Reach coarse;
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    if (nodes.lives(k)) coarse.add(bounds_of(nodes, k, gravity, tick), k);
  }
  std::vector<RowPair> pairs;
  BoxScratch scratch;
  find_box_pairs(pairs, scratch, {coarse.boxes, coarse.node, may});
  UnionFind joined(nodes.count());
  std::vector<char> meets = may;
  for (const auto& [i, j] : pairs) {
    joined.join(coarse.node[i], coarse.node[j]);
    meets[coarse.node[i]] = meets[coarse.node[j]] = 1;
  }
  std::vector<char> awake(nodes.count(), 0), marked(nodes.count(), 0);
  for (const std::uint32_t k : coarse.node) {
    if (!nodes.sleeps(k)) awake[joined.root(k)] = 1;
  }
  for (const std::uint32_t k : coarse.node) marked[k] = meets[k] && awake[joined.root(k)];
  return marked;
}

/// Surfaces of those that are marked.
Reach reach_of(const SimulationState& s, const Nodes& nodes, const std::vector<char>& marked,
               const Vec3& gravity, double tick) {
  Reach fine;
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    if (!marked[k]) continue;
    if (nodes.is_ball(k)) {
      fine.add(bounds_of(nodes, k, gravity, tick), k);
    } else {
      add_surface(fine, s, nodes.component(k), gravity, tick);
    }
  }
  return fine;
}

/// All that is in an island.
struct Island {
  bool is_rubble = true;  ///< all in it may be
  bool has_candidate = false, is_awake = false;
  bool is_grounded = false, is_torn = false;
  bool meets_solid = false;
  std::uint32_t members = 0;
  Vec3 ground = Vec3::Zero();  ///< m/s, of driven obstacles nearby
  Vec3 momentum = Vec3::Zero();
  double mass = 0, kinetic = 0, strain = 0, fastest = 0;
};

/// J, of motion against `velocity`.
double kinetic_against(const SimulationState& s, const Nodes& nodes, std::size_t k,
                       const Vec3& velocity) {
  if (nodes.sleeps(k)) return 0.5 * nodes.mass(k) * velocity.squaredNorm();
  if (nodes.is_ball(k)) return kinetic_energy(nodes.ball(k), velocity);
  double energy = 0;
  for (VertexId v : nodes.component(k).vertices) {
    energy += 0.5 * s.mechanics.vertices.mass[v.index()] *
              (s.mechanics.vertices.velocity[v.index()] - velocity).squaredNorm();
  }
  return energy;
}

double fastest_of(const SimulationState& s, const Nodes& nodes, std::size_t k,
                  const Vec3& against) {
  if (nodes.sleeps(k)) return against.norm();
  if (nodes.is_ball(k)) {
    const Obstacle& ball = nodes.ball(k);
    return (ball.velocity - against).norm() + ball.spin.norm() * radius_of(ball.shape);
  }
  double fastest = 0;
  for (VertexId v : nodes.component(k).vertices) {
    fastest = std::max(fastest, (s.mechanics.vertices.velocity[v.index()] - against).norm());
  }
  return fastest;
}

/// Whether a node could touch a driven obstacle in the tick.
bool is_near(const Nodes& nodes, std::size_t k, const Obstacle& obstacle, const Vec3& gravity,
             double tick) {
  const Bounds bounds = bounds_of(nodes, k, gravity, tick);
  const Vec3 centre = 0.5 * (bounds.low + bounds.high);
  const double radius = 0.5 * (bounds.high - bounds.low).norm();
  return surface_distance(obstacle.shape, centre).gap <=
         radius + haste * tick * obstacle.velocity.norm();
}

/// If no active component can break or deforms for other reasons, no islands are needed.
bool all_are_safe(RubbleChoice& choice, const Nodes& nodes, const std::vector<char>& may,
                  const RubbleInput& input) {
  if (!std::ranges::all_of(nodes.s.obstacles, has_rubble_shape)) return false;
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    if (!nodes.lives(k) || nodes.is_ball(k)) continue;
    if (!may[k] || (input.threshold[k] < boundless && !input.declared[k])) return false;
  }
  bool any_awake = false;
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    any_awake = any_awake || (nodes.lives(k) && !nodes.is_ball(k) && !nodes.sleeps(k));
  }
  // If only balls are awake, islands decide which bodies they meet.
  if (!any_awake) return false;
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    if (!nodes.lives(k)) continue;
    (nodes.is_ball(k) ? choice.ball[k - nodes.components()] : choice.component[k]) = 1;
  }
  choice.any_awake = true;
  return true;
}

}  // namespace

RubbleChoice choose_rubble(const Simulation& sim, const RubbleInput& input) {
  const SimulationState& s = *sim.state;
  const auto& [threshold, declared, watched, gravity, tick] = input;
  const Nodes nodes{s};
  RubbleChoice choice;
  choice.component.assign(nodes.components(), 0);
  choice.ball.assign(s.obstacles.size(), 0);
  choice.island.assign(nodes.count(), RubbleChoice::no_island);
  const std::vector<char> may = find_candidates(sim, nodes, input);
  if (all_are_safe(choice, nodes, may, input)) return choice;
  const std::vector<char> marked = near_awake(nodes, may, gravity, tick);
  const Reach reach = reach_of(s, nodes, marked, gravity, tick);
  // Resting bodies are joined as well: a heap that sleeps is one island.
  const std::vector<char> all(nodes.count(), 1);
  BoxScratch scratch;
  UnionFind joined(nodes.count());
  join_bodies(joined, scratch, {reach.boxes, reach.node, all});

  std::vector<Island> islands(nodes.count());
  std::vector<std::uint32_t> members;
  for (const std::uint32_t node : reach.node) {
    if (members.empty() || members.back() != node) members.push_back(node);
  }
  const auto island_of = [&](std::uint32_t k) -> Island& { return islands[joined.root(k)]; };
  for (const std::uint32_t k : members) {
    Island& island = island_of(k);
    ++island.members;
    island.is_rubble = island.is_rubble && may[k];
    island.has_candidate = island.has_candidate || (may[k] && !nodes.is_ball(k));
    island.is_awake = island.is_awake || !nodes.sleeps(k);
    island.meets_solid =
        island.meets_solid || (nodes.is_ball(k) && !has_rubble_shape(nodes.ball(k)));
    if (!may[k]) continue;
    island.mass += nodes.mass(k);
    if (!nodes.sleeps(k)) island.momentum += nodes.mass(k) * nodes.velocity(k);
    for (const Obstacle& o : s.obstacles) {
      if (o.mass || !is_near(nodes, k, o, gravity, tick)) continue;
      island.meets_solid = island.meets_solid || !has_rubble_shape(o);
      island.is_rubble = island.is_rubble && has_rubble_shape(o);
      island.is_torn = island.is_torn || (island.is_grounded && o.velocity != island.ground);
      island.is_grounded = true;
      island.ground = o.velocity;
    }
  }
  for (const std::uint32_t k : members) {
    Island& island = island_of(k);
    if (!island.is_rubble) continue;
    const Vec3 against = island.is_grounded ? island.ground : Vec3(island.momentum / island.mass);
    island.kinetic += kinetic_against(s, nodes, k, against);
    island.fastest = std::max(island.fastest, fastest_of(s, nodes, k, against));
    if (!nodes.is_ball(k)) island.strain += deformation_energy(s.mechanics, nodes.component(k));
  }
  const double fall = tick * gravity.norm();
  // Then, whether each of its pieces is safe from all energy in it.
  for (const std::uint32_t k : members) {
    Island& island = island_of(k);
    if (!island.is_rubble || nodes.is_ball(k)) continue;
    if (threshold[k] == boundless || declared[k] || watched[k]) continue;
    const double weight = island.is_grounded ? island.mass * fall * (island.fastest + fall) : 0;
    const double spent = k < s.ladder.rubble.spent.size() ? s.ladder.rubble.spent[k] : 0;
    const double bound =
        island.is_torn ? boundless : island.kinetic + island.strain + weight + spent;
    if (bound < threshold[k]) continue;
    island.is_rubble = false;
    ++choice.refused;
  }
  // Bodies that sleep far from all awake bodies keep their state.
  const std::vector<char>& last = s.ladder.rubble.apart;
  for (std::size_t k = 0; k < std::min(last.size(), nodes.components()); ++k) {
    choice.component[k] = last[k] && !marked[k] && nodes.lives(k) && nodes.sleeps(k);
  }
  const auto is_calm = [&](std::uint32_t k) {
    const Rung rung = nodes.component(k).rung;
    return rung == Rung::rubble || rung == Rung::rigid;
  };
  std::vector<char> counted(nodes.count(), 0);
  for (const std::uint32_t k : members) {
    const Island& island = island_of(k);
    if (!island.is_rubble) {
      char& seen = counted[joined.root(k)];
      const bool is_new = island.has_candidate && !seen;
      (island.meets_solid ? choice.solids : choice.mixed) += is_new;
      seen = 1;
      continue;
    }
    // A lone ball stays with the elastic solver. So does a lone breakable piece that is calm
    // already.
    const bool is_alone = island.members == 1 && !island.is_grounded;
    if (!island.has_candidate ||
        (is_alone && !nodes.is_ball(k) && is_calm(k) && threshold[k] < boundless && !declared[k])) {
      continue;
    }
    (nodes.is_ball(k) ? choice.ball[k - nodes.components()] : choice.component[k]) = 1;
    choice.island[k] = joined.root(k);
    choice.any_awake = choice.any_awake || island.is_awake;
  }
  return choice;
}

}  // namespace sunder

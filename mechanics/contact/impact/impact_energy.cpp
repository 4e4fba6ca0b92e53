// SPDX-License-Identifier: MIT
// Islands of contacts, and the energy in them.
#include "mechanics/contact/impact/impact_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/element/energy.hpp"

namespace sunder {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double strain_energy(const MechanicsState& state, const Component& component) {
  double energy = 0;
  if (component.rigid) return energy;
  for (TetId t : component.tetrahedra) energy += element_strain_energy(state, t);
  return energy;
}

double kinetic_energy_of_rate(const MechanicsState& state, VertexId v) {
  return 0.5 * state.vertices.mass[v.index()] *
         state.vertices.displacement_rate[v.index()].squaredNorm();
}

}  // namespace

double deformation_energy(const MechanicsState& state, const Component& component) {
  double energy = strain_energy(state, component);
  for (VertexId v : component.vertices) energy += kinetic_energy_of_rate(state, v);
  return energy;
}

bool deforms_by(const MechanicsState& state, const Component& component, double least) {
  double energy = 0;
  for (VertexId v : component.vertices) {
    energy += kinetic_energy_of_rate(state, v);
    if (energy >= least) return true;
  }
  if (component.rigid) return false;
  for (TetId t : component.tetrahedra) {
    energy += element_strain_energy(state, t);
    if (energy >= least) return true;
  }
  return false;
}

ImpactEnergy::ImpactEnergy(const ContactStep& step, std::span<const ContactPoint> contacts)
    : step_(step), components_(step.pass.state.components.size()) {
  const MechanicsState& state = step.pass.state;
  nodes_.resize(components_ + step.pass.obstacles.size());
  joined_ = UnionFind(nodes_.size());
  islands_.resize(nodes_.size());
  const auto row_of_obstacle = [&](std::uint32_t k) {
    return static_cast<std::uint32_t>(components_ + k);
  };
  for (const ContactPoint& c : contacts) {
    const std::uint32_t a =
        c.is_body_a() ? component_of_a(c, state).value : row_of_obstacle(c.ball);
    const std::uint32_t b =
        c.is_body_b() ? component_of_b(c, state).value : row_of_obstacle(c.obstacle);
    if (a != b) join(a, b);
  }
}

void ImpactEnergy::join(std::uint32_t a, std::uint32_t b) {
  for (const auto& [one, other] : {std::pair{a, b}, std::pair{b, a}}) {
    Node& node = nodes_[one];
    node.meets_several = node.meets_several || (node.other != none && node.other != other);
    node.other = other;
  }
  // Driven or held nodes are the ground of islands and join none.
  if (mass_of(b) == unbounded) grounds_.emplace_back(a, b);
  if (mass_of(a) == unbounded) grounds_.emplace_back(b, a);
  if (mass_of(a) == unbounded || mass_of(b) == unbounded) return;
  joined_.join(a, b);
}

bool ImpactEnergy::is_driven(std::uint32_t node) const {
  return node >= components_ && !step_.pass.obstacles[node - components_].mass;
}

double ImpactEnergy::mass_of(std::uint32_t node) const {
  if (node >= components_) return step_.pass.obstacles[node - components_].mass.value_or(unbounded);
  const Component& c = step_.pass.state.components[node];
  return c.supported ? unbounded : c.mass;
}

Vec3 ImpactEnergy::velocity_of(std::uint32_t node) const {
  if (node >= components_) return step_.pass.obstacles[node - components_].velocity;
  const Component& c = step_.pass.state.components[node];
  return c.supported ? c.frame_velocity : Vec3(c.momentum / c.mass);
}

double ImpactEnergy::surface_speed_of(std::uint32_t node) const {
  if (is_driven(node)) return 0;
  if (node >= components_) {
    const Obstacle& ball = step_.pass.obstacles[node - components_];
    return ball.spin.norm() * radius_of(ball.shape);
  }
  const MechanicsState& state = step_.pass.state;
  const Vec3 velocity = velocity_of(node);
  double squared = 0;
  for (VertexId v : state.components[node].vertices) {
    squared = std::max(squared, (state.vertices.velocity[v.index()] - velocity).squaredNorm());
  }
  return std::sqrt(squared);
}

double ImpactEnergy::kinetic_against(std::uint32_t node, const Vec3& velocity) const {
  if (is_driven(node)) return 0;
  if (node >= components_) {
    return kinetic_energy(step_.pass.obstacles[node - components_], velocity);
  }
  const MechanicsState& state = step_.pass.state;
  double energy = 0;
  for (VertexId v : state.components[node].vertices) {
    energy += 0.5 * state.vertices.mass[v.index()] *
              (state.vertices.velocity[v.index()] - velocity).squaredNorm();
  }
  return energy;
}

double ImpactEnergy::strain_of(std::uint32_t node) const {
  if (node >= components_) return 0;
  return strain_energy(step_.pass.state, step_.pass.state.components[node]);
}

ImpactEnergy::Island& ImpactEnergy::island_of(std::uint32_t node) {
  const std::uint32_t root = joined_.root(node);
  Island& island = islands_[root];
  if (!island.members.empty()) return island;
  std::vector<std::uint32_t>& members = island.members;
  for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k].other != none && joined_.root(k) == root) members.push_back(k);
  }
  std::vector<std::uint32_t>& held = island.held;
  bool grounded = false, torn = false;
  const auto rest_on = [&](const Vec3& velocity) {
    torn = torn || (grounded && velocity != island.velocity);
    grounded = true;
    island.velocity = velocity;
  };
  double mass = 0;
  Vec3 momentum = Vec3::Zero();
  for (const std::uint32_t k : members) {
    if (mass_of(k) == unbounded) {
      rest_on(velocity_of(k));  // held or driven: an island of its own
      continue;
    }
    mass += mass_of(k);
    momentum += mass_of(k) * velocity_of(k);
  }
  for (const auto& [member, ground] : grounds_) {
    if (joined_.root(member) != root) continue;
    rest_on(velocity_of(ground));
    if (ground < components_ && std::ranges::find(held, ground) == held.end()) {
      held.push_back(ground);
    }
  }
  if (!grounded) island.velocity = momentum / mass;
  for (const std::uint32_t k : members) {
    island.kinetic += kinetic_against(k, island.velocity);
    const double speed = (velocity_of(k) - island.velocity).norm() + surface_speed_of(k);
    island.fastest = std::max(island.fastest, speed);
  }
  if (torn) {
    island.kinetic = island.fastest = unbounded;
  } else if (grounded) {
    const double fall = step_.h() * step_.pass.input.loads.gravity.norm();
    island.gravity = mass * fall * (island.fastest + fall);
  }
  return island;
}

double ImpactEnergy::pair_bound(std::uint32_t node) {
  const Node& self = nodes_[node];
  if (self.meets_several) return unbounded;
  const std::uint32_t other = self.other;
  const double fall = step_.h() * step_.pass.input.loads.gravity.norm();
  double speed = (velocity_of(node) - velocity_of(other)).norm() + surface_speed_of(node) +
                 surface_speed_of(other) + fall;
  double mass = std::min(mass_of(node), mass_of(other));
  if (nodes_[other].meets_several && mass_of(other) != unbounded) {
    mass = mass_of(node);
    speed += 2 * island_of(node).fastest;
  }
  return speed > 0 ? 0.5 * mass * speed * speed : 0;
}

double ImpactEnergy::strain_of_island(Island& island) {
  if (island.strain) return *island.strain;
  double& sum = island.strain.emplace(0);
  for (const std::uint32_t k : island.held) {
    sum += deformation_energy(step_.pass.state, step_.pass.state.components[k]);
  }
  for (const std::uint32_t k : island.members) sum += strain_of(k);
  return sum;
}

bool ImpactEnergy::island_reaches(std::uint32_t node, double least) {
  Island& island = island_of(node);
  const double motion = island.kinetic + island.gravity;
  return motion >= least || motion + strain_of_island(island) >= least;
}

bool ImpactEnergy::held_reaches(std::uint32_t node, double least) {
  std::vector<std::uint32_t> seen;
  for (const auto& [member, ground] : grounds_) {
    if (ground != node) continue;
    if (mass_of(member) == unbounded) {
      if (velocity_of(member) != velocity_of(node)) return true;
      continue;
    }
    const std::uint32_t root = joined_.root(member);
    if (std::ranges::find(seen, root) == seen.end()) seen.push_back(root);
  }
  double sum = 0;
  for (const std::uint32_t root : seen) sum += island_of(root).kinetic + island_of(root).gravity;
  if (sum >= least) return true;
  sum += deformation_energy(step_.pass.state, step_.pass.state.components[node]);
  for (const std::uint32_t root : seen) sum += strain_of_island(island_of(root));
  return sum >= least;
}

Verdict ImpactEnergy::judge(ComponentId id, double threshold) {
  const std::uint32_t node = id.value;
  if (nodes_[node].other == none) return Verdict::breaks;
  const Component& component = step_.pass.state.components[id.index()];
  // A component that may slide along an axis is neither ground nor free: no bound holds for it.
  if (component.partly_held) return Verdict::breaks;
  const double pair = pair_bound(node);
  if (pair < threshold && !deforms_by(step_.pass.state, component, threshold - pair)) {
    return Verdict::spared_by_pair;
  }
  const bool reaches =
      component.supported ? held_reaches(node, threshold) : island_reaches(node, threshold);
  return reaches ? Verdict::breaks : Verdict::spared_by_island;
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
#include "fracture/simulation/changes/spring_load.hpp"

#include <algorithm>
#include <numbers>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

constexpr double spring_frequency = 5;  // Hz

Vec3 force_of(const Spring& spring, const SimulationState& s, const Scene& scene) {
  const std::size_t row = spring.vertex.index();
  const VertexColumns& v = s.mechanics.vertices;
  const Component& piece = s.mechanics.components[v.component[row].index()];
  const double omega = 2 * std::numbers::pi * spring_frequency;
  // However far the pointer is: a chip pulled from far off would be spun faster than a step
  // follows.
  const double lifts = 3 * scene.gravity.acceleration.norm() / (omega * omega);
  const double longest = std::max(2 * piece.rest_radius, lifts);
  Vec3 stretch = spring.end - v.position[row];
  stretch *= std::min(1.0, longest / stretch.norm());
  if (!stretch.allFinite()) stretch.setZero();
  return piece.mass * omega * (omega * stretch - 2 * v.velocity[row]);
}

}  // namespace

SpringLoad::SpringLoad(Simulation& simulation)
    : state_(*simulation.state), loads_(simulation.state->loads.size()) {
  if (!simulation.spring) return;
  const Spring& spring = *simulation.spring;
  add_vertex_force(state_.loads, state_.mechanics,
                   vertex_star(state_.cells.map, spring.vertex).corners,
                   force_of(spring, state_, simulation.scene));
  for (std::size_t i = loads_; i < state_.loads.size(); ++i) {
    state_.loads[i].load = CornerLoad::no_load;
  }
}

SpringLoad::~SpringLoad() { state_.loads.resize(loads_); }

}  // namespace sunder

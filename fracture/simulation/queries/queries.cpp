// SPDX-License-Identifier: MIT
// Queries of a host about a simulation.
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

std::uint64_t steps_taken(const Simulation& simulation) { return simulation.state->step; }

double simulated_time(const Simulation& simulation) { return simulation.state->mechanics.time; }

std::size_t body_of(const Simulation& simulation, TetId tetrahedron) {
  require(
      !simulation.bodies.empty() && tetrahedron.index() < simulation.bodies.back().end_tetrahedron,
      "body_of: there is no such tetrahedron");
  std::size_t body = 0;
  while (tetrahedron.index() >= simulation.bodies[body].end_tetrahedron) ++body;
  return body;
}

}  // namespace sunder

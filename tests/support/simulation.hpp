// SPDX-License-Identifier: MIT
// Simulations and methods that tests share.
#pragma once

#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder::test {

/// The simulation of a scene that has no error; findings are shown when the test fails.
inline Simulation built(Scene scene) {
  Result<Simulation> sim = build_simulation(std::move(scene));
  for (const Finding& f : sim.findings) UNSCOPED_INFO(f.code << ": " << f.text);
  REQUIRE(sim);
  return std::move(*sim);
}

/// Integrators and models besides floating_frame and verlet.
inline std::vector<IntegratorSettings> other_methods() {
  using enum Integrator;
  const auto corotational = ElasticModel::corotational;
  return {{.integrator = implicit_euler},
          {.integrator = broyden, .max_iterations = 100},
          {.integrator = broyden, .broyden_start = BroydenStart::factor},
          {.integrator = newton_cg},
          {.integrator = sub_stepped},
          {.integrator = modal},
          {.integrator = implicit_euler, .model = corotational},
          {.integrator = implicit_euler,
           .model = corotational,
           .corotational_solve = CorotationalSolve::prefactored},
          {.integrator = newton_cg, .model = corotational},
          {.integrator = sub_stepped, .model = corotational},
          {.isolated = IsolatedTetrahedra::projection},
          {.isolated = IsolatedTetrahedra::qr}};
}

}  // namespace sunder::test

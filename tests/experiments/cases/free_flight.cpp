// SPDX-License-Identifier: MIT
// Steps of a spinning rod through the whole simulation, measured by its vertices alone.
#include "tests/experiments/cases/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/Eigenvalues>

#include "fracture/algorithms/node_stress.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

constexpr double length = 1, thickness = 0.1;

Scene flight_scene(const FreeFlight& flight) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  BodySettings rod;
  rod.mesh = suite::kuhn_box({10, 2, 2}, 1);
  for (Point& p : rod.mesh.points) {
    p = {length * p[0] / 10, thickness * p[1] / 2, thickness * p[2] / 2};
  }
  rod.material = {.young_modulus = flight.young_modulus, .poisson_ratio = 0};
  rod.velocity = {3, -2, 1};
  scene.bodies.push_back(std::move(rod));
  scene.gravity.acceleration.setZero();
  scene.integrator = flight.integrator;
  scene.integrator.time_step = flight.time_step;
  scene.ladder.rigid = flight.ladder;
  return scene;
}

/// Spins the rod about its axis of largest inertia and lets it come to rest in its own frame: by
/// steps far longer than its periods, with its momentum kept.
void spin_up(Simulation& sim, double spin) {
  MechanicsState& m = sim.state->mechanics;
  const Component& rod = m.components[0];
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(rod.rest_inertia);
  place(m, ComponentId{0},
        {.translation = rod.rest_centre,
         .velocity = sim.scene.bodies[0].velocity,
         .spin = spin * axes.eigenvectors().col(2)});
  const IntegratorSettings settings{.time_step = 5e-3, .rho_infinity = 0};
  const Loads nothing;
  MechanicsScratch scratch;
  for (int i = 0; i < 40; ++i) {
    advance(m, scratch, {sim.state->cells.map.corners(), nothing, settings});
  }
}

Vec3 spin_momentum(const MechanicsState& m) {
  Vec3 centre = Vec3::Zero();
  double mass = 0;
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    centre += m.vertices.mass[v] * m.vertices.position[v];
    mass += m.vertices.mass[v];
  }
  return angular_momentum(m.vertices) - (centre / mass).cross(momentum(m.vertices));
}

double largest_node_stress(const Simulation& sim) {
  const MechanicsState& m = sim.state->mechanics;
  std::vector<Mat3> stress;
  average_node_stress(stress,
                      {sim.state->cells.map.corners(), m.elements.stress, m.elements.rest_volume},
                      m.vertices.size());
  double largest = -std::numeric_limits<double>::infinity();
  for (const Mat3& sigma : stress) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(sigma, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues()[2]);
  }
  return largest;
}

}  // namespace

FlightDrift run_free_flight(const FreeFlight& flight) {
  Result<Simulation> built = build_simulation(flight_scene(flight));
  if (!built) throw std::runtime_error(built.findings.front().text);
  Simulation& sim = *built;
  spin_up(sim, flight.spin);
  const MechanicsState& m = sim.state->mechanics;
  const Vec3 P = momentum(m.vertices), L = spin_momentum(m);
  const auto energy = [&] { return kinetic_energy(m.vertices) + strain_energy(m); };
  const double start = energy();
  const double closed_form =
      m.materials[0].density * flight.spin * flight.spin * length * length / 8;
  FlightDrift drift;
  drift.least_stress = std::numeric_limits<double>::infinity();
  const int steps = static_cast<int>(std::lround(flight.duration / flight.time_step));
  for (int i = 0; i < steps; ++i) {
    const StepReport report = advance(sim);
    drift.fans += report.fracture.fans.size();
    if (report.status.outcome != StepOutcome::fine) {
      drift.failure = to_finding(report.status).text;
      break;
    }
    drift.momentum = std::max(drift.momentum, (momentum(m.vertices) - P).norm() / P.norm());
    drift.angular_momentum =
        std::max(drift.angular_momentum, (spin_momentum(m) - L).norm() / L.norm());
    drift.energy = std::max(drift.energy, std::abs(energy() / start - 1));
    const double stress = largest_node_stress(sim) / closed_form;
    drift.least_stress = std::min(drift.least_stress, stress);
    drift.most_stress = std::max(drift.most_stress, stress);
  }
  return drift;
}

}  // namespace sunder::accuracy

// SPDX-License-Identifier: MIT
// Sets the pulse into a bar at rest, runs it and looks at the layers.
#include "tests/experiments/cases/spall.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "tests/experiments/chain/chain.hpp"
#include "tests/experiments/chain/loads.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

using chain::Pulse;

/// m, from the front to the free end at the start: on every mesh the same where the rise is.
double stand_off(const Spall& spall) { return spall.front_length > 0 ? 0.02 : 3.0 / spall.cells; }

/// s, that a run lasts: the pulse has gone.
double duration(const Spall& spall, double c) { return 1.3 * spall.length / c; }

Scene scene_of(const Spall& spall, double cell) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  BodySettings bar;
  bar.name = "bar";
  bar.mesh = suite::kuhn_box({spall.cells, spall.across, spall.across}, cell);
  bar.material.poisson_ratio = 0;
  bar.material.fracture_energy = spall.fracture_energy;
  if (spall.fracture_energy) scene.fracture.crack = CrackMode::cohesive;
  const double travel = cell / bar_wave_speed(bar.material);
  scene.bodies = {bar};
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = spall.step * travel;
  scene.integrator.damping.stiffness_factor = spall.viscosity * travel;
  scene.ladder.rigid = false;
  return scene;
}

/// Velocity s / (rho c) and displacement -s / E of a wave that runs along x.
void set_pulse(Simulation& sim, const Pulse& pulse) {
  const Material& material = sim.scene.bodies[0].material;
  VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double x = v.rest_position[i].x();
    v.position[i].x() += pulse.integral(x) / material.young_modulus;
    v.velocity[i].x() = pulse.stress(x) / (material.density * bar_wave_speed(material));
  }
  reframe(sim.state->mechanics, ComponentId{0});
}

/// A piece by its rest place along the bar.
struct Piece {
  double low, high, speed;
};

std::vector<Piece> pieces_of(const Simulation& sim) {
  std::vector<Piece> pieces;
  const MechanicsState& m = sim.state->mechanics;
  for (const Component& c : m.components) {
    if (c.tetrahedra.empty()) continue;
    Piece piece{1e30, -1e30, c.momentum.x() / c.mass};
    for (VertexId v : c.vertices) {
      piece.low = std::min(piece.low, m.vertices.rest_position[v.index()].x());
      piece.high = std::max(piece.high, m.vertices.rest_position[v.index()].x());
    }
    pieces.push_back(piece);
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.high > b.high; });
  return pieces;
}

}  // namespace

SpallOutcome run_spall(const Spall& spall) {
  const double cell = 1.0 / spall.cells;
  Result<Simulation> sim = build_simulation(scene_of(spall, cell));
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  const Material& material = sim->scene.bodies[0].material;
  const double c = bar_wave_speed(material), xi = material.tensile_strength;
  const double peak = spall.peak * xi;
  const auto& rest = sim->state->mechanics.vertices.rest_position;
  const double end = std::max_element(rest.begin(), rest.end(), [](const Vec3& a, const Vec3& b) {
                       return a.x() < b.x();
                     })->x();
  const double rise = spall.front_length > 0 ? spall.front_length : spall.front * cell;
  const Pulse pulse{end - stand_off(spall), rise, spall.length, peak};
  set_pulse(*sim, pulse);
  const double momentum_before = momentum(sim->state->mechanics.vertices).x();

  SpallOutcome seen;
  seen.exact_thickness = (spall.length - rise) / (2 * spall.peak);
  seen.exact_layers = static_cast<std::size_t>(spall.peak);
  // The reflection is that of the peak, a ramp behind the front.
  const double reflected = (end - pulse.front + pulse.ramp) / c;
  const double until = duration(spall, c);
  double first = -1;
  while (sim->state->mechanics.time < until) {
    const StepReport report = advance(*sim);
    if (report.status.outcome != StepOutcome::fine) {
      throw std::runtime_error(to_finding(report.status).text);
    }
    if (first < 0 && !report.fracture.fans.empty()) first = report.fan_time.front();
  }
  const std::vector<Piece> pieces = pieces_of(*sim);
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
    seen.thickness.push_back(pieces[k].high - pieces[k].low);
  }
  if (!seen.thickness.empty()) {
    seen.time = (first - reflected) / (seen.exact_thickness / c);
    seen.speed = pieces.front().speed / ((2 * peak - xi) / (material.density * c));
  }
  seen.momentum = momentum(sim->state->mechanics.vertices).x() / momentum_before;
  return seen;
}

ChainSpallOutcome run_spall_on_chain(const Spall& spall, int cells, double step) {
  const Material material;
  const double c = bar_wave_speed(material), xi = material.tensile_strength;
  const double rise = spall.front_length > 0 ? spall.front_length : spall.front / spall.cells;
  const Pulse pulse{1 - stand_off(spall), rise, spall.length, spall.peak * xi};
  chain::Chain bar({.young_modulus = material.young_modulus,
                    .density = material.density,
                    .fracture_energy = spall.fracture_energy.value(),
                    .step = step,
                    .strength = std::vector<double>(static_cast<std::size_t>(cells) + 1, xi)});
  for (std::size_t k = 0; k < bar.nodes(); ++k) {
    const double x = double(k) * bar.cell();
    bar.set_along(k, pulse.integral(x) / material.young_modulus,
                  pulse.stress(x) / (material.density * c));
  }
  const double before = bar.momentum();
  while (bar.time() < duration(spall, c)) bar.step();
  ChainSpallOutcome seen;
  double right = 1;
  const std::vector<std::size_t> broken = bar.broken();
  for (auto k = broken.rbegin(); k != broken.rend(); ++k) {
    const double x = double(*k) * bar.cell();
    seen.thickness.push_back(right - x);
    right = x;
  }
  const chain::ChainEnergy e = bar.energy();
  const double now = e.kinetic + e.strain + e.stored + e.dissipated + e.contact + e.damped;
  seen.live = bar.live(0.1);
  seen.residual = std::abs(now - e.before) / e.before;
  seen.momentum = bar.momentum() / before;
  return seen;
}

}  // namespace sunder::accuracy

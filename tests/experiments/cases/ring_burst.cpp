// SPDX-License-Identifier: MIT
// Builds the ring, draws its strengths, runs it and applies the rule of unloading waves.
#include "tests/experiments/cases/ring_burst.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/experiments/chain/chain.hpp"
#include "tests/experiments/chain/loads.hpp"
#include "tests/support/shapes.hpp"

namespace sunder::accuracy {
namespace {

/// Sections in their order round the ring; points of a section are at k, k + cells, ...
struct Ring {
  TetMesh mesh;
  std::vector<double> strength;  ///< Pa, of each section
  double cell = 0;               ///< m
};

std::vector<double> strengths(const RingBurst& burst, int cells) {
  return chain::strengths_of({.least = Material{}.tensile_strength,
                              .spread = burst.spread,
                              .places = burst.fracture_energy ? burst.places : cells,
                              .seed = burst.seed},
                             cells);
}

Ring ring_of(const RingBurst& burst) {
  Ring ring;
  const auto around = static_cast<std::size_t>(burst.cells);
  ring.cell = 2 * pi / burst.cells;
  std::vector<Vec3> points;
  for (const double radius : {1 - ring.cell / 2, 1 + ring.cell / 2}) {
    for (std::size_t k = 0; k < around; ++k) {
      const double angle = ring.cell * double(k);
      points.push_back(radius * Vec3(std::cos(angle), std::sin(angle), 0));
    }
  }
  const Body body = plate(ring_sheet(around, 1), points, ring.cell, 1);
  for (const Vec3& x : body.rest) ring.mesh.points.push_back({x.x(), x.y(), x.z()});
  for (const Corners& c : body.corners) {
    ring.mesh.tetrahedra.push_back({c[0].value, c[1].value, c[2].value, c[3].value});
  }
  ring.strength = strengths(burst, burst.cells);
  return ring;
}

/// s, when the hoop stress of a ring that does not break reaches `stress`.
double time_of(double stress, const RingBurst& burst) {
  const Material material;
  const double w = bar_wave_speed(material);  // c / R
  return std::asin(stress * w / (material.young_modulus * burst.rate)) / w;
}

/// Which sections break by the rule.
std::vector<char> rule(const Ring& ring, const RingBurst& burst) {
  const double travel = ring.cell / bar_wave_speed(Material{});
  const std::size_t n = ring.strength.size();
  std::vector<double> critical(n), released(n, 1e30);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = 0; k < n; ++k) critical[k] = time_of(ring.strength[k], burst);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return critical[a] < critical[b]; });
  std::vector<char> breaks(n, 0);
  for (const std::size_t k : order) {
    if (critical[k] > released[k]) continue;
    breaks[k] = 1;
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t apart = j > k ? j - k : k - j;
      released[j] =
          std::min(released[j], critical[k] + travel * double(std::min(apart, n - apart)));
    }
  }
  return breaks;
}

Scene scene_of(const Ring& ring, const RingBurst& burst) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  BodySettings body;
  body.name = "ring";
  body.mesh = ring.mesh;
  body.material.poisson_ratio = 0;
  body.material.fracture_energy = burst.fracture_energy;
  if (burst.fracture_energy) scene.fracture.crack = CrackMode::cohesive;
  for (std::size_t k = 0; k < ring.mesh.points.size(); ++k) {
    body.strength.painted.push_back(ring.strength[k % ring.strength.size()]);
  }
  const double travel = ring.cell / bar_wave_speed(body.material);
  scene.integrator.time_step = burst.step * travel;
  if (!burst.fracture_energy) scene.integrator.damping.stiffness_factor = burst.viscosity * travel;
  scene.bodies = {std::move(body)};
  scene.gravity.acceleration.setZero();
  scene.contact.between_pieces = false;
  scene.ladder.rigid = false;
  return scene;
}

double energy_of(const Simulation& sim) {
  return kinetic_energy(sim.state->mechanics.vertices) + strain_energy(sim.state->mechanics);
}

chain::RingLaw law_of(const RingBurst& burst) {
  const Material material;
  return {material.young_modulus, material.density, material.tensile_strength,
          burst.fracture_energy.value(), burst.rate};
}

}  // namespace

double zhou_fragments(const RingBurst& burst) { return 2 * pi / chain::zhou_size(law_of(burst)); }

double glenn_fragments(const RingBurst& burst) { return 2 * pi / chain::glenn_size(law_of(burst)); }

RingOutcome run_ring(const RingBurst& burst) {
  const Ring ring = ring_of(burst);
  const Material material;
  const double c = bar_wave_speed(material), xi = material.tensile_strength;
  const double last = time_of(xi * (1 + burst.spread), burst);
  Result<Simulation> sim = build_simulation(scene_of(ring, burst));
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  VertexColumns& vertices = sim->state->mechanics.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vec3 x = vertices.position[v];
    vertices.velocity[v] = burst.rate * Vec3(x.x(), x.y(), 0);
  }
  reframe(sim->state->mechanics, ComponentId{0});

  RingOutcome seen;
  const double before = energy_of(*sim);
  std::vector<char> broke(ring.strength.size(), 0);
  const double more = burst.fracture_energy ? burst.after : sim->scene.integrator.time_step;
  double work = 0;
  while (sim->state->mechanics.time < last + more) {
    const StepReport report = advance(*sim);
    work += report.ties.work;
    if (report.status.outcome != StepOutcome::fine) {
      throw std::runtime_error(to_finding(report.status).text);
    }
    for (const FanEvent& fan : report.fracture.fans) {
      const Vec3& at = vertices.rest_position[fan.vertex.index()];
      const auto k = std::lround(std::atan2(at.y(), at.x()) / ring.cell) + burst.cells;
      broke[static_cast<std::size_t>(k % burst.cells)] = 1;
    }
  }
  const std::vector<char> expected = rule(ring, burst);
  for (std::size_t k = 0; k < broke.size(); ++k) {
    seen.same_sections += expected[k] && broke[k];
    seen.expected += expected[k] != 0;
  }
  for (const Component& piece : sim->state->mechanics.components) {
    seen.fragments += !piece.tetrahedra.empty();
  }
  const double span = last - time_of(xi, burst);
  seen.mean_expected = 0.5 * burst.cells * std::sqrt(pi * ring.cell / (c * span));
  const double area = double(seen.fragments) * ring.cell * ring.cell;
  seen.energy_per_area = (before - energy_of(*sim)) / area;
  if (burst.fracture_energy) seen.taken = work / (*burst.fracture_energy * area);
  return seen;
}

ChainRingOutcome run_ring_on_chain(const RingBurst& burst, int cells, double step,
                                   double viscosity) {
  const Material material;
  const double G = burst.fracture_energy.value();
  chain::Chain ring({.shape = chain::Shape::ring,
                     .young_modulus = material.young_modulus,
                     .density = material.density,
                     .fracture_energy = G,
                     .step = step,
                     .viscosity = viscosity,
                     .strength = strengths(burst, cells)});
  for (std::size_t k = 0; k < ring.nodes(); ++k) ring.set_outwards(k, 0, burst.rate);
  const double until = time_of(material.tensile_strength * (1 + burst.spread), burst) + burst.after;
  while (ring.time() < until) ring.step();
  const chain::ChainEnergy e = ring.energy();
  const double now = e.kinetic + e.strain + e.stored + e.dissipated + e.contact + e.damped;
  const double parted = double(ring.broken().size());
  return {.fragments = ring.broken().size(),
          .live = ring.live(0.1),
          .taken = e.dissipated / (G * parted),
          .contact = e.contact / (G * parted),
          .residual = std::abs(now - e.before) / e.dissipated};
}

}  // namespace sunder::accuracy

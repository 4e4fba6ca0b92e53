// SPDX-License-Identifier: MIT
// The beam, its equilibrium seen by each node stress, and its slow run.
#include "tests/experiments/cases/bending.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/algorithms/stress_fit.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "tests/experiments/cases/crack_growth.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

constexpr double height = 0.1, width = 0.05, span = 1.6, overhang = 0.05;
const Material concrete{};

/// A box around a line across the beam, far thinner than an element.
LoadBox line_load(double x, double z, double force, double ramp_time) {
  LoadBox load;
  load.minimum = {x - 1e-6, -1, z - 1e-6};
  load.maximum = {x + 1e-6, 1, z + 1e-6};
  load.force = {0, 0, force};
  load.ramp_time = ramp_time;
  return load;
}

double thread_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * double(t.tv_sec) + double(t.tv_nsec);
}

Simulation built_beam(Scene scene) {
  Result<Simulation> sim = build_simulation(std::move(scene));
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  return std::move(*sim);
}

double angle_with_axis(const Vec3& normal) {
  return std::acos(std::min(1.0, std::abs(normal.x()))) * 180 / std::numbers::pi;
}

/// The most tense vertex that has a fan breaks first.
void find_first_break(BendingAnswer& answer, const Simulation& sim,
                      const std::vector<Mat3>& stress) {
  const Cells& cells = sim.state->cells;
  const MechanicsState& m = sim.state->mechanics;
  std::vector<double> tension(stress.size());
  for (std::size_t v = 0; v < stress.size(); ++v) tension[v] = principal_tension(stress[v]).value;
  std::vector<std::size_t> order(stress.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t v) { return tension[v]; });
  for (const std::size_t v : order) {
    const FanPlane fan = choose_fan(cells, vertex_star(cells.map, VertexId{v}),
                                    principal_tension(stress[v]), m.components.front().rest_centre);
    if (fan.faces.empty()) continue;
    answer.load = cells.strength[v] / tension[v];
    answer.away = std::abs(m.vertices.rest_position[v].x());
    answer.angle = angle_with_axis(fan.normal);
    return;
  }
}

/// Mean of sigma_xx over the lower surface a quarter of the span from the middle, on both sides.
double surface_stress(const Simulation& sim, const std::vector<Mat3>& stress) {
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < stress.size(); ++v) {
    const Vec3& x = sim.state->mechanics.vertices.rest_position[v];
    if (std::abs(std::abs(x.x()) - span / 4) > 1e-6 || std::abs(x.z()) > 1e-6) continue;
    sum += stress[v](0, 0);
    ++count;
  }
  return sum / count;
}

/// Node stress of all vertices, with its time.
std::vector<Mat3> measure(BendingAnswer& answer, const Simulation& sim, NodeStress mode) {
  const MechanicsState& m = sim.state->mechanics;
  const VolumeMap& map = sim.state->cells.map;
  const ElementStress elements{map.corners(), m.elements.stress,
                               mode == NodeStress::mass ? m.elements.mass : m.elements.rest_volume};
  std::vector<Mat3> stress;
  std::vector<double> weight;
  StressFit fit;
  answer.ns = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 6; ++k) {
    const double start = thread_ns();
    if (mode == NodeStress::fit) {
      fit_node_stress(stress, fit, map, elements);
    } else {
      average_node_stress(stress, elements, map.vertices(), weight);
    }
    const double ns = (thread_ns() - start) / double(map.vertices());
    if (k == 0) answer.first_ns = ns;
    if (k > 0) answer.ns = std::min(answer.ns, ns);
  }
  for (const StressPatch& patch : fit.patches) answer.unfitted += !patch.fitted;
  return stress;
}

}  // namespace

Scene bent_beam(const Beam& beam) {
  const int n = beam.layers;
  const double cell = height / n;
  BodySettings body;
  body.name = "beam";
  body.mesh = suite::kuhn_box({17 * n, n / 2, n}, cell);
  for (Point& p : body.mesh.points) {
    // To the middle; on a line of vertices exactly, whatever the grid's rounding.
    p[0] = (std::round(p[0] / cell) - 8.5 * n) * cell;
    p[1] -= width / 2;
    p[2] = std::round(p[2] / cell) * cell;
  }
  body.material = concrete;
  const double half = span / 2;
  body.held.push_back(
      {.minimum = {-half - overhang - 1e-6, -1, -1}, .maximum = {-half - overhang + 1e-6, 1, 1}});
  body.loads = {line_load(0, height, -beam.force, beam.ramp_time),
                line_load(-half, 0, beam.force / 2, beam.ramp_time),
                line_load(half, 0, beam.force / 2, beam.ramp_time)};
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back(std::move(body));
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 0.02;
  return scene;
}

double beam_breaking_load() {
  return 2 * concrete.tensile_strength * width * height * height / (3 * span);
}

BendingTable bend_static(int layers) {
  Simulation sim = built_beam(bent_beam({.layers = layers, .force = beam_breaking_load()}));
  MechanicsState& m = sim.state->mechanics;
  const auto corners = sim.state->cells.map.corners();
  Loads loads;
  add_corner_loads(loads.force, sim.state->loads, m, corners, 0);
  const auto findings = solve_static(m, sim.scratch->mechanics, corners, loads);
  if (!findings.empty()) throw std::runtime_error(findings.front().text);
  BendingTable table{m.vertices.size(), m.elements.size(), {}};
  for (std::size_t mode = 0; mode < table.modes.size(); ++mode) {
    BendingAnswer& answer = table.modes[mode];
    const std::vector<Mat3> stress = measure(answer, sim, static_cast<NodeStress>(mode));
    find_first_break(answer, sim, stress);
    answer.away *= layers / height;
    answer.surface = surface_stress(sim, stress) / (concrete.tensile_strength / 2);
  }
  return table;
}

namespace {

double largest_share(const Simulation& sim) {
  double whole = 0, largest = 0;
  for (const Component& c : sim.state->mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    whole += c.mass;
    largest = std::max(largest, c.mass);
  }
  return largest / whole;
}

struct LoadedStep {
  int layers = 0;
  double load = 0;  ///< over beam theory's, at its end
};

void add(BendingRun& run, const StepReport& report, const LoadedStep& step) {
  const std::vector<FanEvent>& fans = report.fracture.fans;
  const bool is_first = run.all_fans == 0 && !fans.empty();
  if (run.all_fans == 0) {
    ++run.steps;
    run.quasi_static += report.ladder.components[static_cast<std::size_t>(Rung::quasi_static)] > 0;
  }
  for (const FanEvent& fan : fans) {
    const double away = std::abs(fan.rest_position.x());
    run.farthest = std::max(run.farthest, away / height);
    if (!is_first) continue;
    run.away = std::max(run.away, away * step.layers / height);
    run.angle = std::max(run.angle, angle_with_axis(fan.normal));
  }
  if (is_first) {
    run.load = step.load;
    run.fans = fans.size();
    run.overload = fans.front().stress / fans.front().strength - 1;
  }
  run.all_fans += fans.size();
  run.pieces = report.components;
  run.parted = step.load;
}

}  // namespace

BendingRun bend_slowly(const SlowBend& bend) {
  constexpr double ramp = 20, most = 2.8;
  Scene scene =
      bent_beam({.layers = bend.layers, .force = most * beam_breaking_load(), .ramp_time = ramp});
  scene.fracture = bend.fracture;
  // A crack is through in some thousand sub-steps, within one step of the load.
  if (bend.fracture.crack == CrackMode::cohesive) scene.impact.max_sub_steps = 100000;
  scene.bodies.front().material.toughness = bend.toughness;
  Simulation sim = built_beam(std::move(scene));
  BendingRun run;
  int left = 0;  // short steps that a divided one still has
  while (sim.state->mechanics.time < ramp * (1 - 1e-9)) {
    const std::string before = bend.divided > 1 && left == 0 ? saved_state(sim) : "";
    StepReport report = advance(sim);
    if (!before.empty() && !report.fracture.fans.empty()) {
      sim = std::move(*restore(before));
      sim.scene.integrator.time_step /= bend.divided;
      left = bend.divided;
      report = advance(sim);
    }
    if (left > 0 && --left == 0) sim.scene.integrator.time_step *= bend.divided;
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    add(run, report, {bend.layers, most * report.time / ramp});
    if (largest_share(sim) < 0.75) break;
  }
  const CrackArea cracked = crack_area(sim.state->cells);
  run.area = cracked.raw / (height * width);
  run.projected = cracked.projected / (height * width);
  return run;
}

}  // namespace sunder::accuracy

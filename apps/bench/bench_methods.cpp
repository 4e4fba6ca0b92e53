// SPDX-License-Identifier: MIT
// Times of one and the same step by every integrator and model.
#include "apps/bench/bench_methods.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/bench/bench_figures.hpp"
#include "apps/bench/clock.hpp"
#include "apps/scene/json_text.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/integrators/modal.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder {
namespace {

struct Method {
  std::string_view name;
  IntegratorSettings settings;
};

std::vector<Method> methods() {
  using enum Integrator;
  constexpr ElasticModel corotational = ElasticModel::corotational;
  return {
      {"floating_frame", {}},
      {"implicit_euler", {.integrator = implicit_euler}},
      {"sub_stepped", {.integrator = sub_stepped}},
      {"modal", {.integrator = modal}},
      {"broyden from the mass matrix", {.integrator = broyden}},
      {"broyden from the factor", {.integrator = broyden, .broyden_start = BroydenStart::factor}},
      {"newton_cg", {.integrator = newton_cg}},
      {"corotational, reassembled", {.integrator = implicit_euler, .model = corotational}},
      {"corotational, prefactored",
       {.integrator = implicit_euler,
        .model = corotational,
        .corotational_solve = CorotationalSolve::prefactored}},
      {"corotational, newton_cg", {.integrator = newton_cg, .model = corotational}},
  };
}

/// A body, its stiffness, its time step, and its deformation (over its size).
struct Case {
  std::string_view name;
  TetMesh mesh;
  double young_modulus, time_step, strain;
};

std::vector<Case> cases() {
  const TetMesh plate = suite::kuhn_box({23, 3, 1}, 0.05);
  const TetMesh block = suite::kuhn_box({17, 10, 6}, 0.05);
  return {{"plate", plate, 30e9, 1e-3, 1e-5},
          {"plate", plate, 1e7, 1e-2, 1e-3},
          {"block", block, 30e9, 1e-3, 1e-5},
          {"block", block, 1e7, 1e-2, 1e-3}};
}

/// A body in flight that turns, deformed smoothly.
Result<Simulation> flying_body(const Case& c) {
  Scene scene;
  scene.integrator.time_step = c.time_step;
  scene.bodies.push_back({.mesh = c.mesh,
                          .material = {.young_modulus = c.young_modulus, .tensile_strength = 1e15},
                          .spin = {1, 2, 3}});
  Result<Simulation> sim = build_simulation(std::move(scene));
  if (!sim) return sim;
  MechanicsState& m = sim->state->mechanics;
  const Component& component = m.components.front();
  for (VertexId v : component.vertices) {
    const Vec3 r = (m.vertices.position[v.index()] - component.centre) / component.rest_radius;
    const Vec3 wave(std::sin(2 * r.x() + r.y()), std::sin(3 * r.y() - r.z()), std::cos(2 * r.z()));
    m.vertices.position[v.index()] += c.strain * component.rest_radius * wave;
  }
  reframe(m, component.id);
  return sim;
}

/// Median wall time of one step from the same state, and how its iterations went.
MethodFigure measure(Simulation& sim, const Method& method, const Case& c, int runs) {
  constexpr double long_enough = 2e6;  // us
  MechanicsState& m = sim.state->mechanics;
  MechanicsScratch scratch;
  const Loads loads{.gravity = sim.scene.gravity.acceleration};
  IntegratorSettings settings = method.settings;
  settings.time_step = c.time_step;
  const std::span<const Corners> corners = sim.state->cells.map.corners();
  const StepInput input{corners, loads, settings};
  const ComponentId only = m.components.front().id;
  const auto step = [&] {
    predict(scratch, m, input, {&only, 1});
    measure_elements(m, scratch, corners, {.model = settings.model});
  };
  step();
  std::vector<double> times;
  double sum = 0;
  while (static_cast<int>(times.size()) < std::max(1, runs) && sum < long_enough) {
    const double start = wall_us();
    step();
    times.push_back(wall_us() - start);
    sum += times.back();
  }
  const SolveReport& solve = scratch.predicted.frame[only.index()].solve;
  return {std::string(method.name),
          std::string(c.name),
          m.elements.size(),
          c.young_modulus,
          c.time_step,
          1e-3 * median(std::move(times)),
          1,
          solve.iterations,
          solve.force_evaluations,
          solve.not_converged > 0};
}

}  // namespace

Result<MethodBench> bench_methods(const MethodBenchSettings& settings,
                                  const std::function<void(const std::string&)>& progress) {
  Result<MethodBench> result;
  MethodBench bench{.machine = machine_name(), .runs = settings.runs, .figures = {}};
  for (const Case& c : cases()) {
    progress(fmt::format("{}, {:.0e} Pa, {:.3g} ms", c.name, c.young_modulus, 1e3 * c.time_step));
    Result<Simulation> sim = flying_body(c);
    if (!sim) {
      result.findings = std::move(sim.findings);
      return result;
    }
    double base = 0;
    for (const Method& method : methods()) {
      const bool small = sim->state->mechanics.vertices.size() <= modal_vertex_limit;
      if (method.settings.integrator == Integrator::modal && !small) continue;
      MethodFigure figure = measure(*sim, method, c, settings.runs);
      if (base == 0) base = figure.ms;
      figure.ratio = figure.ms / base;
      bench.figures.push_back(std::move(figure));
    }
  }
  result.value = std::move(bench);
  return result;
}

std::string methods_table(const MethodBench& bench) {
  std::string out = fmt::format(
      "{}; one step from the same state, prediction and element stress, medians of {}\n",
      bench.machine, bench.runs);
  std::string heading;
  for (const MethodFigure& f : bench.figures) {
    const std::string here = fmt::format("{}, {} tetrahedra, {:.0e} Pa, {:.3g} ms", f.body,
                                         f.tetrahedra, f.young_modulus, 1e3 * f.time_step);
    if (here != heading) {
      fmt::format_to(std::back_inserter(out), "\n{:<46}{:>9}{:>9}{:>11}{:>9}\n", here, "ms",
                     "ratio", "iterations", "forces");
      heading = here;
    }
    fmt::format_to(std::back_inserter(out), "  {:<44}{:>9.3f}{:>9.2f}{:>11}{:>9}{}\n", f.method,
                   f.ms, f.ratio, f.iterations, f.force_evaluations,
                   f.given_up ? "  given up" : "");
  }
  return out;
}

std::string methods_csv(const MethodBench& bench) {
  std::string out = fmt::format("# sunder bench methods on {}\n# medians of {} steps\n",
                                bench.machine, bench.runs);
  out +=
      "method,body,tetrahedra,young_modulus,time_step,ms,ratio,iterations,force_evaluations,"
      "given_up\n";
  for (const MethodFigure& f : bench.figures) {
    fmt::format_to(std::back_inserter(out), "\"{}\",{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{}\n",
                   f.method, f.body, f.tetrahedra, f.young_modulus, f.time_step, f.ms, f.ratio,
                   f.iterations, f.force_evaluations, f.given_up ? 1 : 0);
  }
  return out;
}

std::string methods_json(const MethodBench& bench) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const MethodFigure& f : bench.figures) {
    figures.push_back({{"method", f.method},
                       {"body", f.body},
                       {"tetrahedra", f.tetrahedra},
                       {"young_modulus", f.young_modulus},
                       {"time_step", f.time_step},
                       {"ms", f.ms},
                       {"ratio", f.ratio},
                       {"iterations", f.iterations},
                       {"force_evaluations", f.force_evaluations},
                       {"given_up", f.given_up}});
  }
  const nlohmann::ordered_json answer = {
      {"machine", bench.machine}, {"runs", bench.runs}, {"figures", figures}};
  return json_text(answer) + "\n";
}

}  // namespace sunder

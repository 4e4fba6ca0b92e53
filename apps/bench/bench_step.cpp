// SPDX-License-Identifier: MIT
// Times of a step without contact and cracks.
#include "apps/bench/bench_step.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/bench/bench_cholmod.hpp"
#include "apps/bench/bench_figures.hpp"
#include "apps/bench/clock.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/solver/component_system.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder {
namespace {

constexpr double base_modulus = 30e9, base_step = 1e-3;
constexpr std::array<double, 4> moduli = {1e5, 1e7, 1e9, 1e11};
constexpr std::array<double, 3> steps = {1e-4, 1e-3, 1.0 / 60};

/// A body in free fall, turning, far from everything and too strong to break.
Scene falling_scene(const TetMesh& mesh, double young_modulus, double time_step) {
  Scene scene;
  scene.integrator.time_step = time_step;
  scene.bodies.push_back({.mesh = mesh,
                          .material = {.young_modulus = young_modulus, .tensile_strength = 1e15},
                          .translation = {0, 0, 1e4},
                          .spin = {1, 2, 3}});
  scene.obstacles.push_back({Plane{}});
  scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  return scene;
}

/// Adds figures of one body.
struct Sink {
  StepBench& bench;
  std::string body;
  std::size_t tetrahedra;
  double young_modulus = base_modulus, time_step = base_step;
  int runs;

  void add(std::string_view quantity, double value) const {
    bench.figures.push_back(
        {body, tetrahedra, young_modulus, time_step, std::string(quantity), value});
  }
  /// Median of the wall times of `work`, ms, after one that does not count.
  template <class Work>
  double time(int count, const Work& work) const {
    work();
    std::vector<double> times;
    for (int i = 0; i < std::max(1, count); ++i) {
      const double start = wall_us();
      work();
      times.push_back(1e-3 * (wall_us() - start));
    }
    return median(std::move(times));
  }
  template <class Work>
  double measure(std::string_view quantity, int count, const Work& work) const {
    const double value = time(count, work);
    add(quantity, value);
    return value;
  }
};

/// Other factors of the same matrix: Eigen's in our order, and CHOLMOD's in its own.
void measure_others(const ComponentSystem& system, const Sink& sink) {
  using Sparse = Eigen::SparseMatrix<double>;
  const SystemMatrix& matrix = system.step.matrix;
  Sparse A = leading_scalars(system.stiffness, system.free_count);
  A *= matrix.stiffness;
  for (Eigen::Index i = 0; i < A.cols(); ++i) {
    A.coeffRef(i, i) += matrix.mass * system.shape.mass[i / 3];
  }
  const Eigen::VectorXd b = Eigen::VectorXd::Random(A.cols());
  Eigen::VectorXd x = b;
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> llt;
  const int few = std::clamp(sink.runs / 10, 1, 5);
  sink.measure("eigen_analyse", few, [&] { llt.analyzePattern(A); });
  sink.measure("eigen_factor", few, [&] { llt.factorize(A); });
  sink.measure("eigen_solve", 4 * few, [&] {
    x = b;
    llt.matrixL().solveInPlace(x);
    llt.matrixU().solveInPlace(x);
  });
  const auto cholmod = time_cholmod(A, b, x, few);
  if (!cholmod) return;
  sink.add("cholmod_analyse", cholmod->analyse);
  sink.add("cholmod_factor", cholmod->factor);
  sink.add("cholmod_solve", cholmod->solve);
  sink.add("cholmod_difference", cholmod->error);
}

/// The cost of making the constant matrices of the body.
void measure_factor(Simulation& sim, const Sink& sink) {
  const MechanicsState& m = sim.state->mechanics;
  const Component& component = m.components.front();
  const std::span<const Corners> corners = sim.state->cells.map.corners();
  const int runs = sink.runs / 5;
  ComponentSystem& system = *sim.state->mechanics.systems.present.front();
  ComponentSystem other;
  std::vector<std::uint32_t> local_row(m.vertices.size());
  sink.measure("build", runs, [&] { build_system(other, local_row, m, corners, component); });
  const VertexGraph graph = graph_of(system.stiffness, system.free_count);
  sink.measure("analyse", runs, [&] { analyse(graph); });
  const SystemMatrix matrix = system.step.matrix;
  sink.measure("factor", runs, [&] {
    system.step.factored = false;
    factor_system(system, matrix);
  });
  Eigen::VectorXd x = Eigen::VectorXd::Random(static_cast<Eigen::Index>(3 * system.size()));
  AlignedDoubles X(12 * static_cast<std::size_t>(x.size()), 1.0);
  sink.measure("solve_12", runs, [&] { solve_12(X.data(), system.step.factor, system.analysis); });
  sink.add("factor_doubles", static_cast<double>(system.analysis.panel_size));
}

/// The parts of a step, each called by itself, and the step as `advance` takes it.
void measure_step(Simulation& sim, const Sink& sink) {
  MechanicsState& m = sim.state->mechanics;
  MechanicsScratch& scratch = sim.scratch->mechanics;
  const std::span<const Corners> corners = sim.state->cells.map.corners();
  for (int i = 0; i < 3; ++i) advance(sim);
  ComponentSystem& system = *m.systems.present.front();
  const auto dofs = static_cast<Eigen::Index>(3 * system.size());
  Eigen::VectorXd x = Eigen::VectorXd::Random(dofs), y(dofs);
  const double product =
      sink.measure("product", sink.runs, [&] { multiply_stiffness(y, system, x); });
  const double solve = sink.measure("solve", sink.runs, [&] { solve_system(system, x); });
  const Loads loads{.gravity = sim.scene.gravity.acceleration};
  const StepInput input{corners, loads, sim.scene.integrator};
  const ComponentId only = m.components.front().id;
  const double predicted = sink.time(sink.runs, [&] { predict(scratch, m, input, {&only, 1}); });
  sink.add("frame", predicted - product - solve);
  const double stress = sink.measure("element_stress", sink.runs, [&] {
    measure_elements(m, scratch, corners, {.strain = sim.scene.energy_ledger});
  });
  const double criterion = sink.measure("node_stress", sink.runs, [&] {
    break_vertices({sim.state->cells, m}, sim.scene.fracture, sim.scratch->fracture);
  });
  const double whole = sink.measure("step", sink.runs, [&] { advance(sim); });
  sink.add("rest", whole - predicted - stress - criterion);
  sink.add("step_over_solve", whole / solve);
}

/// The `count` vertices of the component that are nearest to its first one.
std::vector<VertexId> vertices_of_crack(const MechanicsState& m, std::size_t count) {
  std::vector<VertexId> nearest = m.components.front().vertices;
  const Vec3 start = m.vertices.rest_position[nearest.front().index()];
  const auto distance = [&](VertexId v) {
    return (m.vertices.rest_position[v.index()] - start).norm();
  };
  std::ranges::stable_sort(nearest, {}, distance);
  nearest.resize(std::min(count, nearest.size()));
  return nearest;
}

/// Splits stars along planes through their vertices; the component stays whole, for mechanics.
void crack(MechanicsState& m, std::vector<Corners>& corners, std::span<const VertexId> vertices) {
  for (const VertexId v : vertices) {
    const Vec3 at = m.vertices.rest_position[v.index()];
    std::vector<std::size_t> star;
    for (std::size_t t = 0; t < corners.size(); ++t) {
      if (std::ranges::find(corners[t], v) != corners[t].end()) star.push_back(t);
    }
    const auto is_above = [&](std::size_t t) {
      Vec3 centre = Vec3::Zero();
      for (const VertexId u : corners[t]) centre += 0.25 * m.vertices.rest_position[u.index()];
      return (centre - at).dot(Vec3(1, 2, 3)) > 0;
    };
    const auto above = std::ranges::partition(star, is_above).begin() - star.begin();
    // A star on one side of the plane is halved all the same.
    const auto moved = above > 0 && above < std::ssize(star) ? above : std::ssize(star) / 2;
    if (moved == 0) continue;
    const VertexId copy = append_copy(m.vertices, v);
    for (std::ptrdiff_t i = 0; i < moved; ++i) {
      std::ranges::replace(corners[star[static_cast<std::size_t>(i)]], v, copy);
    }
  }
}

/// The cost of a crack: with the old factor under a border, or with all built again.
void measure_crack(const Simulation& sim, std::size_t count, const Sink& sink) {
  MechanicsState m = sim.state->mechanics;
  const auto before = sim.state->cells.map.corners();
  std::vector<Corners> corners(before.begin(), before.end());
  crack(m, corners, vertices_of_crack(m, count));
  MechanicsScratch scratch;
  const ComponentId only = m.components.front().id;
  rebuild(m, corners, {&only, 1}, scratch);
  std::vector<std::uint32_t> local_row(m.vertices.size());
  const SystemInput input{m, corners, m.components.front()};
  const ComponentSystem& old = *sim.state->mechanics.systems.present.front();
  const SystemMatrix matrix = old.step.matrix;
  ComponentSystem copy, system, fresh;
  std::vector<double> times;
  for (int run = 0; run < std::max(3, sink.runs / 5); ++run) {
    copy = old;
    const double start = wall_us();
    if (!extend_system(system, copy, local_row, input)) return;
    factor_system(system, matrix);
    times.push_back(1e-3 * (wall_us() - start));
  }
  const std::string name = fmt::format("crack_{}", count);
  const double bordered = median(std::move(times));
  sink.add(name + "_bordered", bordered);
  const double anew = sink.measure(name + "_rebuilt", std::max(3, sink.runs / 5), [&] {
    build_system(fresh, local_row, m, corners, m.components.front());
    factor_system(fresh, matrix);
  });
  Eigen::VectorXd x = Eigen::VectorXd::Random(static_cast<Eigen::Index>(3 * fresh.size()));
  const double plain = sink.time(sink.runs, [&] { solve_system(fresh, x); });
  const double solve = sink.measure(name + "_solve", sink.runs, [&] { solve_system(system, x); });
  sink.add(name + "_even", (anew - bordered) / (solve - plain));
}

/// Whole steps over moduli and steps; largest over least. Simulations take turns, so that the
/// machine's other work slows all of them alike.
std::vector<Finding> measure_range(const TetMesh& mesh, Sink sink) {
  std::vector<Simulation> sims;
  for (const double modulus : moduli) {
    for (const double step : steps) {
      Result<Simulation> built = build_simulation(falling_scene(mesh, modulus, step));
      if (!built) return built.findings;
      sims.push_back(std::move(*built));
    }
  }
  std::vector<std::vector<double>> times(sims.size());
  for (int run = -3; run < sink.runs; ++run) {
    for (std::size_t k = 0; k < sims.size(); ++k) {
      const double start = wall_us();
      advance(sims[k]);
      if (run >= 0) times[k].push_back(1e-3 * (wall_us() - start));
    }
  }
  double least = 0, largest = 0;
  for (std::size_t k = 0; k < sims.size(); ++k) {
    const double time = median(std::move(times[k]));
    sink.young_modulus = moduli[k / steps.size()];
    sink.time_step = steps[k % steps.size()];
    sink.add("step", time);
    least = least == 0 ? time : std::min(least, time);
    largest = std::max(largest, time);
  }
  sink.young_modulus = base_modulus;
  sink.time_step = base_step;
  sink.add("range", largest / least);
  return {};
}

/// Above this a dozen simulations at once would be too many.
constexpr std::size_t most_for_range = 10000;

struct StepBody {
  std::string name;
  TetMesh mesh;
};

Result<std::vector<StepBody>> step_bodies(const StepBenchSettings& settings) {
  Result<std::vector<StepBody>> result;
  result.value.emplace();
  for (const std::filesystem::path& path : settings.meshes) {
    Result<TetMesh> mesh = read_mesh(path);
    if (!mesh) {
      result.value.reset();
      result.findings = std::move(mesh.findings);
      return result;
    }
    result->push_back({path.filename().string(), std::move(*mesh)});
  }
  if (!settings.meshes.empty()) return result;
  result->push_back({"plate", suite::kuhn_box({23, 3, 1}, 0.05)});
  result->push_back({"block", suite::kuhn_box({17, 10, 6}, 0.05)});
  if (settings.large) result->push_back({"large block", suite::kuhn_box({32, 16, 16}, 0.05)});
  return result;
}

}  // namespace

std::vector<StepQuantity> step_quantities() {
  std::vector<StepQuantity> all = {
      {"step", "ms", "Whole step"},
      {"frame", "ms", "  loads, frame, momenta"},
      {"product", "ms", "  product with K"},
      {"solve", "ms", "  back-solve"},
      {"element_stress", "ms", "  element stress and turn"},
      {"node_stress", "ms", "  node stress and threshold tests"},
      {"rest", "ms", "  rest: contact search, ledger, display"},
      {"step_over_solve", "", "Whole step / back-solve"},
      {"range", "", "Largest / least over modulus and step"},
      {"build", "ms", "Build: order, K"},
      {"analyse", "ms", "  of it order and analysis"},
      {"factor", "ms", "Factor"},
      {"solve_12", "ms", "Twelve back-solves at once"},
      {"factor_doubles", "", "Doubles in the factor"},
      {"eigen_analyse", "ms", "SimplicialLLT, same order: analysis"},
      {"eigen_factor", "ms", "  factor"},
      {"eigen_solve", "ms", "  back-solve"},
      {"cholmod_analyse", "ms", "CHOLMOD, own order, OpenBLAS: analysis"},
      {"cholmod_factor", "ms", "  factor"},
      {"cholmod_solve", "ms", "  back-solve"},
      {"cholmod_difference", "", "  difference to Eigen's answer"},
  };
  for (const std::size_t n : crack_sizes) {
    all.push_back({fmt::format("crack_{}_bordered", n), "ms",
                   fmt::format("Crack of {} vertices: K and border", n)});
    all.push_back({fmt::format("crack_{}_rebuilt", n), "ms", "  made again: order, K, factor"});
    all.push_back({fmt::format("crack_{}_solve", n), "ms", "  back-solve under the border"});
    all.push_back(
        {fmt::format("crack_{}_even", n), "", "  back-solves until a new factor is cheaper"});
  }
  return all;
}

Result<StepBench> bench_step(const StepBenchSettings& settings,
                             const std::function<void(const std::string&)>& progress) {
  Result<StepBench> result;
  Result<std::vector<StepBody>> bodies = step_bodies(settings);
  if (!bodies) {
    result.findings = std::move(bodies.findings);
    return result;
  }
  StepBench bench{.machine = machine_name(), .runs = settings.runs, .figures = {}};
  for (const StepBody& body : *bodies) {
    progress(body.name);
    const Sink sink{bench,        body.name, body.mesh.tetrahedra.size(),
                    base_modulus, base_step, settings.runs};
    Result<Simulation> sim = build_simulation(falling_scene(body.mesh, base_modulus, base_step));
    if (sim) {
      measure_step(*sim, sink);
      measure_factor(*sim, sink);
      measure_others(*sim->state->mechanics.systems.present.front(), sink);
      for (const std::size_t n : crack_sizes) measure_crack(*sim, n, sink);
      if (sink.tetrahedra <= most_for_range) {
        sim.findings = measure_range(body.mesh, sink);
      }
    }
    if (!sim || has_error(sim.findings)) {
      result.findings = std::move(sim.findings);
      return result;
    }
  }
  result.value = std::move(bench);
  return result;
}

}  // namespace sunder

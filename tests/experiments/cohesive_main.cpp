// SPDX-License-Identifier: MIT
// `cohesive [MESH... | --cost]`: notched bars pulled apart through ties. It compares the energy of
// the crack with G_c times the section, at steps of any length. Bars are of cubes, or MESHes of the
// box 0.8 x 0.4 x 0.1 m. `--cost`: the time of a sub-step with a growing crack, compared with mode
// `object`.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/state/living.hpp"
#include "tests/experiments/cases/crack_growth.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

constexpr double height = 0.4, thickness = 0.1, energy = 33;  // m, m, J/m^2

struct Pull {
  double speed = 0.05;  ///< m/s, of one end
  double step = 1e-4;   ///< s
  CrackMode crack = CrackMode::cohesive;
};

Scene scene_of(const TetMesh& mesh, const Pull& pull) {
  constexpr double eps = 1e-4;
  BodySettings body;
  body.mesh = mesh;
  body.material.fracture_energy = energy;
  body.held = {{.minimum = {-1, -1, -1}, .maximum = {eps, 9, 9}},
               {.minimum = {2 * height - eps, -1, -1},
                .maximum = {9, 9, 9},
                .velocity = {pull.speed, 0, 0}}};
  body.cuts = {{.faces = CutPlane{.point = {height, 0, 0}, .normal = {1, 0, 0}},
                .box = RestBox{{-1, -1, -1}, {9, 0.25 * height + eps, 9}},
                .ball = {}}};
  Scene scene;
  scene.bodies = {body};
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = pull.step;
  scene.fracture.crack = pull.crack;
  scene.energy_ledger = true;
  return scene;
}

void print(const char* name, const TetMesh& mesh, const Pull& pull) {
  auto built = build_simulation(scene_of(mesh, pull));
  if (!built) throw std::runtime_error(built.findings.front().text);
  Simulation sim = std::move(*built);
  const CrackArea cut = crack_area(sim.state->cells);
  const double section = height * thickness - cut.projected;
  TieReport ties;
  std::size_t fans = 0, sub_steps = 0;
  double residual = 0, moved = 0, shortest = pull.step;
  const auto start = std::chrono::steady_clock::now();
  const double until = 2e-4 / pull.speed;
  while (simulated_time(sim) < until) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    add_part(ties, report.ties);
    fans += report.fracture.fans.size();
    sub_steps += report.impact.sub_steps;
    residual += report.energy.residual;
    moved += report.energy.moved;
    if (report.impact.sub_steps > 0) shortest = std::min(shortest, sim.state->impact.sub_step);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const CrackArea all = crack_area(sim.state->cells);
  std::printf("%-20s %8.3g %8.3g %5zu %6zu %7.3f %9.3f %8.4f %10.4f %8.1e %6zu %7.2f\n", name,
              pull.step, shortest, fans, living_components(sim.state->mechanics).size(),
              (all.raw - cut.raw) / section, (all.projected - cut.projected) / section,
              ties.work / (energy * section), ties.dissipated / (energy * section),
              std::abs(residual) / moved, sub_steps, seconds.count());
  std::fflush(stdout);
}

/// The bar of cubes with its planes x = const inclined by `angle` (rad) in the middle and upright
/// at both ends: a structured mesh that the crack, which wants to be upright, has to cross.
TetMesh inclined(int cells, double angle) {
  TetMesh mesh = suite::kuhn_box({2 * cells, cells, cells / 4}, height / cells);
  for (Point& p : mesh.points) {
    const double share = 1 - std::abs(p[0] - height) / height;
    p[0] += share * std::tan(angle) * (p[1] - 0.5 * height);
  }
  return mesh;
}

/// Sub-steps while a crack runs.
struct CrackCost {
  std::size_t sub_steps = 0, pairs = 0, fans = 0;
  double median = 0, worst = 0;  ///< ms per sub-step
};

CrackCost cost_of(const TetMesh& mesh, const Pull& pull) {
  auto built = build_simulation(scene_of(mesh, pull));
  if (!built) throw std::runtime_error(built.findings.front().text);
  Simulation sim = std::move(*built);
  CrackCost cost;
  std::vector<double> times;
  const double until = 2e-4 / pull.speed;
  while (simulated_time(sim) < until && living_components(sim.state->mechanics).size() < 2) {
    const auto start = std::chrono::steady_clock::now();
    const StepReport report = advance(sim);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    cost.fans += report.fracture.fans.size();
    if (cost.fans == 0 || report.impact.sub_steps == 0) continue;
    const auto sub_steps = static_cast<double>(report.impact.sub_steps);
    cost.sub_steps += report.impact.sub_steps;
    cost.pairs = std::max<std::size_t>(cost.pairs, report.ties.pairs);
    times.push_back(ms.count() / sub_steps);
  }
  if (times.empty()) return cost;
  std::ranges::sort(times);
  cost.median = times[times.size() / 2];
  cost.worst = times.back();
  return cost;
}

/// MB that the process has held at most so far.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void print_cost() {
  std::printf("%-10s %-9s %6s %6s %6s %10s %10s %9s\n", "tetrahedra", "crack", "subs", "fans",
              "pairs", "median/ms", "worst/ms", "peak/MB");
  for (const std::array<int, 3> cells : {std::array{26, 13, 3}, std::array{54, 27, 7}}) {
    const TetMesh mesh = suite::kuhn_box(cells, height / cells[1]);
    for (const CrackMode mode : {CrackMode::object, CrackMode::cohesive}) {
      const CrackCost c = cost_of(mesh, {.step = height / cells[1] / 8000, .crack = mode});
      std::printf("%-10zu %-9s %6zu %6zu %6zu %10.2f %10.2f %9.0f\n", mesh.tetrahedra.size(),
                  mode == CrackMode::object ? "object" : "cohesive", c.sub_steps, c.fans, c.pairs,
                  c.median, c.worst, peak_memory());
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 2 && std::string_view(argv[1]) == "--cost") {
      print_cost();
      return 0;
    }
    std::printf("%-20s %8s %8s %5s %6s %17s %19s %8s\n", "", "", "", "", "", "crack / section",
                "over G_c section", "");
    std::printf("%-20s %8s %8s %5s %6s %7s %9s %8s %10s %8s %6s %7s\n", "mesh", "step", "sub-step",
                "fans", "pieces", "raw", "projected", "work", "dissipated", "residual", "subs",
                "s");
    for (int k = 1; k < argc; ++k) {
      const Result<TetMesh> mesh = read_mesh(std::filesystem::path(argv[k]));
      for (const Finding& f : mesh.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
      if (!mesh) return 3;
      print(argv[k], *mesh, {});
    }
    if (argc > 1) return 0;
    for (const int cells : {4, 8, 16}) {
      const TetMesh mesh = suite::kuhn_box({2 * cells, cells, cells / 4}, height / cells);
      const std::string name = "cubes " + std::to_string(cells);
      for (const double step : {1e-3, 1e-4, 1e-5}) print(name.c_str(), mesh, {.step = step});
    }
    for (const int degrees : {-45, -30, -15, 0, 15, 30, 45}) {
      print(("inclined " + std::to_string(degrees)).c_str(), inclined(16, degrees * M_PI / 180),
            {.speed = 0.01});
    }
    const TetMesh mesh = suite::kuhn_box({16, 8, 2}, height / 8);
    for (const double speed : {0.005, 0.5, 2.0}) {
      print(("cubes 8, " + std::to_string(speed).substr(0, 5) + " m/s").c_str(), mesh,
            {.speed = speed});
    }
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 5;
  }
}

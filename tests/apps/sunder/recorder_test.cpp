// SPDX-License-Identifier: MIT
// Contents of tables, and a run that is interrupted.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/sunder/run/recorder.hpp"
#include "tests/support/shipped.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;

TEST_CASE("every momentum is accounted for to rounding", "[run][recorder]") {
  Simulation simulation = shipped("charts/monolith");
  RunStatistics statistics = begin_statistics(simulation, {});
  double largest = 0;
  while (simulation.state->mechanics.time < 0.06) {
    add_step(statistics, simulation, advance(simulation), 1);
    largest = std::max(largest, statistics.momentum_at_start.norm());
  }
  CHECK(statistics.fans > 0);
  const auto report = run_report(statistics, simulation, fragments(simulation), RunEnd::finished);
  for (const auto& axis : report["momentum"]["supports"]) CHECK(axis.get<double>() == 0);
  for (const auto& axis : report["momentum"]["residual"]) {
    // Hundreds of steps of impulses as large as `largest`: 1e-10 of it is far above their rounding.
    CHECK(std::abs(axis.get<double>()) < 1e-10 * largest);
  }
}

namespace {

/// Places at which vertices are drawn: of their rigid references, smoothed (section 3.3).
std::vector<Vec3> drawn_places(const Simulation& sim) {
  const SimulationState& s = *sim.state;
  std::vector<Vec3> places;
  for (std::size_t v = 0; v < s.mechanics.vertices.size(); ++v) {
    const std::size_t piece = s.mechanics.vertices.component[v].index();
    const Pose& drawn = s.display[piece];
    const Vec3 arm =
        s.mechanics.vertices.rest_position[v] - s.mechanics.components[piece].rest_centre;
    places.push_back(drawn.centre + drawn.orientation * arm);
  }
  return places;
}

}  // namespace

TEST_CASE("references jump where a piece comes off, what is drawn does not", "[run][display]") {
  Scene scene = shipped("paper/block").scene;
  scene.bodies[0].material.tensile_strength = 4e3;
  scene.fracture.crack = CrackMode::paper;
  Result<Simulation> built = build_simulation(scene);
  REQUIRE(built);
  Simulation& sim = *built;
  const double h = sim.scene.integrator.time_step;
  RunStatistics statistics = begin_statistics(sim, {});
  std::vector<Vec3> before = drawn_places(sim);
  std::size_t pieces = 1;
  double most = 0;
  for (int k = 0; k < 1500 && pieces < 2; ++k) {
    const StepReport report = advance(sim);
    add_step(statistics, sim, report, 1);
    pieces = report.components;
    double fastest = 0;
    for (const Vec3& v : sim.state->mechanics.vertices.velocity)
      fastest = std::max(fastest, v.norm());
    const std::vector<Vec3> now = drawn_places(sim);
    for (std::size_t v = 0; v < before.size(); ++v) {
      most = std::max(most, (now[v] - before[v]).norm() - 2 * h * fastest);
    }
    before = now;
  }
  REQUIRE(pieces > 1);
  const auto jump =
      run_report(statistics, sim, fragments(sim), RunEnd::finished)["display"]["largest_jump"];
  CHECK(jump["as_it_is"].get<double>() > 1e-3);
  CHECK(jump["smoothed"].get<double>() < 0.02 * jump["as_it_is"].get<double>());
  CHECK(most < 1.1 * jump["smoothed"].get<double>());
}

TEST_CASE("Ctrl-C ends a run with its files written, exit code 130", "[run][interrupt]") {
  const fs::path out = fs::temp_directory_path() / ("sunder_interrupt_" + std::to_string(getpid()));
  fs::remove_all(out);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    // Steps without end, for our purposes: a hundred simulated seconds.
    execl(SUNDER_PROGRAM, SUNDER_PROGRAM, "run", SUNDER_SCENES "/block.json", "--quiet", "--set",
          "fracture.mode=off", "--set", "duration=100", "--set", "output.frame_interval=0.001",
          "-o", out.c_str(), nullptr);
    _exit(127);
  }
  // Once a step has its frame the signal is waited for, however slow the machine.
  const fs::path first = out / "frames/frame_000001.vtu";
  while (!fs::exists(first) && waitpid(child, nullptr, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  std::ifstream in(out / "report.json");
  const auto report = nlohmann::json::parse(in, nullptr, false);
  REQUIRE(report.is_object());
  CHECK(report["end"] == "interrupted");
  CHECK(report["steps"].get<int>() > 0);
  CHECK(fs::exists(out / "frames/frame_000001.vtu"));
  CHECK(fs::exists(out / "fragments.csv"));
  fs::remove_all(out);
}

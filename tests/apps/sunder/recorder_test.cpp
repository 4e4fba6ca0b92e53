// SPDX-License-Identifier: MIT
// When frames are due, what tables hold, what progress says, and a run that is interrupted.
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

#include "apps/sunder/run/progress.hpp"
#include "apps/sunder/run/recorder.hpp"

using namespace sunder;
namespace fs = std::filesystem;

namespace {

Simulation shipped(const char* name) {
  auto file = read_scene(std::string(SUNDER_SCENES "/") + name + ".json");
  REQUIRE(file);
  auto simulation = build_simulation(file->scene);
  REQUIRE(simulation);
  return std::move(*simulation);
}

}  // namespace

TEST_CASE("frames are spread evenly with both ends, or by their interval", "[run][recorder]") {
  using Steps = std::vector<std::uint64_t>;
  CHECK(even_steps(100, 0).empty());
  CHECK(even_steps(100, 1) == Steps{100});
  CHECK(even_steps(100, 3) == Steps{0, 50, 100});
  CHECK(even_steps(2, 10) == Steps{0, 1, 2});
  Scene scene;
  scene.integrator.time_step = 1e-3;
  scene.duration = 0.01;
  CHECK(step_count(scene) == 10);
  CHECK(interval_steps(scene, 4e-3) == Steps{0, 4, 8});
  // No frame falls between two steps.
  CHECK(interval_steps(scene, 1e-5).size() == 11);
  scene.duration = 0.0101;
  CHECK(step_count(scene) == 11);
}

TEST_CASE("fragments share mass and surface, and were parted by the faces that split",
          "[run][recorder]") {
  auto file = read_scene(std::string(SUNDER_SCENES "/monolith.json"));
  REQUIRE(file);
  file->scene.bodies[0].material.tensile_strength = 1e6;
  Simulation sim = std::move(*build_simulation(file->scene));
  const Origins from = origins(sim.scene.bodies);
  const Fragment whole = fragments(sim.state->cells, sim.state->mechanics, from).at(0);
  CHECK(whole.crack_area == 0);
  CHECK(whole.parent.is_none());
  double split = 0;
  for (int i = 0; i < 240; ++i) {
    for (const FanEvent& fan : advance(sim).fracture.fans) {
      for (const FaceSplit& face : fan.faces) {
        std::array<Vec3, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = Vec3(sim.state->cells.map.point(face.vertices[k]).data());
        split += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
      }
    }
  }
  const auto pieces = fragments(sim.state->cells, sim.state->mechanics, from);
  REQUIRE(pieces.size() > 1);
  double mass = 0, surface = 0, cracks = 0;
  for (const Fragment& f : pieces) {
    mass += f.mass;
    surface += f.surface;
    cracks += f.crack_area;
    if (!f.parent.is_none()) CHECK(f.parent < f.id);
  }
  CHECK(mass == Approx(whole.mass).epsilon(1e-12));
  CHECK(surface - cracks == Approx(whole.surface).epsilon(1e-12));
  CHECK(cracks == Approx(2 * split).epsilon(1e-12));
}

TEST_CASE("fragments of an intact body have the solid's mass, volume and inertia",
          "[run][recorder]") {
  const Simulation simulation = shipped("monolith");
  const std::vector<Fragment> pieces = fragments(simulation.state->cells, simulation.state->mechanics,
                                                 origins(simulation.scene.bodies));
  REQUIRE(pieces.size() == 1);
  const Fragment& slab = pieces[0];
  // A box of 1 x 0.3 x 2 m with 2400 kg/m^3. The sums are over 413 tetrahedra: 1e-12 is ample.
  CHECK(slab.volume == Approx(0.6).epsilon(1e-12));
  CHECK(slab.mass == Approx(1440).epsilon(1e-12));
  CHECK(slab.tetrahedra == simulation.state->cells.map.tetrahedra());
  // The mass centre is that of lumped vertices; for a linear field it is the solid's.
  CHECK((slab.center - Vec3(0, 0, 1)).norm() < 1e-12);
  CHECK(slab.inertia(0, 0) == Approx(1440 * (0.09 + 4) / 12).epsilon(1e-12));
  CHECK(slab.inertia(1, 1) == Approx(1440 * (1.0 + 4) / 12).epsilon(1e-12));
  CHECK(slab.inertia(2, 2) == Approx(1440 * (1.0 + 0.09) / 12).epsilon(1e-12));
  const std::string csv = fragments_csv(pieces);
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 2);
  const std::string header = csv.substr(0, csv.find('\r'));
  const std::string row = csv.substr(csv.find('\n') + 1);
  CHECK(std::count(header.begin(), header.end(), ',') == std::count(row.begin(), row.end(), ','));
}

TEST_CASE("momentum that no support took is accounted for to rounding", "[run][recorder]") {
  Simulation simulation = shipped("monolith");
  RunStatistics statistics = begin_statistics(simulation, {});
  double largest = 0;
  while (simulation.state->mechanics.time < 0.06) {
    add_step(statistics, simulation, advance(simulation), 1);
    largest = std::max(largest, statistics.momentum.start.norm());
  }
  CHECK(statistics.fans > 0);
  const auto report = run_report(statistics, simulation,
                                 fragments(simulation.state->cells, simulation.state->mechanics,
                                           origins(simulation.scene.bodies)),
                                 RunEnd::finished);
  for (const auto& axis : report["momentum"]["supports"]) {
    // Hundreds of steps of impulses as large as `largest`: 1e-10 of it is far above their rounding.
    CHECK(std::abs(axis.get<double>()) < 1e-10 * largest);
  }
}

TEST_CASE("a line of progress tells step, time, pieces, fans and what is left", "[run][progress]") {
  const std::string line = progress_line({50, 200, 0.05, 3, 7}, 10, 8);
  CHECK(line == "[##------] step 50/200  t = 0.0500 s  3 pieces  7 fans  0:30 left");
  CHECK(progress_line({0, 200, 0, 1, 0}, 10, 0) == "step 0/200  t = 0.0000 s  1 pieces  0 fans");
}

TEST_CASE("Ctrl-C ends a run after its step with its files written, exit code 130",
          "[run][interrupt]") {
  const fs::path out = fs::temp_directory_path() / ("sunder_interrupt_" + std::to_string(getpid()));
  fs::remove_all(out);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    // Steps without end, for our purposes: a thousand simulated seconds.
    execl(SUNDER_PROGRAM, SUNDER_PROGRAM, "run", SUNDER_SCENES "/block.json", "--quiet", "--set",
          "fracture.mode=off", "--set", "duration=1000", "-o", out.c_str(), nullptr);
    _exit(127);
  }
  // Once the first frame stands the signal is waited for, however slow the machine.
  const fs::path first = out / "frames.pvd";
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

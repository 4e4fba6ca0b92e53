// SPDX-License-Identifier: MIT
// A simulation goes on to the same bytes after a pause, and with new scratch in every step; and
// faults of a file are reported.
#include "fracture/saving/saved_state.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "mechanics/solver/component_system.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Events without which a run would test nothing.
struct Seen {
  std::size_t fans = 0, sub_steps = 0, bordered = 0, settled = 0;
  std::array<std::size_t, rung_count> rungs{};
};

void note(Seen& seen, const StepReport& report, const Simulation& sim) {
  seen.fans += report.fracture.fans.size();
  seen.sub_steps += report.impact.sub_steps;
  seen.settled += report.cracks.size();
  for (std::size_t k = 0; k < rung_count; ++k) seen.rungs[k] += report.ladder.components[k];
  for (const auto& system : sim.state->mechanics.systems.present) {
    seen.bordered += system && !system->border.columns.empty();
  }
}

/// Runs a scene three times at once: as it is, saved and restored every `pause` steps, and with new
/// scratch in every step.
Seen run_paused(const Scene& scene, int steps, int pause) {
  Simulation whole = built(scene), paused = built(scene), bare = built(scene);
  Seen seen;
  for (int k = 0; k < steps; ++k) {
    INFO("step " << k);
    const StepReport report = advance(whole);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    note(seen, report, whole);
    *bare.scratch = SimulationScratch{};
    const StepReport paused_report = advance(paused), bare_report = advance(bare);
    REQUIRE(test::first_difference(whole, paused) == "");
    REQUIRE(test::first_difference(whole, bare) == "");
    for (const StepReport* other : {&paused_report, &bare_report}) {
      CHECK(other->energy.residual == report.energy.residual);
      CHECK(other->fracture.tested == report.fracture.tested);
      CHECK(other->contact.iterations == report.contact.iterations);
    }
    if (k % pause != 0) continue;
    const std::string bytes = saved_state(paused);
    REQUIRE(bytes == saved_state(whole));
    Result<Simulation> restored = restore(bytes);
    REQUIRE(restored);
    paused = std::move(*restored);
  }
  CHECK(saved_state(whole) == saved_state(paused));
  CHECK(saved_state(whole) == saved_state(bare));
  return seen;
}

/// A bar that falls on a sphere and breaks over it.
Scene breaking_scene(const IntegratorSettings& integrator) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back({.name = "bar",
                          .mesh = jittered(kuhn_box({6, 2, 2}, 0.1), 0.01, 4),
                          .material = {.young_modulus = 1e8, .tensile_strength = 2e5},
                          .translation = {-0.3, -0.1, 0.21},
                          .velocity = {0, 0, -4}});
  scene.obstacles = {Obstacle{Sphere{{0, 0, 0.1}, 0.1}}, Obstacle{Plane{}}};
  scene.integrator.time_step = 1e-3;
  scene.integrator = integrator;
  return scene;
}

/// A small body on the floor that a free sphere strikes: the smallest state with a bit of
/// everything.
Simulation small_one() {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back({.name = "block",
                          .mesh = kuhn_box({2, 1, 1}, 0.1),
                          .material = {.young_modulus = 1e8, .tensile_strength = 1e5},
                          .translation = {-0.1, 0, 0},
                          .velocity = {0, 0, -3}});
  scene.bodies.front().mesh.region_name[3] = "stone";
  scene.obstacles = {
      Obstacle{Plane{}},
      Obstacle{.shape = Sphere{{0, 0, 0.4}, 0.05}, .velocity = {0, 0, -5}, .mass = 1}};
  Simulation sim = built(scene);
  for (int k = 0; k < 20; ++k) advance(sim);
  REQUIRE(sim.state->fans > 0);
  return sim;
}

/// The bytes with a checksum that is right for them.
std::string sealed(std::string bytes) {
  bytes.resize(std::max<std::size_t>(bytes.size(), 8));
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) {
    hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
  }
  for (std::size_t i = 0; i < 8; ++i)
    bytes[bytes.size() - 8 + i] = static_cast<char>(hash >> 8 * i);
  return bytes;
}

std::string code_of(const Result<Simulation>& result) {
  REQUIRE_FALSE(result);
  REQUIRE(result.findings.size() == 1);
  CHECK_FALSE(result.findings.front().remedy.empty());
  return result.findings.front().code;
}

}  // namespace

TEST_CASE("a breaking body goes on to the same bytes under every integrator and model",
          "[fracture][saved_state]") {
  using enum Integrator;
  std::vector<IntegratorSettings> methods = other_methods();
  methods.push_back({.integrator = floating_frame});
  methods.push_back({.integrator = verlet});
  for (std::size_t k = 0; k < methods.size(); ++k) {
    INFO("method " << k);
    Scene scene = breaking_scene(methods[k]);
    if (methods[k].integrator == verlet) scene.integrator.time_step = 1e-4;
    const Seen seen = run_paused(scene, methods[k].integrator == verlet ? 150 : 40, 7);
    CHECK(seen.fans > 0);
  }
}

TEST_CASE("cracks go on to the same bytes however they are found", "[fracture][saved_state]") {
  std::vector<FractureSettings> ways(5);
  ways[0].node_stress = NodeStress::fit;
  ways[1].relax = 1;
  ways[2].criterion = FractureCriterion::energy;
  ways[3].mode = FractureMode::budget;
  ways[3].max_fans = 1;
  for (FractureSettings& way : ways) way.crack = CrackMode::paper;
  ways[4].crack = CrackMode::object;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    INFO("way " << k);
    Scene scene = breaking_scene({});
    scene.bodies.front().material.toughness = 2e4;
    scene.bodies.front().strength.weibull = WeibullSettings{};
    scene.fracture = ways[k];
    CHECK(run_paused(scene, 40, 3).fans > 0);
  }
}

TEST_CASE("windows, borders and open cracks go on to the same bytes", "[fracture][saved_state]") {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.integrator.time_step = 1e-4;
  scene.bodies.push_back({.mesh = kuhn_box({6, 4, 3}, 0.05),
                          .material = {.tensile_strength = 3e6},
                          .translation = {0, 0, 0.26},
                          .rotation = Eigen::Quaterniond(0.9, 0.3, 0.2, 0.1).normalized(),
                          .velocity = {0, 0, -4}});
  scene.obstacles.push_back({Plane{}});
  scene.fracture.mode = FractureMode::budget;
  scene.fracture.max_fans = 1;
  const Seen seen = run_paused(scene, 500, 23);
  CHECK(seen.fans > 0);
  CHECK(seen.sub_steps > 0);
  CHECK(seen.bordered > 0);
  CHECK(seen.settled > 0);
}

TEST_CASE("what sleeps, flies and creeps goes on to the same bytes", "[fracture][saved_state]") {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.ladder.sleep_after = 0.01;
  scene.bodies.push_back({.mesh = kuhn_box({2, 2, 2}, 0.1), .translation = {0, 0, 0}});
  scene.bodies.push_back(
      {.mesh = kuhn_box({2, 1, 1}, 0.1), .translation = {1, 0, 1}, .spin = {0, 0, 3}});
  scene.bodies.push_back({.mesh = kuhn_box({3, 1, 1}, 0.1),
                          .translation = {3, 0, 1},
                          .held = {{{0, 0, 0}, {0, 1, 1}}},
                          .loads = {{.minimum = {0.29, 0, 0},
                                     .maximum = {1, 1, 1},
                                     .force = {0, 0, -100},
                                     .ramp_time = 0.05}}});
  scene.obstacles.push_back({Plane{}});
  const Seen seen = run_paused(scene, 160, 11);
  // The rubble has a test of its own (simulation/rubble).
  for (const Rung rung : {Rung::full, Rung::quasi_static, Rung::rigid, Rung::asleep}) {
    INFO("rung " << static_cast<int>(rung));
    CHECK(seen.rungs[static_cast<std::size_t>(rung)] > 0);
  }
}

TEST_CASE("a script goes on where it stood", "[fracture][saved_state]") {
  Scene scene = breaking_scene({});
  scene.fracture.crack = GENERATE(CrackMode::paper, CrackMode::object);
  Simulation first = built(scene);
  FanScript script;
  for (int k = 0; k < 30; ++k) {
    const StepReport report = advance(first);
    for (std::size_t f = 0; f < report.fracture.fans.size(); ++f) {
      const FanEvent& fan = report.fracture.fans[f];
      script.fans.push_back({{report.step, report.fan_part[f]},
                             fan.round,
                             fan.vertex,
                             fan.normal,
                             fan.stress,
                             fan.strength,
                             fan.crack,
                             fan.anchor,
                             fan.labels});
    }
  }
  REQUIRE(script.fans.size() > 1);
  Simulation again = built(scene);
  again.state->script = script;
  for (int k = 0; k < 30; ++k) {
    REQUIRE_FALSE(advance(again).departed);
    Result<Simulation> restored = restore(saved_state(again));
    REQUIRE(restored);
    again = std::move(*restored);
  }
  CHECK(again.state->script->next == script.fans.size());
  CHECK(test::first_difference(first, again) == "");
}

TEST_CASE("a file is written whole, read back with its scene, and its faults are named",
          "[fracture][saved_state]") {
  const Simulation sim = small_one();
  const auto path = std::filesystem::temp_directory_path() / "sunder_saved_state_test";
  REQUIRE(save(sim, path).empty());
  const Result<Simulation> loaded = load(path);
  REQUIRE(loaded);
  CHECK(saved_state(*loaded) == saved_state(sim));
  CHECK(loaded->scene.bodies.front().mesh.region_name.at(3) == "stone");
  CHECK(loaded->bodies.front().end_tetrahedron == sim.bodies.front().end_tetrahedron);

  std::ofstream(path) << "{\"bodies\": []}";
  const Result<Simulation> scene = load(path);
  CHECK(code_of(scene) == "not_a_saved_state");
  CHECK(scene.findings.front().file == path.string());
  std::filesystem::remove(path);
  CHECK(code_of(load(path)) == "cannot_open");
  CHECK(save(sim, path / "no_such_folder" / "state").front().code == "cannot_write");

  std::string other = saved_state(sim);
  other[8] = static_cast<char>(saved_state_format + 1);
  CHECK(code_of(restore(sealed(other))) == "other_version");
}

TEST_CASE("no damaged state is restored", "[fracture][saved_state]") {
  const std::string bytes = saved_state(small_one());
  REQUIRE(restore(bytes));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    INFO("cut off after " << size);
    REQUIRE(code_of(restore(std::string_view(bytes).substr(0, size))) ==
            (size < 8 ? "not_a_saved_state" : "damaged"));
  }
  std::mt19937_64 random(14);
  for (int k = 0; k < 1000; ++k) {
    std::string flipped = bytes;
    const std::size_t place = 12 + random() % (bytes.size() - 12);
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << random() % 8));
    INFO("a bit of byte " << place);
    REQUIRE(code_of(restore(flipped)) == "damaged");
  }
}

TEST_CASE("a state that ends early is refused even where its checksum is right",
          "[fracture][saved_state]") {
  const std::string bytes = saved_state(small_one());
  std::mt19937_64 random(15);
  for (int k = 0; k < 1000; ++k) {
    const std::size_t size = 20 + random() % (bytes.size() - 20);
    INFO("cut off after " << size);
    REQUIRE(code_of(restore(sealed(bytes.substr(0, size)))) == "damaged");
  }
  // Counts of more than there is: refused before anything is allocated for them.
  std::size_t refused = 0;
  for (std::size_t place = 12; place + 16 < bytes.size(); place += 8) {
    std::string huge = bytes;
    for (std::size_t i = 0; i < 8; ++i) huge[place + i] = static_cast<char>(i < 6 ? 0xff : 0);
    refused += !restore(sealed(huge));
  }
  CHECK(refused > 10);
}

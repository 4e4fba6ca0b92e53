// SPDX-License-Identifier: MIT
// Results depend neither on the number of threads nor on the topology's kernel.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/solver/parallel.hpp"

using namespace sunder;

namespace {

/// The bunny on the floor, shattered for some sub-steps: a thousand pieces, hundreds of contacts on
/// the largest.
Simulation shattered(unsigned threads) {
  const std::vector<std::string> settings = {"time_step=5e-5"};
  Result<SceneFile> file = read_scene(SUNDER_SCENES "/paper/bunny.json", settings);
  REQUIRE(file);
  Result<Simulation> sim = build_simulation(std::move(file->scene));
  REQUIRE(sim);
  sim->threads = threads;
  while (sim->state->step < 414) {
    REQUIRE(advance(*sim).status.outcome == StepOutcome::fine);
  }
  return std::move(*sim);
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

}  // namespace

TEST_CASE("A shattering body takes the same bytes on one, two and three threads",
          "[run][threads]") {
  const Simulation alone = shattered(1);
  REQUIRE(alone.state->fans > 500);
  for (const unsigned threads : {2u, 3u}) {
    const Simulation together = shattered(threads);
    CHECK(together.state->fans == alone.state->fans);
    const VertexColumns &a = alone.state->mechanics.vertices,
                        &b = together.state->mechanics.vertices;
    CHECK(same_bytes(a.position, b.position));
    CHECK(same_bytes(a.velocity, b.velocity));
    CHECK(same_bytes(a.displacement, b.displacement));
    CHECK(same_bytes(alone.state->mechanics.elements.stress,
                     together.state->mechanics.elements.stress));
  }
}

TEST_CASE("A scene takes the same bytes by rows and by CGAL's darts", "[run][kernel]") {
  const auto [scene, steps] =
      GENERATE(std::pair<const char*, std::uint64_t>("charts/monolith", 330),
               std::pair<const char*, std::uint64_t>("bar", 300));
  INFO(scene);
  std::vector<Simulation> by;
  for (const char* kernel : {"dense", "lcc"}) {
    const std::vector<std::string> settings = {std::string("topology.kernel=") + kernel};
    Result<SceneFile> file = read_scene(std::string(SUNDER_SCENES "/") + scene + ".json", settings);
    REQUIRE(file);
    Result<Simulation> sim = build_simulation(std::move(file->scene));
    REQUIRE(sim);
    while (sim->state->step < steps) REQUIRE(advance(*sim).status.outcome == StepOutcome::fine);
    CHECK(check(sim->state->cells.map).empty());
    by.push_back(std::move(*sim));
  }
  CHECK(by[0].state->cells.map.kernel() == MapKernel::dense);
  CHECK(by[1].state->cells.map.kernel() == MapKernel::lcc);
  CHECK(by[0].state->fans > 10);
  // All saved data but the one word that differs.
  for (Simulation& sim : by) sim.scene.topology = {};
  CHECK(saved_state(by[0]) == saved_state(by[1]));
}

TEST_CASE("Work in parallel is done once each, and what it throws arrives", "[run][threads]") {
  for (const unsigned threads : {0u, 1u, 2u, 7u}) {
    std::vector<std::atomic<int>> done(100);
    parallel_for(threads, done.size(), [&](std::size_t k, unsigned worker) {
      if (worker >= std::max(threads, 1u)) throw std::logic_error("no such worker");
      ++done[k];
    });
    for (const auto& count : done) CHECK(count == 1);
    CHECK_THROWS_AS(parallel_for(threads, 100,
                                 [](std::size_t k, unsigned) {
                                   if (k == 50) throw std::runtime_error("broken");
                                 }),
                    std::runtime_error);
  }
}

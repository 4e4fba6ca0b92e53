// SPDX-License-Identifier: MIT
// Steps without contact and cracks allocate no memory once their buffers are large enough.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <new>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace {

/// Calls of operator new in this program since it began.
std::size_t allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* p = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, 16); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace sunder;

TEST_CASE("a step without contact and cracks allocates nothing after the first ones",
          "[fracture][step]") {
  const auto [held, ladder] = GENERATE(std::pair{false, false}, std::pair{true, false},
                                       std::pair{false, true}, std::pair{true, true});
  {
    INFO((held ? "held, loaded and damped" : "falling and turning"));
    INFO((ladder ? "on the ladder" : "always full"));
    Scene scene;
    scene.ladder = {.rigid = ladder, .quasi_static = ladder, .sleep = ladder};
    scene.bodies.push_back({.mesh = suite::kuhn_box({6, 3, 2}, 0.1),
                            .material = {.tensile_strength = 1e12},
                            .translation = {0, 0, 100},
                            .spin = {1, 2, 3}});
    scene.obstacles.push_back({Plane{}});
    if (held) {
      scene.bodies[0].spin.setZero();
      scene.bodies[0].held.push_back({{-1, -1, -1}, {0.05, 1, 1}});
      scene.bodies[0].loads.push_back({{0.55, -1, -1}, {1, 1, 1}, 1e4, {0, 0, -10}, 0.01});
      scene.integrator.damping.stiffness_factor = 1e-5;
    }
    Result<Simulation> sim = build_simulation(scene);
    REQUIRE(sim);
    for (int i = 0; i < 100; ++i) advance(*sim);  // rungs are chosen, too
    const std::size_t before = allocations;
    for (int i = 0; i < 20; ++i) advance(*sim);
    CHECK(allocations == before);
  }
}

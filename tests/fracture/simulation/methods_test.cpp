// SPDX-License-Identifier: MIT
// Every integrator and model in a scene that falls and breaks; refusals by bounded ones.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

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
  scene.integrator = integrator;
  scene.integrator.time_step = 1e-3;
  return scene;
}

/// The bar built, without the warning that it is two cells thick.
Result<Simulation> built_bar(const Scene& scene) {
  Result<Simulation> sim = build_simulation(scene);
  std::erase_if(sim.findings, [](const Finding& f) { return f.code == "few_layers"; });
  return sim;
}

}  // namespace

TEST_CASE("every integrator and model takes a scene that falls and breaks",
          "[fracture][baselines]") {
  std::size_t k = 0;
  for (const IntegratorSettings& method : other_methods()) {
    INFO("method " << k++);
    Result<Simulation> sim = build_simulation(breaking_scene(method));
    for (const Finding& f : sim.findings) UNSCOPED_INFO(f.code << ": " << f.text);
    REQUIRE(sim);
    const auto mass = [&] {
      const auto& m = sim->state->mechanics.vertices.mass;
      return std::accumulate(m.begin(), m.end(), 0.0);
    };
    const double before = mass();
    std::size_t fans = 0;
    for (int i = 0; i < 40; ++i) {
      const StepReport report = advance(*sim);
      REQUIRE(report.status.outcome == StepOutcome::fine);
      fans += report.fracture.fans.size();
    }
    CHECK(fans > 0);
    CHECK(mass() == Approx(before).epsilon(1e-12));
  }
}

TEST_CASE("a body that is held everywhere stays where it is, by every integrator and model",
          "[fracture][baselines]") {
  std::size_t k = 0;
  for (const IntegratorSettings& method : other_methods()) {
    INFO("method " << k++);
    Scene scene = breaking_scene(method);
    scene.bodies[0].velocity = {0, 0, 0};
    scene.bodies[0].held = {{.minimum = {-9, -9, -9}, .maximum = {9, 9, 9}}};
    Result<Simulation> sim = build_simulation(scene);
    REQUIRE(sim);
    const std::vector<Vec3> before = sim->state->mechanics.vertices.position;
    for (int i = 0; i < 3; ++i) REQUIRE(advance(*sim).status.outcome == StepOutcome::fine);
    double moved = 0;
    for (std::size_t v = 0; v < before.size(); ++v) {
      moved = std::max(moved, (sim->state->mechanics.vertices.position[v] - before[v]).norm());
    }
    CHECK(moved < 1e-14);  // m; rounding where a frame is left and entered
  }
}

TEST_CASE("contact by penalty breaks the bar without impact windows, and long steps are warned of",
          "[fracture][baselines]") {
  Scene scene = breaking_scene({});
  scene.contact.method = ContactMethod::penalty;
  Result<Simulation> sim = built_bar(scene);
  REQUIRE(sim);
  CHECK(sim.findings.empty());
  const double m = std::ranges::min(sim->state->mechanics.vertices.mass);
  std::size_t fans = 0;
  for (int i = 0; i < 100; ++i) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    CHECK(report.impact.opened == 0);
    fans += report.fracture.fans.size();
  }
  CHECK(fans > 0);
  // The bound of a vertex on a spring with a damper, from the roots of its two by two map.
  const double h = 1e-3, c = 0.5 * m / h;
  scene.contact.penalty_damping = c;
  for (const double part : {0.999, 1.001}) {
    scene.contact.penalty_stiffness = part * (4 * m - 2 * c * h) / (h * h);
    const Result<Simulation> again = built_bar(scene);
    REQUIRE(again);
    const bool warned = !again.findings.empty();
    CHECK(warned == (part > 1));
    if (warned) CHECK(again.findings[0].code == "penalty_step_too_long");
  }
}

TEST_CASE("counts and sizes beyond an integrator's bounds are refused, explicit steps warned of",
          "[fracture][baselines]") {
  const auto refusal = [](IntegratorSettings settings, double young_modulus = 3e10) {
    Scene scene = breaking_scene(settings);
    scene.bodies[0].material.young_modulus = young_modulus;
    if (settings.integrator == Integrator::modal) {
      scene.bodies[0].mesh = kuhn_box({9, 8, 8}, 0.1);
    }
    const Result<Simulation> sim = build_simulation(std::move(scene));
    REQUIRE_FALSE(sim);
    CHECK_FALSE(sim.findings.back().remedy.empty());
    return sim.findings.back().code;
  };
  CHECK(refusal({.integrator = Integrator::sub_stepped, .max_sub_steps = 10}) ==
        "too_many_sub_steps");
  CHECK(refusal({.integrator = Integrator::modal}) == "body_too_large_for_modal");
  CHECK(refusal({.model = ElasticModel::corotational}) == "model_not_supported");
  CHECK(refusal({.integrator = Integrator::modal, .damping = {.mass_factor = 1}}) ==
        "damping_not_supported");
  Result<Simulation> sim = built_bar(breaking_scene({.integrator = Integrator::verlet}));
  REQUIRE(sim);
  REQUIRE(sim.findings.size() == 1);
  CHECK(sim.findings[0].code == "explicit_step_too_long");
  CHECK(sim.findings[0].severity == Severity::warning);
}

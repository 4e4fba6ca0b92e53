// SPDX-License-Identifier: MIT
// Equilibrium of scenes: closed forms, balance at supports, loads in runs, and the command's ends.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/sunder/static/static_fan.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using nlohmann::json;

namespace {

/// A bar along x of `cells`, 0.1 m each, held at x = 0 (nu = 0).
Scene held_bar(const std::array<int, 3>& cells) {
  Scene scene;
  BodySettings bar;
  bar.mesh = suite::kuhn_box(cells, 0.1);
  bar.material = {.young_modulus = 1e9, .poisson_ratio = 0, .density = 1000};
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  scene.bodies.push_back(std::move(bar));
  scene.gravity.acceleration.setZero();
  return scene;
}

LoadBox end_of(double length) {
  return {.minimum = {length - 1e-6, -1, -1}, .maximum = {length + 1, 9, 9}};
}

Equilibrium solved(const Scene& scene) {
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  Result<Equilibrium> answer = solve_scene(*sim);
  REQUIRE(answer);
  return std::move(*answer);
}

std::string code_of(const Scene& scene) {
  Result<Simulation> sim = build_simulation(scene);
  if (!sim) return sim.findings.front().code;
  const Result<Equilibrium> answer = solve_scene(*sim);
  return answer ? "" : answer.findings.back().code;
}

/// Runs `sunder static` in a folder of its own.
struct Place {
  test::Folder folder;

  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  test::Outcome run(const json& scene, const std::string& words) const {
    std::ofstream(path("scene.json")) << scene.dump(1);
    return test::run_program("static " + path("scene.json") + " " + words);
  }
};

json cube_scene() {
  return {{"bodies",
           {{{"name", "cube"},
             {"mesh", SUNDER_MESHES "/cube.msh"},
             {"held", {{{"minimum", {-9, -9, -9}}, {"maximum", {9, 9, 0}}}}}}}}};
}

}  // namespace

TEST_CASE("a pressure on a bar's end gives p everywhere and p L / E at the end",
          "[run][static][loads]") {
  Scene scene = held_bar({8, 2, 2});
  LoadBox pull = end_of(0.8);
  pull.pressure = -2e5;
  scene.bodies[0].loads = {pull};
  // A turned and moved body has the same answer, its forces turned.
  scene.bodies[0].rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
  scene.bodies[0].translation = {3, -2, 1};
  const BodyEquilibrium bar = solved(scene).bodies[0];
  // Uniaxial stress with nu = 0 is in the space of linear tetrahedra: exact to rounding of the
  // solve, condition (L/h)^2 times 2e-16 with a margin of 1e3.
  CHECK(bar.displacement.value == Approx(2e5 * 0.8 / 1e9).epsilon(1e-10));
  CHECK(bar.principal_stress.value == Approx(2e5).epsilon(1e-10));
  CHECK(bar.strength_share.value == Approx(2e5 / 3e6).epsilon(1e-10));
  CHECK(bar.strain_energy == Approx(0.5 * 2e5 * 0.04 * 2e5 * 0.8 / 1e9).epsilon(1e-10));
  const Vec3 pulled = scene.bodies[0].rotation * Vec3(2e5 * 0.04, 0, 0);
  CHECK((bar.load - pulled).norm() < 1e-10 * pulled.norm());
  CHECK((bar.supports[0].force + pulled).norm() < 1e-10 * pulled.norm());
  CHECK(bar.residual < 1e-10 * pulled.norm());
  CHECK((scene.bodies[0].rotation.conjugate() *
         (bar.displacement.position - scene.bodies[0].translation))
            .x() == Approx(0.8));
}

TEST_CASE("supports carry weight and moment of what they hold", "[run][static][loads]") {
  Scene scene = held_bar({6, 2, 2});
  scene.gravity.acceleration = {0, 0, -10};
  LoadBox tip = end_of(0.6);
  tip.force = {3, -7, 11};
  scene.bodies[0].loads = {tip};
  const BodyEquilibrium bar = solved(scene).bodies[0];
  const double weight = 1000 * 0.6 * 0.04 * 10;
  const Vec3 load = Vec3(0, 0, -weight) + tip.force;
  CHECK((bar.load - load).norm() < 1e-11 * weight);
  CHECK((bar.supports[0].force + load).norm() < 1e-8 * weight);
  // The force is spread evenly over the end's vertices, about its middle (0.6, 0.1, 0.1); the
  // moment is about the mass centre (0.3, 0.1, 0.1).
  const Vec3 moment = -Vec3(0.3, 0, 0).cross(tip.force);
  CHECK((bar.supports[0].moment - moment).norm() < 1e-8 * weight);
  CHECK(bar.supports[0].vertices == 9);
}

TEST_CASE("held vertices stand where their velocity brings them by the end",
          "[run][static][supports]") {
  Scene scene = held_bar({8, 1, 1});
  scene.duration = 2;
  scene.bodies[0].held.push_back(
      {.minimum = {0.8 - 1e-6, -1, -1}, .maximum = {9, 9, 9}, .velocity = {4e-5, 0, 0}});
  const BodyEquilibrium bar = solved(scene).bodies[0];
  CHECK(bar.principal_stress.value == Approx(1e9 * 8e-5 / 0.8).epsilon(1e-10));
  CHECK(bar.supports[1].force.x() == Approx(1e5 * 0.01).epsilon(1e-10));
  CHECK(bar.supports[0].force.x() == Approx(-1e5 * 0.01).epsilon(1e-10));
}

TEST_CASE("what cannot be solved is refused with the body's name", "[run][static]") {
  Scene scene = held_bar({4, 1, 1});
  Scene free = scene;
  free.bodies[0].held.clear();
  CHECK(code_of(free) == "not_supported");
  free.bodies[0].name = "slab";
  free.obstacles = {{.shape = Plane{{0, 0, 1}, 0}}};
  Result<Simulation> sim = build_simulation(free);
  const Finding refusal = solve_scene(*sim).findings.back();
  CHECK(refusal.text.find("slab") != std::string::npos);
  CHECK(refusal.text.find("obstacles that carry a body are not supports") != std::string::npos);
  CHECK(refusal.remedy.find("held") != std::string::npos);

  scene.bodies[0].loads = {end_of(0.4)};
  CHECK(code_of(scene) == "no_load");
  scene.bodies[0].loads = {end_of(7)};
  scene.bodies[0].loads[0].force = {1, 0, 0};
  CHECK(code_of(scene) == "nothing_loaded");
  scene.bodies[0].loads[0] = {.minimum = {0.25, -1, -1}, .maximum = {0.35, 9, 9}, .pressure = 1};
  CHECK(code_of(scene) == "nothing_loaded");  // vertices, but no whole face
}

TEST_CASE("a run under slowly raised loads settles at the static answer, its momentum balanced",
          "[run][static][loads]") {
  Scene scene = held_bar({4, 1, 1});
  LoadBox pull = end_of(0.4);
  pull.force = {1000, 0, 0};
  pull.ramp_time = 0.05;
  scene.bodies[0].loads = {pull};
  scene.integrator.time_step = 1e-3;
  scene.integrator.damping.stiffness_factor = 1e-3;
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  Impulse impulse = Impulse::Zero();
  for (int i = 0; i < 100; ++i) impulse += advance(*sim).momentum.loads;
  // The ramp's steps take the load of their ends: sum of i / 50 for 50 steps, then 50 whole ones.
  CHECK(impulse.x() == Approx(1000 * 1e-3 * (25.5 + 50)).epsilon(1e-12));
  double largest = 0;
  for (const Vec3& d : sim->state->mechanics.vertices.displacement) {
    largest = std::max(largest, d.norm());
  }
  CHECK(largest == Approx(solved(scene).bodies[0].displacement.value).epsilon(1e-6));
}

TEST_CASE("loads stay with the sides of a split", "[run][static][loads][split]") {
  Scene scene = held_bar({4, 1, 1});
  scene.bodies[0].held.clear();
  scene.bodies[0].material.tensile_strength = 1e4;
  LoadBox left = end_of(0.4), right = end_of(0.4);
  left = {.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}, .pressure = -1e6};
  right.pressure = -1e6;
  scene.bodies[0].loads = {left, right};
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  std::size_t pieces = 1;
  for (int i = 0; i < 5; ++i) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    pieces = report.components;
    std::vector<Vec3> force;
    add_corner_loads(force, sim->state->loads, sim->state->mechanics,
                     sim->state->cells.map.corners(), 1);
    double pull = 0;
    for (const Vec3& f : force) pull += f.norm();
    // Two ends of 0.01 m^2, each pulled by 1 MPa, on however many vertices.
    CHECK(pull <= 2e4 * (1 + 1e-12));
    CHECK(pull > 1e4);
  }
  CHECK(pieces > 1);
}

TEST_CASE("fans near their threshold are listed by the energy they would release, as one by one",
          "[run][static][fan]") {
  Scene scene = held_bar({4, 2, 2});
  scene.bodies[0].material.tensile_strength = 1e5;
  scene.bodies[0].material.toughness = 1e5;
  scene.bodies[0].cuts = {{.faces = CutPlane{.point = {0.2, 0, 0}, .normal = {1, 0, 0}},
                           .box = RestBox{{-1, -1, -1}, {9, 0.1001, 9}},
                           .ball = {}}};
  LoadBox pull = end_of(0.4);
  pull.pressure = -5e4;
  scene.bodies[0].loads = {pull};
  Simulation sim = std::move(*build_simulation(scene));
  const Equilibrium answer = std::move(*solve_scene(sim));
  const auto all = fan_candidates(sim, answer.node_stress, 0);
  REQUIRE(all);
  REQUIRE(all->size() > 10);
  std::size_t on_front = 0;
  for (std::size_t i = 0; i < all->size(); ++i) {
    const FanCandidate& c = (*all)[i];
    if (i > 0) CHECK(c.fan.release.per_area() <= (*all)[i - 1].fan.release.per_area());
    if (!c.front) continue;
    ++on_front;
    CHECK(sim.state->mechanics.vertices.rest_position[c.fan.point].x() == Approx(0.2));
    const auto list =
        fmt::format("{},{},{},{}", c.fan.point, c.fan.normal[0], c.fan.normal[1], c.fan.normal[2]);
    const auto one = fan_answer(sim, list);
    REQUIRE(one);
    CHECK(one->release.energy == Approx(c.fan.release.energy));
  }
  CHECK(on_front == 3);
  const auto strained = fan_candidates(sim, answer.node_stress, 0.7);
  REQUIRE(strained);
  for (const FanCandidate& c : *strained) CHECK(c.share >= 0.7);
}

TEST_CASE("sunder static answers in JSON, writes VTU and ends as it says", "[run][static]") {
  const Place here;
  const test::Outcome fine = here.run(cube_scene(), "--json -o " + here.path("cube.vtu"));
  CHECK(fine.exit_code == 0);
  const json answer = json::parse(fine.out);
  const double weight = 2400 * 8 * 9.81;
  CHECK(answer["bodies"][0]["supports"][0]["force"][2].get<double>() ==
        Approx(weight).epsilon(1e-10));
  CHECK(answer["max_displacement"]["value"].get<double>() > 0);
  CHECK(answer["max_principal_stress"]["position"].size() == 3);
  CHECK(answer["strain_energy"].get<double>() > 0);
  CHECK(read_mesh(here.path("cube.vtu")));

  json free = cube_scene();
  free["bodies"][0].erase("held");
  const test::Outcome refused = here.run(free, "--json");
  CHECK(refused.exit_code == 3);
  CHECK(refused.json().size() == 1);  // the findings, no answer
  CHECK(refused.json()["findings"][0]["code"] == "not_supported");
  CHECK(refused.err.find("[not_supported: 0]") != std::string::npos);
  CHECK(here.run(cube_scene(), "--jason").exit_code == 2);
  CHECK(here.run(cube_scene(), "-o /nowhere/at/all.vtu").exit_code == 4);
  // Numbers that would make energies overflow are refused.
  for (const char* far :
       {"bodies.0.material.young_modulus=1e-300", "gravity.acceleration=[0,0,1e306]"}) {
    const test::Outcome overflow =
        here.run(cube_scene(), std::string("--json --set '") + far + "'");
    INFO(far << ": " << overflow.err);
    CHECK(overflow.exit_code == 3);
    CHECK(overflow.json().size() == 1);
    CHECK(overflow.json().contains("findings"));
    CHECK(overflow.err.find("out_of_range") != std::string::npos);
  }
  json empty_box = cube_scene();
  empty_box["bodies"][0]["loads"] = {
      {{"minimum", {8, 8, 8}}, {"maximum", {9, 9, 9}}, {"pressure", 1}}};
  const test::Outcome outside = here.run(empty_box, "");
  CHECK(outside.exit_code == 3);
  CHECK(outside.err.find("nothing_loaded") != std::string::npos);
}

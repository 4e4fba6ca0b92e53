// SPDX-License-Identifier: MIT
// Cracks as objects together with all other settings of fracture.
#include <catch2/catch.hpp>
#include <set>

#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A bar that falls on a sphere and breaks over it.
Scene breaking_scene() {
  Scene scene;
  scene.bodies.push_back({.name = "bar",
                          .mesh = suite::jittered(suite::kuhn_box({6, 2, 2}, 0.1), 0.01, 4),
                          .material = {.young_modulus = 1e8, .tensile_strength = 2e5},
                          .translation = {-0.3, -0.1, 0.21},
                          .velocity = {0, 0, -4}});
  scene.obstacles = {Obstacle{Sphere{{0, 0, 0.1}, 0.1}}, Obstacle{Plane{}}};
  scene.integrator.time_step = 1e-3;
  scene.fracture.crack = CrackMode::object;
  return scene;
}

/// A bar that is cut to a third of its height and pulled apart.
Scene pulled_bar() {
  Scene scene;
  scene.bodies.push_back(
      {.mesh = suite::jittered(suite::kuhn_box({12, 2, 6}, 0.05), 0.005, 2),
       .material = {.young_modulus = 1e9, .tensile_strength = 2e6},
       .held = {{{-1, -1, -1}, {0.02, 1, 1}}, {{0.58, -1, -1}, {1, 1, 1}}},
       .cuts = {{CutPlane{{0.3, 0, 0}, {1, 0, 0}}, RestBox{{-1, -1, -1}, {1, 1, 0.11}}, {}}}});
  scene.bodies[0].held[1].velocity = {0.2, 0, 0};
  scene.integrator.time_step = 1e-4;
  scene.fracture.crack = CrackMode::object;
  return scene;
}

/// The laws of labels, anchors and faces after every step.
void hold_laws(const Simulation& sim) {
  const Cells& cells = sim.state->cells;
  const CrackLabels& cracks = cells.cracks;
  REQUIRE(check(cells.map).empty());
  // Those of cuts hold back nothing.
  const auto of_fan = [](const CrackAnchor& anchor) { return anchor.reach > 0; };
  REQUIRE(std::size_t(std::ranges::count_if(cracks.anchors, of_fan)) == sim.state->fans);
  std::set<std::pair<CrackId, TetId>> seen;
  for (const CrackLabel& label : cracks.labels) {
    REQUIRE(seen.insert({label.crack, label.tetrahedron}).second);
  }
  for (std::size_t f = 0; f < cracks.of_face.size(); ++f) {
    const HalfFaceId face{f};
    if (cracks.of_face[f].is_none()) continue;
    REQUIRE(is_crack_face(cells, face));
    REQUIRE(side_of(cracks, cracks.of_face[f], tetrahedron_of(face)) != Side::undecided);
  }
  // Every crack face has an owner.
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    if (is_crack_face(cells, HalfFaceId{f})) REQUIRE_FALSE(cracks.of_face[f].is_none());
  }
}

struct Choice {
  const char* name;
  void (*choose)(Scene&);
};

}  // namespace

TEST_CASE("cracks as objects keep their laws with every other choice about fracture",
          "[fracture][cracks]") {
  const Choice choice = GENERATE(values<Choice>({
      {"relax", [](Scene& s) { s.fracture.relax = 2; }},
      {"energy",
       [](Scene& s) {
         s.fracture.criterion = FractureCriterion::energy;
         s.fracture.relax = 1;
         s.bodies[0].material.toughness = 2e4;
       }},
      {"mass", [](Scene& s) { s.fracture.node_stress = NodeStress::mass; }},
      {"fit", [](Scene& s) { s.fracture.node_stress = NodeStress::fit; }},
      {"budget",
       [](Scene& s) {
         s.fracture.mode = FractureMode::budget;
         s.fracture.max_fans = 2;
       }},
      {"walk", [](Scene& s) { s.fracture.detection = Detection::walk; }},
      {"oracle", [](Scene& s) { s.fracture.detection = Detection::oracle; }},
      {"given order", [](Scene& s) { s.fracture.face_order = FaceOrder::given; }},
      {"limits",
       [](Scene& s) {
         s.fracture.smallest_piece = 5;
         s.fracture.max_pieces = 4;
       }},
      {"cuts",
       [](Scene& s) {
         s.bodies[0].cuts.push_back(
             {CutPlane{{0.3, 0, 0}, {1, 0, 0}}, RestBox{{-1, -1, -1}, {1, 1, 0.12}}, {}});
       }},
      {"drawn strengths",
       [](Scene& s) { s.bodies[0].strength.weibull = WeibullSettings{.modulus = 5}; }},
      {"no ladder", [](Scene& s) { s.ladder.rigid = s.ladder.quasi_static = false; }},
  }));
  INFO(choice.name);
  Scene scene = breaking_scene();
  choice.choose(scene);
  Simulation sim = built(scene);
  std::size_t fans = 0;
  for (int k = 0; k < 40; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    for (const FanEvent& fan : report.fracture.fans) {
      CHECK(fan.crack.index() < sim.state->cells.cracks.cracks);
      ++fans;
    }
    hold_laws(sim);
  }
  CHECK(fans > 0);
  if (sim.scene.fracture.max_pieces > 0) {
    std::size_t pieces = 0;
    for (const std::size_t size : sim.state->cells.labels.size) pieces += size > 0;
    CHECK(pieces <= 4);
  }
}

TEST_CASE("a cut is a crack with its vertices for anchors, and goes on from its edge",
          "[fracture][cracks]") {
  Simulation sim = built(pulled_bar());
  REQUIRE(sim.state->cells.cracks.cracks == 1);
  REQUIRE(sim.state->cells.cracks.anchors.size() > 5);
  for (const CrackAnchor& anchor : sim.state->cells.cracks.anchors) {
    CHECK(std::abs(anchor.at.x() - 0.3) < 1e-12);
    CHECK(std::abs(anchor.normal.x() - 1) < 1e-12);
    CHECK(anchor.reach == 0);
  }
  REQUIRE(sim.state->cells.cracks.labels.size() > 10);
  std::size_t of_cut = 0, fans = 0;
  for (int k = 0; k < 100 && sim.state->cells.labels.size.size() == 1; ++k) {
    for (const FanEvent& fan : advance(sim).fracture.fans) {
      of_cut += fan.crack == CrackId{0};
      ++fans;
    }
  }
  CHECK(fans > 5);
  CHECK(of_cut * 4 >= fans * 3);
  CHECK(sim.state->cells.labels.size.size() >= 2);
}

TEST_CASE("a crack that grows has its piece stepped finely, in mode object alone",
          "[fracture][cracks]") {
  for (const CrackMode mode : {CrackMode::paper, CrackMode::object}) {
    Scene scene = pulled_bar();
    scene.fracture.crack = mode;
    Simulation sim = built(scene);
    std::size_t fans = 0;
    for (int k = 0; k < 200 && fans == 0; ++k) fans = advance(sim).fracture.fans.size();
    REQUIRE(fans > 0);
    const bool is_open = std::ranges::any_of(sim.state->impact.quiet,
                                             [](double q) { return q != ImpactWindow::closed; });
    CHECK(is_open == (mode == CrackMode::object));
    CHECK((advance(sim).parts > 1) == (mode == CrackMode::object));
  }
}

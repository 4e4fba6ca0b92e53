// SPDX-License-Identifier: MIT
// Cohesive cracks in whole simulations: their energy, their start, and two maps that are nested.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "fracture/algorithms/split_fan.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/rebuild_pieces.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/ties/insert_ties.hpp"
#include "fracture/ties/release_ties.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/ties/tie_law.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;
using Catch::Detail::Approx;

namespace {

constexpr double height = 0.4;  // m
constexpr double thick = 0.1;   // m
constexpr double energy = 33;   // J/m^2

/// A notched bar of concrete that is pulled apart at its ends.
Scene pulled_bar(double step, double speed = 0.05, std::uint32_t order = 1) {
  constexpr double cell = height / 8, eps = 1e-3 * cell;
  Scene scene;
  BodySettings bar{.name = "bar", .mesh = suite::kuhn_box({16, 8, 2}, cell)};
  bar.material.fracture_energy = energy;
  bar.order = order;
  bar.held = {
      {.minimum = {-1, -1, -1}, .maximum = {eps, 9, 9}},
      {.minimum = {2 * height - eps, -1, -1}, .maximum = {9, 9, 9}, .velocity = {speed, 0, 0}}};
  bar.cuts = {{.faces = CutPlane{.point = {height, 0, 0}, .normal = {1, 0, 0}},
               .box = RestBox{{-1, -1, -1}, {9, 0.25 * height + eps, 9}},
               .ball = {}}};
  scene.bodies.push_back(std::move(bar));
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = step;
  scene.fracture.crack = CrackMode::cohesive;
  return scene;
}

/// The law after every step: the map is the map of pieces except for tied faces.
void check_nesting(const Simulation& sim) {
  const Cells& cells = sim.state->cells;
  const DenseMap& pieces = cells.pieces->map;
  std::set<HalfFaceId> tied;
  for (const Tie& tie : sim.state->contact.ties) {
    REQUIRE(pieces.neighbour(tie.face) == tie.opposite);
    tied.insert(tie.face);
    tied.insert(tie.opposite);
  }
  REQUIRE(tied.size() == 2 * sim.state->contact.ties.size());
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    const HalfFaceId expected = tied.contains(face) ? HalfFaceId::none() : pieces.neighbour(face);
    REQUIRE(cells.map.neighbour(face) == expected);
  }
  // A vertex of the finer map lies in one of the coarser.
  std::map<VertexId, VertexId> of_fine;
  for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId fine = cells.map.corners(TetId{t})[k], coarse = pieces.corners(TetId{t})[k];
      REQUIRE(of_fine.try_emplace(fine, coarse).first->second == coarse);
    }
  }
  const Components anew = label_components(pieces);
  REQUIRE(cells.labels.of_tetrahedron == cells.pieces->labels.of_tetrahedron);
  for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
    for (const HalfFaceId n : pieces.rows().neighbours[t]) {
      if (n.is_none()) continue;
      REQUIRE(cells.labels.of_tetrahedron[t] ==
              cells.labels.of_tetrahedron[tetrahedron_of(n).index()]);
    }
    for (const VertexId v : cells.map.corners(TetId{t})) {
      REQUIRE(cells.labels.of_vertex[v.index()] == cells.labels.of_tetrahedron[t]);
    }
  }
  std::size_t living = 0;
  for_each_living(sim.state->mechanics, {}, [&](const Component&) { ++living; });
  REQUIRE(living == anew.size.size());
}

StepReport advance_fine(Simulation& sim) {
  StepReport report = advance(sim);
  REQUIRE(report.status.outcome == StepOutcome::fine);
  return report;
}

/// Where a plane is tied: vertices from a height on, and how many of them.
struct TiedPart {
  double from = 0;  // m
  std::size_t most = 0;
};

/// One crack by hand along x = `at`, tied: fans at its vertices.
void tie_plane(Simulation& sim, double at, const TiedPart& tied) {
  Cells& cells = sim.state->cells;
  std::vector<FanEvent> fans;
  ComponentScratch scratch;
  const CrackId crack = add_crack(cells.cracks, cells.map.tetrahedra());
  for (std::size_t row = 0; row < cells.map.vertices() && fans.size() < tied.most; ++row) {
    const Point& p = cells.map.point(VertexId{row});
    if (std::abs(p[0] - at) > 1e-6 || p[1] < tied.from) continue;
    const VertexStar around = vertex_star(cells.map, VertexId{row});
    const std::vector<char> positive = plane_signs(cells.map, around, {1, 0, 0});
    for (std::size_t i = 0; i < positive.size(); ++i) {
      const TetId t = tetrahedron_of(around.corners[i]);
      if (side_of(cells.cracks, crack, t) == Side::undecided) {
        add_label(cells.cracks, crack, t, positive[i] != 0);
      }
    }
    fans.push_back(split_fan({cells, sim.state->mechanics}, around, Vec3::UnitX(), positive,
                             sim.scene.fracture, scratch));
    fans.back().crack = crack;
  }
  rebuild_pieces(*sim.state, fans, sim.scratch->mechanics);
}

/// The energies of a run until the bar is in two.
struct Taken {
  TieReport ties;
  double residual = 0, moved = 0;  // J
};

Taken part(Simulation& sim, double until, bool checks = false) {
  Taken taken;
  while (simulated_time(sim) < until) {
    const StepReport report = advance_fine(sim);
    add_part(taken.ties, report.ties);
    taken.residual += std::abs(report.energy.residual);
    taken.moved += report.energy.moved;
    if (checks) check_nesting(sim);
  }
  return taken;
}

}  // namespace

TEST_CASE("a crack takes G_c times its area, whatever the scene's step", "[ties]") {
  const double step = GENERATE(1e-3, 1e-4, 2e-5);
  const auto order = GENERATE(1u, 2u);
  if (order == 2 && step < 1e-4) return;  // ten minutes
  INFO("step " << step << ", order " << order);
  Simulation sim = built(pulled_bar(step, 0.05, order));
  const Taken taken = part(sim, 2.5e-3);
  const double section = 0.75 * height * thick;
  CHECK(living_components(sim.state->mechanics).size() == 2);
  CHECK(sim.state->contact.ties.empty());
  // Normals of fans lie within a degree or two of the axis.
  CHECK(taken.ties.dissipated == Approx(energy * section).epsilon(1e-3));
  CHECK(taken.ties.work == Approx(energy * section).epsilon(0.01));
  CHECK(taken.ties.stored == Approx(0).margin(1e-9 * energy * section));
  CHECK(taken.residual < 1e-4 * energy * section);
}

/// A notched bar, held at one end and pulled at the other by a force that rises over a second.
TEST_CASE("a bar under a load that is raised slowly opens its bonds and parts in two", "[ties]") {
  const auto order = GENERATE(1u, 2u);
  constexpr double cell = 0.05, eps = 1e-3 * cell;
  Scene scene;
  BodySettings bar{.name = "bar", .mesh = suite::kuhn_box({6, 3, 1}, cell)};
  bar.material.fracture_energy = energy;
  bar.order = order;
  bar.held = {{.minimum = {-1, -1, -1}, .maximum = {eps, 9, 9}}};
  bar.cuts = {{.faces = CutPlane{.point = {3 * cell, 0, 0}, .normal = {1, 0, 0}},
               .box = RestBox{{-1, -1, -1}, {9, cell + eps, 9}},
               .ball = {}}};
  LoadBox load{.minimum = {6 * cell - eps, -1, -1}, .maximum = {9, 9, 9}, .ramp_time = 1};
  load.force = Vec3(bar.material.tensile_strength * 3 * cell * cell, 0, 0);
  bar.loads = {load};
  scene.bodies.push_back(std::move(bar));
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 2e-3;
  scene.fracture.crack = CrackMode::cohesive;
  Simulation sim = built(scene);
  double taken = 0;
  std::size_t in_equilibrium = 0, tied = 0;
  while (living_components(sim.state->mechanics).size() == 1 && sim.state->step < 500) {
    const StepReport report = advance_fine(sim);
    CHECK(report.contact.converged);
    taken += report.ties.dissipated;
    const Rung rung = sim.state->mechanics.components[0].rung;
    in_equilibrium += rung == Rung::quasi_static;
    if (sim.state->contact.ties.empty()) continue;
    ++tied;
    CHECK(rung == Rung::full);
  }
  CHECK(in_equilibrium > 50);
  CHECK(tied > 0);
  CHECK(living_components(sim.state->mechanics).size() == 2);
  CHECK(taken == Approx(energy * 2 * cell * cell).epsilon(0.05));
}

TEST_CASE("what is sewn and what is tied are nested maps after every step", "[ties]") {
  Scene scene = pulled_bar(1e-4, 1, GENERATE(1u, 2u));
  scene.bodies[0].cuts.clear();
  scene.bodies[0].strength.weibull = WeibullSettings{};
  Simulation sim = built(std::move(scene));
  const Taken taken = part(sim, 1.5e-3, true);
  CHECK(taken.residual < 1e-3 * taken.moved);
  CHECK(sim.state->fans > 10);
  CHECK(living_components(sim.state->mechanics).size() > 1);
}

TEST_CASE("copies that a fan made go on with the acceleration they had", "[ties]") {
  const auto order = GENERATE(1u, 2u);
  INFO("order " << order);
  Simulation sim = built(pulled_bar(1e-4, 0.05, order));
  // The step in which the first fan comes; the ties are those of that state.
  while (sim.state->contact.ties.empty()) advance_fine(sim);
  const Cells& cells = sim.state->cells;
  const MechanicsState& m = sim.state->mechanics;
  const ElementColumns& elements = m.elements;
  std::vector<Vec3> elastic(m.vertices.size(), Vec3::Zero());
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const ElementNodes nodes = nodes_of(elements, cells.map.corners(), TetId{t});
    for (std::size_t a = 0; a < nodes.count; ++a) {
      elastic[nodes.row[a].index()] -=
          node_force(elements, elements.stress, elements.corner_stress, TetId{t}, a);
    }
  }
  std::map<std::pair<VertexId, VertexId>, std::pair<Vec3, double>> pulls;  // N at most, and along
  for (const Tie& tie : sim.state->contact.ties) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto node = [&](HalfFaceId face, std::uint8_t place) {
        return nodes_of(elements, cells.map.corners(), tetrahedron_of(face)).row[place];
      };
      const VertexId a = node(tie.face, tie.corner[k]);
      const VertexId b = node(tie.opposite, tie.opposite_corner[k]);
      REQUIRE(cells.map.is_node(a) == (order == 2));
      REQUIRE(tie.corners[k].is_apart() == (a != b));
      if (a == b) continue;
      auto& [normal, most] = pulls.try_emplace({a, b}, Vec3::Zero(), 0).first->second;
      normal += tie.normal;
      most += tie.corners[k].area * tie.corners[k].strength;
    }
  }
  REQUIRE_FALSE(pulls.empty());
  for (const auto& [pair, pull] : pulls) {
    const auto [a, b] = pair;
    const double mass_a = m.vertices.mass[a.index()], mass_b = m.vertices.mass[b.index()];
    const Vec3 needed =
        (mass_b * elastic[a.index()] - mass_a * elastic[b.index()]) / (mass_a + mass_b);
    // The force that keeps the two together is one that their ties bear: to rounding; of order 2
    // the rest of the step has opened them by a twentieth of their way.
    const double beyond = order == 1 ? 1e-12 : 0.01;
    CHECK(effective_traction(needed, pull.first.normalized(), {}) <= pull.second * (1 + beyond));
  }
}

/// A block tied across its middle and unbreakable elsewhere; one end moves away at `velocity`.
Taken part_block(const ShearLaw& shear, const Vec3& velocity, double step, std::uint32_t order) {
  constexpr double cell = 0.05;
  Scene scene;
  BodySettings block{.name = "block", .mesh = suite::kuhn_box({2, 4, 4}, cell)};
  block.material.fracture_energy = energy;
  block.material.shear = shear;
  block.order = order;
  block.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-4, 9, 9}},
                {.minimum = {2 * cell - 1e-4, -1, -1}, .maximum = {9, 9, 9}, .velocity = velocity}};
  scene.bodies.push_back(std::move(block));
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = step;
  scene.fracture.crack = CrackMode::cohesive;
  Simulation sim = built(std::move(scene));
  tie_plane(sim, cell, {-1, 99});
  for (double& strength : sim.state->cells.strength) strength = 1e30;
  const double reach = 3 * std::max(1.0, shear.energy_ratio / std::sqrt(shear.weight));
  Taken taken = part(sim, reach * 2 * energy / 3e6 / velocity.norm());
  CHECK(sim.state->contact.ties.empty());
  return taken;
}

TEST_CASE("a section pulled apart takes G_c, one that slides kappa G_c", "[ties]") {
  const double section = 0.04;  // m^2
  const auto shear = GENERATE(ShearLaw{1, 1}, ShearLaw{1, 2.5}, ShearLaw{4, 2}, ShearLaw{0.5, 0.5});
  const double step = GENERATE(1e-5, 1e-4);
  const auto order = GENERATE(1u, 2u);
  if (order == 2 && step < 1e-4) return;  // minutes
  INFO("beta^2 " << shear.weight << ", kappa " << shear.energy_ratio << ", step " << step
                 << ", order " << order);
  const double whole = energy * section, kappa = shear.energy_ratio;
  const Taken pulled = part_block(shear, {0.05, 0, 0}, step, order);
  CHECK(pulled.ties.dissipated == Approx(whole).epsilon(2e-3));
  CHECK(pulled.ties.work == Approx(whole).epsilon(2e-3));
  const Taken slid = part_block(shear, {0, 0.05, 0}, step, order);
  CHECK(slid.ties.dissipated == Approx(kappa * whole).epsilon(2e-3));
  CHECK(slid.ties.work == Approx(kappa * whole).epsilon(2e-3));
  const Taken mixed = part_block(shear, {0.04, 0.03, 0}, step, order);
  CHECK(mixed.ties.dissipated > 0.99 * std::min(1.0, kappa) * whole);
  CHECK(mixed.ties.dissipated < 1.01 * std::max(1.0, kappa) * whole);
  CHECK(mixed.ties.work == Approx(mixed.ties.dissipated).epsilon(5e-3));
}

TEST_CASE("halves that bounce on their ties never heal them", "[ties]") {
  constexpr double cell = 0.05, section = 0.04, speed = 0.3;  // m, m^2, m/s
  Scene scene;
  BodySettings block{.name = "block", .mesh = suite::kuhn_box({2, 4, 4}, cell)};
  block.material.fracture_energy = energy;
  scene.bodies.push_back(std::move(block));
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 1e-5;
  scene.fracture.crack = CrackMode::cohesive;
  Simulation sim = built(std::move(scene));
  tie_plane(sim, cell, {-1, 99});
  for (double& strength : sim.state->cells.strength) strength = 1e30;
  // Apart with a third of the energy that would part them.
  MechanicsState& m = sim.state->mechanics;
  for (const Component& c : m.components) {
    for (const TetId t : c.tetrahedra) {
      const double side = m.vertices.rest_position[sim.state->cells.map.corners(t)[0].index()].x() +
                          m.vertices.rest_position[sim.state->cells.map.corners(t)[1].index()].x() +
                          m.vertices.rest_position[sim.state->cells.map.corners(t)[2].index()].x() +
                          m.vertices.rest_position[sim.state->cells.map.corners(t)[3].index()].x();
      for (const VertexId v : sim.state->cells.map.corners(t)) {
        const Vec3 apart(side > 4 * cell ? speed : -speed, 0, 0);
        m.vertices.velocity[v.index()] = m.vertices.displacement_rate[v.index()] = apart;
      }
    }
  }
  std::map<std::pair<HalfFaceId, std::size_t>, double> opened;
  double taken = 0;
  bool shut_again = false;
  for (int step = 0; step < 60; ++step) {
    const StepReport report = advance_fine(sim);
    taken += report.ties.dissipated;
    shut_again = shut_again || (taken > 0 && report.ties.opening == 0);
    for (const Tie& tie : sim.state->contact.ties) {
      for (std::size_t k = 0; k < 3; ++k) {
        double& before = opened[{tie.face, k}];
        CHECK(tie.corners[k].opened >= before);
        before = tie.corners[k].opened;
      }
    }
  }
  CHECK(shut_again);
  double by_law = 0;
  for (const Tie& tie : sim.state->contact.ties) {
    for (const TieCorner& corner : tie.corners)
      by_law += dissipated_energy(corner, corner.opened, 1);
  }
  CHECK(sim.state->contact.ties.size() == 32);
  CHECK(by_law > 0.05 * energy * section);
  CHECK(taken == Approx(by_law).epsilon(1e-9));
}

TEST_CASE("ties of a body without load do nothing", "[ties]") {
  Scene scene = pulled_bar(1e-4, 0, GENERATE(1u, 2u));
  Simulation sim = built(std::move(scene));
  // Across the middle, above the cut.
  tie_plane(sim, height, {0.3 * height, 5});
  REQUIRE(sim.state->contact.ties.size() > 10);
  check_nesting(sim);
  for (int i = 0; i < 50; ++i) {
    const StepReport report = advance_fine(sim);
    CHECK(report.ties.opening == 0);
    CHECK(report.fracture.fans.empty());
  }
  double fastest = 0;
  for (const Vec3& v : sim.state->mechanics.vertices.velocity) {
    fastest = std::max(fastest, v.norm());
  }
  CHECK(fastest < 1e-15);  // m/s
}

TEST_CASE("what does not go with ties is refused, and doubtful materials are told", "[ties]") {
  const auto codes = [](const Scene& scene) {
    std::multiset<std::string> found;
    for (const Finding& f : build_simulation(scene).findings) found.insert(f.code);
    return found;
  };
  Scene scene = pulled_bar(1e-4);
  scene.bodies[0].material.fracture_energy = 60;
  CHECK(codes(scene).empty());
  scene.bodies[0].material.fracture_energy.reset();
  CHECK(codes(scene) == std::multiset<std::string>{"no_fracture_energy"});
  scene.bodies[0].material.toughness = 1.3e6;
  CHECK(codes(scene).empty());
  scene.bodies[0].material.fracture_energy = 60;
  CHECK(codes(scene) == std::multiset<std::string>{"two_fracture_energies"});
  scene.bodies[0].material.toughness.reset();
  scene.bodies[0].material.fracture_energy = 8;
  CHECK(codes(scene) == std::multiset<std::string>{"tip_not_resolved"});
  const auto refused = std::multiset<std::string>{"cohesive_not_supported"};
  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.fracture.relax = 2; },
      [](Scene& s) { s.fracture.criterion = FractureCriterion::energy; },
      [](Scene& s) { s.impact.window = false; },
      [](Scene& s) { s.integrator.integrator = Integrator::implicit_euler; }};
  for (const auto& change : changes) {
    Scene other = pulled_bar(1e-4);
    other.bodies[0].material.fracture_energy = 60;
    change(other);
    CHECK(codes(other) == refused);
  }
}

TEST_CASE("a run saved amid open ties goes on to the same bytes", "[ties]") {
  Simulation sim = built(pulled_bar(1e-4, 0.05, GENERATE(1u, 2u)));
  while (sim.state->contact.ties.empty()) advance_fine(sim);
  for (int i = 0; i < 2; ++i) advance_fine(sim);
  REQUIRE_FALSE(sim.state->contact.ties.empty());
  const std::string bytes = saved_state(sim);
  Result<Simulation> loaded = restore(bytes);
  REQUIRE(loaded);
  check_nesting(*loaded);
  for (int i = 0; i < 5; ++i) {
    advance_fine(sim);
    advance_fine(*loaded);
  }
  CHECK(saved_state(sim) == saved_state(*loaded));
}

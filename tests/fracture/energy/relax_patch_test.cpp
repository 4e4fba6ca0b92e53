// SPDX-License-Identifier: MIT
// Stresses solved for again around a fan: against the equilibrium of the split body.
#include "fracture/energy/relax_patch.hpp"

#include <catch2/catch.hpp>

#include <random>
#include <set>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// A shaken bar that hangs from one end and bears its weight, in equilibrium.
Simulation hanging_bar(std::mt19937& random, std::uint32_t order) {
  Scene scene;
  BodySettings bar;
  bar.mesh = suite::kuhn_box({3, 3, 8}, 0.1);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  for (Point& p : bar.mesh.points) p = {p[0] + shift(random), p[1] + shift(random), p[2]};
  bar.material = {.young_modulus = 1e7, .poisson_ratio = 0.3, .density = 1000};
  bar.held = {{.minimum = {-1, -1, 0.8 - 1e-6}, .maximum = {9, 9, 9}}};
  bar.order = order;
  scene.bodies = {bar};
  Simulation sim = std::move(*build_simulation(std::move(scene)));
  REQUIRE(solve_static(sim.state->mechanics, sim.scratch->mechanics, sim.state->cells.map.corners(),
                       {.gravity = sim.scene.gravity.acceleration})
              .empty());
  return sim;
}

struct Relaxed {
  Simulation sim;
  std::vector<Mat3> before;
  FractureReport report;
};

/// One fan, at the most stressed vertex, and the stresses that follow.
Relaxed after_one_fan(std::mt19937& random, std::uint32_t rings, std::uint32_t order) {
  Simulation sim = hanging_bar(random, order);
  MechanicsState& m = sim.state->mechanics;
  Cells& cells = sim.state->cells;
  std::fill(cells.strength.begin(), cells.strength.end(), 1e3);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    // The end that is held keeps its forces.
    if (m.vertices.rest_position[v].z() > 0.65) cells.strength[v] = 1e12;
  }
  std::vector<Mat3> before = m.elements.stress;
  FractureSettings settings{.mode = FractureMode::budget, .max_fans = 1, .relax = rings};
  auto report = break_vertices({cells, m}, settings, sim.scratch->fracture);
  REQUIRE(report.fans.size() == 1);
  return {std::move(sim), std::move(before), std::move(report)};
}

}  // namespace

TEST_CASE("relaxed over the whole body, stresses are those of the split body in equilibrium",
          "[fracture][relax]") {
  const auto seed = GENERATE(1u, 2u, 3u);
  const auto order = GENERATE(1u, 2u);
  INFO("seed " << seed << ", order " << order);
  std::mt19937 random(seed);
  Relaxed body = after_one_fan(random, 100, order);
  MechanicsState& m = body.sim.state->mechanics;
  const auto corners = body.sim.state->cells.map.corners();
  rebuild(m, corners, living_components(m), body.sim.scratch->mechanics);
  REQUIRE(solve_static(m, body.sim.scratch->mechanics, corners,
                       {.gravity = body.sim.scene.gravity.acceleration})
              .empty());
  const RelaxedState& relaxed = body.sim.scratch->fracture.relaxed;
  double largest = 0, wrong = 0, moved = 0;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    largest = std::max(largest, m.elements.stress[t].norm());
    wrong = std::max(wrong, (relaxed.stress[t] - m.elements.stress[t]).norm());
    moved = std::max(moved, (relaxed.stress[t] - body.before[t]).norm());
    if (order == 1) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const Mat3& own = m.elements.corner_stress[t][k];
      wrong = std::max(wrong, (relaxed.corner_stress[t][k] - own).norm());
    }
  }
  CHECK(moved > 0.01 * largest);
  // The trace of mass that holds loose pieces shows.
  CHECK(wrong < 1e-5 * largest);
}

TEST_CASE("relaxing changes stresses in its patch alone, and nothing of the state",
          "[fracture][relax]") {
  const auto order = GENERATE(1u, 2u);
  std::mt19937 random(4);
  const Relaxed body = after_one_fan(random, 2, order);
  const MechanicsState& m = body.sim.state->mechanics;
  const RelaxedState& relaxed = body.sim.scratch->fracture.relaxed;
  const auto corners = body.sim.state->cells.map.corners();
  std::set<VertexId> inside;
  for (const FaceSplit& face : body.report.fans.front().faces) {
    for (int i = 0; i < face.vertex_count; ++i) {
      const auto [old_row, new_row] = face.split_vertices[std::size_t(i)];
      inside.insert({old_row, new_row});
    }
    // Of second order an edge may part with ends that are still connected.
    if (order == 2) inside.insert(face.vertices.begin(), face.vertices.end());
  }
  std::set<TetId> patch;
  for (int ring = 0; ring < 2; ++ring) {
    for (std::size_t t = 0; t < corners.size(); ++t) {
      const bool touches =
          std::ranges::any_of(corners[t], [&](VertexId v) { return inside.contains(v); });
      if (touches) patch.insert(TetId{t});
    }
    for (const TetId t : patch) inside.insert(corners[t.index()].begin(), corners[t.index()].end());
  }
  std::size_t changed = 0, outside = 0;
  for (std::size_t t = 0; t < body.before.size(); ++t) {
    CHECK(m.elements.stress[t] == body.before[t]);
    if (relaxed.stress[t] == body.before[t]) continue;
    ++changed;
    outside += !patch.contains(TetId{t});
  }
  CHECK(changed > 20);
  CHECK(changed < body.before.size() / 2);
  CHECK(outside == 0);
  for (const MotionId support : m.vertices.support) {
    CHECK((support.is_none() || support.index() < m.motions.size()));
  }
}

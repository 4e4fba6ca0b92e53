// SPDX-License-Identifier: MIT
// Limits on pieces with ties: the pieces that a fan leaves if all ties were spent, by union-find.
#include "fracture/algorithms/piece_limits.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "fracture/algorithms/split_fan.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/ties/release_ties.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tension.hpp"
#include "topology/base/union_find.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// kg of all that hangs together by sewn faces, but for those of a fan.
std::vector<double> masses_without(const VolumeMap& map, const MechanicsState& mechanics,
                                   const std::vector<HalfFaceId>& fan) {
  UnionFind parts(map.tetrahedra());
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const HalfFaceId across = map.neighbour(HalfFaceId{f});
    const auto is_cut = [&](HalfFaceId face) { return std::ranges::count(fan, face) > 0; };
    if (across.is_none() || is_cut(HalfFaceId{f}) || is_cut(across)) continue;
    parts.join(static_cast<std::uint32_t>(f / 4),
               static_cast<std::uint32_t>(tetrahedron_of(across).index()));
  }
  std::map<std::uint32_t, double> mass;
  for (std::uint32_t t = 0; t < map.tetrahedra(); ++t) {
    mass[parts.root(t)] += mechanics.elements.mass[t];
  }
  std::vector<double> all;
  for (const auto& [root, m] : mass) all.push_back(m);
  return all;
}

}  // namespace

TEST_CASE("a fan is refused if spent ties would leave too light or too many pieces",
          "[ties][limits]") {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  std::size_t refused = 0, parted = 0;
  for (int body = 0; body < 12; ++body) {
    Tension made = uniform_tension(suite::jittered(suite::kuhn_box({3, 3, 2}, 0.1), 0.01, 3),
                                   Vec3::UnitZ(), 0);
    Cells& cells = made.cells;
    cells.pieces = Pieces{cells.map.dense(), cells.labels};
    FractureSettings settings;
    settings.crack = CrackMode::cohesive;
    // Of the body's 43 kg; every third body has but one of the limits.
    settings.smallest_piece = body % 3 == 1 ? 0 : 2.0 + body;
    settings.max_pieces = body % 3 == 2 ? 0 : static_cast<std::uint32_t>(1 + body / 2);
    ComponentScratch scratch;
    ContactMemory contact;
    for (int fan = 0; fan < 150; ++fan) {
      const VertexId v{random() % cells.map.vertices()};
      const Vec3 u = Vec3(normal(random), normal(random), normal(random)).normalized();
      const VertexStar around = vertex_star(cells.map, v);
      const std::vector<char> positive = plane_signs(cells.map, around, {u.x(), u.y(), u.z()});
      const std::vector<HalfFaceId> faces = breakable_fan(cells, around, positive);
      const std::size_t before = masses_without(cells.map, made.state, {}).size();
      const std::vector<double> after = masses_without(cells.map, made.state, faces);
      const bool parts = after.size() > before;
      const bool too_light =
          settings.smallest_piece > 0 && *std::ranges::min_element(after) < settings.smallest_piece;
      const bool too_many = settings.max_pieces > 0 && after.size() > settings.max_pieces;
      const bool exceeds = exceeds_limits(cells, made.state, faces, settings, scratch);
      REQUIRE(exceeds == (parts && (too_light || too_many)));
      refused += exceeds;
      parted += parts && !exceeds;
      if (exceeds) continue;
      const FanEvent event = split_fan({cells, made.state}, around, u, positive, settings, scratch);
      for (const FaceSplit& split : event.faces) {
        Tie tie{.face = split.face, .opposite = split.opposite};
        for (TieCorner& corner : tie.corners) corner = {1, 1, 2, 1};
        contact.ties.push_back(tie);
      }
      // In whatever order ties are spent, no piece is ever below the limits.
      if (random() % 8 > 0) continue;
      std::ranges::shuffle(contact.ties, random);
      std::vector<Tie> later(
          contact.ties.begin() + static_cast<std::ptrdiff_t>(contact.ties.size() / 2),
          contact.ties.end());
      contact.ties.resize(contact.ties.size() / 2);
      release_ties(cells, contact, Detection::exact, scratch);
      contact.ties = std::move(later);
      std::vector<double> mass(cells.labels.size.size(), 0);
      for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
        mass[cells.labels.of_tetrahedron[t].index()] += made.state.elements.mass[t];
      }
      REQUIRE(*std::ranges::min_element(mass) >= settings.smallest_piece);
      if (settings.max_pieces > 0) REQUIRE(mass.size() <= settings.max_pieces);
    }
  }
  CHECK(refused > 100);
  CHECK(parted > 10);
}

TEST_CASE("a body that ties hold breaks no farther than its limits", "[ties][limits]") {
  for (const bool limited : {false, true}) {
    Scene scene;
    BodySettings bar{.name = "bar", .mesh = suite::kuhn_box({8, 4, 2}, 0.05)};
    bar.material.fracture_energy = 33;
    bar.held = {{.minimum = {-1, -1, -1}, .maximum = {1e-4, 9, 9}},
                {.minimum = {0.4 - 1e-4, -1, -1}, .maximum = {9, 9, 9}, .velocity = {0.5, 0, 0}}};
    scene.bodies.push_back(std::move(bar));
    scene.gravity.acceleration.setZero();
    scene.integrator.time_step = 1e-4;
    scene.fracture.crack = CrackMode::cohesive;
    if (limited) scene.fracture.max_pieces = 1;
    Simulation sim = built(std::move(scene));
    std::size_t refused = 0, released = 0;
    while (simulated_time(sim) < 1e-3) {
      const StepReport report = advance(sim);
      REQUIRE(report.status.outcome == StepOutcome::fine);
      refused += report.fracture.refused_fans;
      released += report.releases.size();
    }
    CHECK((sim.state->cells.labels.size.size() == 1) == limited);
    CHECK((refused > 0) == limited);
    CHECK(released > 0);
  }
}

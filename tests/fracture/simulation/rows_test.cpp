// SPDX-License-Identifier: MIT
// Faces split in a running simulation by a law of one's own, and a map that was damaged in mid-run.
#include "fracture/simulation/rows.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "fracture/simulation/simulation_state.hpp"
#include "tests/support/built.hpp"
#include "tests/support/simulation.hpp"
#include "topology/kernel/dart_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

Scene flying_bar(CrackMode crack, MapKernel kernel) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back({.name = "bar",
                          .mesh = jittered(kuhn_box({6, 2, 2}, 0.1), 0.01, 4),
                          .material = {.fracture_energy = 10},
                          .held = {}});
  scene.fracture.crack = crack;
  scene.fracture.mode = FractureMode::off;
  scene.topology.kernel = kernel;
  scene.integrator.time_step = 1e-3;
  return scene;
}

double sum(std::span<const double> column) {
  return std::accumulate(column.begin(), column.end(), 0.0);
}

}  // namespace

TEST_CASE("faces split between steps: rows, labels, masses and motion stay whole",
          "[fracture][rows]") {
  const auto crack = GENERATE(CrackMode::paper, CrackMode::object);
  const auto kernel = GENERATE(MapKernel::dense, MapKernel::lcc);
  Simulation sim = built(flying_bar(crack, kernel));
  const double mass = sum(rows_of(sim).mass);
  std::mt19937_64 random(7);
  std::size_t pieces = 1, split = 0;
  for (int step = 0; step < 40; ++step) {
    std::vector<HalfFaceId> faces;
    for (int i = 0; i < 12; ++i) faces.emplace_back(below(random, 4 * map_of(sim).tetrahedra()));
    std::size_t inside = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const HalfFaceId across = map_of(sim).neighbour(faces[i]);
      const auto known = faces.begin() + static_cast<std::ptrdiff_t>(i);
      inside += !across.is_none() && std::find(faces.begin(), known, faces[i]) == known &&
                std::find(faces.begin(), known, across) == known;
    }
    const auto event = split_faces(sim, faces);
    REQUIRE(event);
    CHECK(event->faces.size() == inside);
    split += inside;
    pieces += event->components.created;
    const SimulationRows rows = rows_of(sim);
    REQUIRE(rows.position.size() == map_of(sim).vertices());
    REQUIRE(rows.strength.size() == map_of(sim).vertices());
    REQUIRE(rows.component.size() == map_of(sim).vertices());
    REQUIRE(vertex_stress(sim).size() == map_of(sim).vertices());
    CHECK(sum(rows.mass) == Approx(mass).epsilon(1e-12));
    REQUIRE(check_map(sim).empty());
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    CHECK(report.components == pieces);
  }
  CHECK(pieces > 3);
  CHECK(split > 100);
}

TEST_CASE("faces that cannot be split are refused, and nothing has changed", "[fracture][rows]") {
  Simulation sim = built(flying_bar(CrackMode::paper, MapKernel::dense));
  const std::size_t vertices = map_of(sim).vertices();
  const std::vector<HalfFaceId> beyond = {HalfFaceId{3}, HalfFaceId{4 * map_of(sim).tetrahedra()}};
  auto event = split_faces(sim, beyond);
  REQUIRE_FALSE(event);
  CHECK(event.findings[0].code == "no_such_face");
  CHECK(map_of(sim).vertices() == vertices);
  CHECK(split_faces(sim, {})->faces.empty());

  Simulation tied = built(flying_bar(CrackMode::cohesive, MapKernel::dense));
  event = split_faces(tied, std::vector{HalfFaceId{0}});
  REQUIRE_FALSE(event);
  CHECK(event.findings[0].code == "ties_between_faces");
  CHECK(check_map(tied).empty());
}

TEST_CASE("a beta corrupted in mid-run is named by the step and the dart", "[fracture][rows]") {
  Simulation sim = built(flying_bar(CrackMode::paper, MapKernel::lcc));
  auto& complex = const_cast<DartMap&>(map_of(sim).darts()).complex();
  const int link = GENERATE(1, 2, 3);
  for (int step = 1; step <= 5; ++step) {
    advance(sim);
    CHECK(check_map(sim).empty());
    if (step < 5) continue;
    // Dart 17, and one that it has no business with.
    std::size_t face = 0;
    while (map_of(sim).neighbour(HalfFaceId{face}).is_none()) ++face;
    const auto dart =
        map_of(sim).darts().dart_at(TetId{face / 4}, static_cast<int>(3 * (face % 4)));
    const auto other = map_of(sim).darts().dart_at(TetId{40}, 1);
    if (link == 1) complex.link_beta<1>(dart, other);
    if (link == 2) complex.link_beta<2>(dart, other);
    if (link == 3) complex.link_beta<3>(dart, other);
    advance(sim);
    const std::vector<Finding> damage = check_map(sim);
    REQUIRE_FALSE(damage.empty());
    CHECK(damage[0].code == "map_damaged");
    CHECK(damage[0].text.starts_with("after step 6 (t = 0.006 s): "));
    CHECK_FALSE(damage[0].ids.empty());
  }
}

TEST_CASE("a label that a walk does not confirm is found", "[fracture][rows]") {
  const auto crack = GENERATE(CrackMode::paper, CrackMode::cohesive);
  Simulation sim = built(flying_bar(crack, MapKernel::dense));
  auto& cells = sim.state->cells;
  cells.labels.size.push_back(1);
  cells.labels.of_tetrahedron[5] = ComponentId{1};
  const std::vector<Finding> found = check_map(sim);
  REQUIRE(found.size() == 1);
  CHECK(found[0].ids == std::vector<std::int64_t>{5});
}

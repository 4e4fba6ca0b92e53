// SPDX-License-Identifier: MIT
// Bodies that come and go: against scenes that have them from the start, and against the ledgers.
#include "fracture/simulation/changes/bodies.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/changes/actions.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/queries/poses.hpp"
#include "fracture/simulation/rows.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

BodySettings bar(const Vec3& place, double down, double strength = 2e5) {
  BodySettings body;
  body.mesh = suite::jittered(suite::kuhn_box({6, 2, 2}, 0.05), 0.004, 4);
  body.material = {.tensile_strength = strength, .fracture_energy = 5};
  body.translation = place;
  body.velocity = {0, 0, -down};
  return body;
}

Scene floor_with(std::vector<BodySettings> bodies, CrackMode crack = CrackMode::object) {
  Scene scene;
  scene.obstacles.push_back({Plane{}});
  scene.bodies = std::move(bodies);
  scene.fracture.crack = crack;
  scene.integrator.time_step = 5e-4;
  return scene;
}

/// Everything that can name a row: cuts, random and painted strengths, supports, loads, a region
/// that never splits.
BodySettings rich(const Vec3& place) {
  BodySettings body = bar(place, 4);
  body.strength.weibull = WeibullSettings{};
  body.cuts.push_back({CutPlane{{0.15, 0, 0}, {1, 0, 0}}, RestBox{{-1, -1, -1}, {1, 0.06, 1}}, {}});
  body.held.push_back({.minimum = {-0.1, -0.1, -0.1}, .maximum = {0.01, 0.2, 0.2}});
  body.loads.push_back(
      {.minimum = {0.27, -0.1, -0.1}, .maximum = {0.4, 0.2, 0.2}, .force = {0, 0, -2000}});
  body.unbreakable.push_back({RestBox{{-0.1, -0.1, -0.1}, {0.06, 0.2, 0.2}}});
  return body;
}

void step(Simulation& sim, int count) {
  for (int i = 0; i < count; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    REQUIRE_FALSE(report.fracture.not_a_number);
  }
}

BodyChange added(Simulation& sim, BodySettings body) {
  Result<BodyChange> change = add_body(sim, std::move(body));
  for (const Finding& f : change.findings) UNSCOPED_INFO(f.code << ": " << f.text);
  REQUIRE(change);
  return *change;
}

std::string code_of(const Result<BodyChange>& result) {
  REQUIRE_FALSE(result);
  return result.findings.front().code;
}

double kinetic(const Simulation& sim) { return kinetic_energy(sim.state->mechanics.vertices); }

const Vec3 here{0, 0, 0.01}, there{0, 3, 0.01};

}  // namespace

TEST_CASE("a body added before the first step is one of the scene's, to the byte", "[bodies]") {
  const auto crack = GENERATE(CrackMode::paper, CrackMode::object, CrackMode::cohesive);
  const auto kernel = GENERATE(MapKernel::dense, MapKernel::lcc);
  BodySettings before = rich(here);
  before.cuts.clear();  // rows of vertices that a cut splits lie behind those of all bodies
  Scene both = floor_with({before, rich(there)}, crack);
  Scene first = floor_with({before}, crack);
  both.topology.kernel = first.topology.kernel = kernel;
  Simulation from_start = built(both), grown = built(first);
  const BodyChange change = added(grown, rich(there));
  CHECK(change.body == 1);
  CHECK(change.pieces.size() == 1);
  CHECK((saved_state(grown) == saved_state(from_start)));
  step(from_start, 30);
  step(grown, 30);
  CHECK(from_start.state->fans > 10);
  CHECK((saved_state(grown) == saved_state(from_start)));
  CHECK(check_map(grown).empty());
}

TEST_CASE("a body removed before the first step was never there", "[bodies]") {
  const auto crack = GENERATE(CrackMode::paper, CrackMode::object, CrackMode::cohesive);
  Simulation alone = built(floor_with({bar(here, 4)}, crack));
  const std::size_t row = GENERATE(0, 1);
  std::vector<BodySettings> bodies = {bar(here, 4)};
  bodies.insert(row == 0 ? bodies.begin() : bodies.end(), rich(there));
  Simulation sim = built(floor_with(bodies, crack));
  REQUIRE(remove_body(sim, row));
  step(alone, 40);
  step(sim, 40);
  CHECK(alone.state->fans > 10);
  const VertexColumns &a = alone.state->mechanics.vertices, &b = sim.state->mechanics.vertices;
  CHECK(same_bytes(a.position, b.position));
  CHECK(same_bytes(a.velocity, b.velocity));
  CHECK(same_bytes(alone.state->mechanics.elements.stress, sim.state->mechanics.elements.stress));
  CHECK(check_map(sim).empty());
}

TEST_CASE("bodies come and go while others break: ids stay, ledgers close", "[bodies]") {
  const auto crack = GENERATE(CrackMode::object, CrackMode::cohesive);
  Simulation sim = built(floor_with({bar(there, 5), bar(here, 5)}, crack));
  double flow = 0;  // J, as the steps have it
  Impulse passed = Impulse::Zero();
  double size = 0;
  const double kinetic_before = kinetic(sim);
  const Impulse momentum_before = total_momentum(*sim.state);
  const auto run = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const StepReport report = advance(sim);
      REQUIRE(report.status.outcome == StepOutcome::fine);
      flow += report.energy.kinetic;
      size += report.energy.moved;
      for_each_counter<MomentumLedger>(
          [&](const auto& counter) { passed += report.momentum.*counter.member; });
    }
  };
  run(40);
  std::vector<PiecePose> others;
  for (const PiecePose& pose : piece_poses(sim)) {
    if (pose.body == 1) others.push_back(pose);
  }
  REQUIRE(others.size() > 1);
  const std::size_t vertices = map_of(sim).vertices();
  const Result<BodyChange> gone = remove_body(sim, 0);
  REQUIRE(gone);
  CHECK(gone->pieces.size() > 1);
  CHECK(map_of(sim).vertices() < vertices);
  CHECK(check_map(sim).empty());
  const std::vector<PiecePose> left = piece_poses(sim);
  REQUIRE(left.size() == others.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    CHECK(left[i].id == others[i].id);
    CHECK(left[i].body == 1);
    CHECK(left[i].mass == others[i].mass);
    CHECK(left[i].reference.centre == others[i].reference.centre);
    CHECK(left[i].parent == others[i].parent);
  }
  run(20);
  const std::size_t ids = sim.state->cells.labels.size.size();
  const BodyChange come = added(sim, bar({0, -3, 0.03}, 6));
  CHECK(come.body == 2);
  CHECK(come.pieces == std::vector{ComponentId{ids}});
  CHECK(come.kinetic == Approx(0.5 * come.mass * 36));
  CHECK(come.momentum[2] == Approx(-6 * come.mass));
  run(40);
  CHECK(std::ranges::any_of(piece_poses(sim), [](const PiecePose& p) { return p.body == 2; }));
  CHECK(check_map(sim).empty());
  CHECK(kinetic(sim) - kinetic_before ==
        Approx(flow + come.kinetic - gone->kinetic).margin(1e-9 * size));
  const Impulse residual =
      total_momentum(*sim.state) - momentum_before - passed - come.momentum + gone->momentum;
  CHECK(residual.norm() < 1e-9 * (passed.norm() + come.momentum.norm()));
}

TEST_CASE("the same sequence has the same bytes, also through a saved state", "[bodies]") {
  const auto crack = GENERATE(CrackMode::object, CrackMode::cohesive);
  const auto kernel = GENERATE(MapKernel::dense, MapKernel::lcc);
  const auto sequence = [&](bool saves) {
    Scene scene = floor_with({bar(there, 5), bar(here, 5)}, crack);
    scene.topology.kernel = kernel;
    Simulation sim = built(scene);
    const auto pause = [&] {
      if (!saves) return;
      Result<Simulation> again = restore(saved_state(sim));
      REQUIRE(again);
      sim = std::move(*again);
    };
    step(sim, 30);
    REQUIRE(remove_body(sim, 0));
    pause();
    step(sim, 5);
    added(sim, rich({0, -3, 0.01}));
    pause();
    step(sim, 15);
    pause();
    return saved_state(sim);
  };
  const std::string once = sequence(false);
  CHECK((once == sequence(false)));
  CHECK((once == sequence(true)));
}

TEST_CASE("what cannot come or go is refused, and nothing has changed", "[bodies]") {
  Simulation sim = built(floor_with({bar(here, 5), bar(there, 5)}));
  step(sim, 20);
  const std::string before = saved_state(sim);
  BodySettings body = bar({0, -3, 0.01}, 5);
  body.material.young_modulus = -1;
  CHECK_FALSE(add_body(sim, body));
  body = bar({0, -3, 0.01}, 5);
  body.mesh.tetrahedra[0][0] = 1u << 30;
  CHECK_FALSE(add_body(sim, body));
  body = bar({0, -3, 0.01}, 5);
  body.held.push_back({.minimum = {9, 9, 9}, .maximum = {10, 10, 10}});
  CHECK_FALSE(add_body(sim, body));
  CHECK(code_of(remove_body(sim, 2)) == "no_such_body");
  CHECK((saved_state(sim) == before));

  REQUIRE(remove_body(sim, 0));
  const std::string one = saved_state(sim);
  CHECK(code_of(remove_body(sim, 0)) == "no_such_body");
  CHECK(code_of(remove_body(sim, 1)) == "last_body");
  CHECK((saved_state(sim) == one));
  sim.state->script.emplace();
  CHECK(code_of(remove_body(sim, 1)) == "is_replay");
  CHECK(code_of(add_body(sim, bar(there, 5))) == "is_replay");
}

TEST_CASE("a body put into pieces is a warning", "[bodies]") {
  Simulation sim = built(floor_with({bar({0, 0, 0.5}, 5)}));
  step(sim, 20);  // 5 cm down
  const auto has_warning = [](const Result<BodyChange>& result) {
    REQUIRE(result);
    return std::ranges::any_of(result.findings,
                               [](const Finding& f) { return f.code == "overlap_with_pieces"; });
  };
  CHECK_FALSE(has_warning(add_body(sim, bar({0, 0, 0.57}, 5))));
  CHECK(has_warning(add_body(sim, bar({0.01, 0, 0.4}, 5))));
}

TEST_CASE("a sleeping body falls when the one under it goes", "[bodies]") {
  BodySettings low = bar({0, 0, 0}, 0, 1e9), high = bar({0, 0, 0.1}, 0, 1e9);
  low.mesh = high.mesh = suite::kuhn_box({1, 1, 1}, 0.1);
  Scene scene = floor_with({low, high});
  scene.integrator.time_step = 2e-3;
  scene.ladder.sleep = true;
  Simulation sim = built(scene);
  const auto sleeps = [&] { return sim.state->mechanics.components[1].rung == Rung::asleep; };
  for (int i = 0; i < 1000 && !sleeps(); ++i) step(sim, 1);
  REQUIRE(sleeps());
  const double height = sim.state->mechanics.components[1].centre.z();
  REQUIRE(remove_body(sim, 0));
  step(sim, 50);
  CHECK(sim.state->mechanics.components[1].centre.z() < height - 0.03);
}

TEST_CASE("a pull goes on at its vertex, and ends with its body", "[bodies]") {
  Simulation sim = built(floor_with({bar(here, 0, 1e9), bar(there, 0, 1e9)}));
  const std::size_t first = rows_of(sim).position.size() / 2;
  REQUIRE_FALSE(pull(sim, VertexId{first}, {0, 3, 1}));
  const Vec3 place = rows_of(sim).position[first];
  REQUIRE(remove_body(sim, 0));
  REQUIRE(sim.spring);
  CHECK(rows_of(sim).position[sim.spring->vertex.index()] == place);
  added(sim, bar(here, 0, 1e9));
  REQUIRE(remove_body(sim, 1));
  CHECK_FALSE(sim.spring);
}

TEST_CASE("a body of order 2 comes alone, and leaves room for others", "[bodies]") {
  Scene scene = floor_with({bar(here, 5)});
  scene.fracture.mode = FractureMode::off;
  Simulation sim = built(scene);
  step(sim, 5);
  BodySettings second = bar(there, 5);
  second.order = 2;
  added(sim, second);
  step(sim, 10);
  CHECK(check_map(sim).empty());
  CHECK(code_of(add_body(sim, bar({0, -3, 0.01}, 5))) == "nodes_of_edges");
  REQUIRE(remove_body(sim, 0));
  CHECK(check_map(sim).empty());
  step(sim, 5);
  Result<Simulation> again = restore(saved_state(sim));
  REQUIRE(again);
  step(sim, 5);
  step(*again, 5);
  CHECK(first_difference(sim, *again).empty());
  CHECK(code_of(remove_body(sim, 1)) == "last_body");

  Simulation other = built(scene);
  added(other, second);
  REQUIRE(remove_body(other, 1));
  added(other, bar(there, 5));
  step(other, 5);
  CHECK(check_map(other).empty());
}

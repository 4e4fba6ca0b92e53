// SPDX-License-Identifier: MIT
// Quantities that no split changes: mass, volume, momentum, moments of inertia, kinetic energy; on
// random bodies torn by random fans, and in runs that break by themselves.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "fracture/algorithms/split_fan.hpp"
#include "fracture/breaking/fan_script.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/tension.hpp"
#include "topology/mesh/check.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/random/random_run_bodies.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

double signed_unit(std::mt19937_64& random) { return 2 * unit(random) - 1; }

Vec3 random_vector(std::mt19937_64& random) {
  return {signed_unit(random), signed_unit(random), signed_unit(random)};
}

/// The conserved quantities, and the sizes of their terms as scales for rounding.
struct Kept {
  double mass = 0, volume = 0, kinetic = 0;
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  Mat3 moment = Mat3::Zero();  ///< sum m X X^T, at rest: rigid pieces take their shape of then
  double momentum_size = 0, angular_size = 0;
};

/// From the rows.
Kept of_rows(const MechanicsState& state) {
  Kept k;
  const VertexColumns& v = state.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    k.mass += v.mass[i];
    k.moment += v.mass[i] * v.rest_position[i] * v.rest_position[i].transpose();
    k.momentum_size += v.mass[i] * v.velocity[i].norm();
    k.angular_size += v.mass[i] * v.position[i].norm() * v.velocity[i].norm();
  }
  for (const double volume : state.elements.rest_volume) k.volume += volume;
  k.kinetic = kinetic_energy(v);
  k.momentum = momentum(v);
  k.angular = angular_momentum(v);
  return k;
}

/// From the pieces, each by its mass, its centre, and the sums of its members about the centre.
Kept of_pieces(const MechanicsState& state) {
  Kept k;
  for (const Component& c : state.components) {
    if (c.tetrahedra.empty()) continue;
    Vec3 P = Vec3::Zero(), spin = Vec3::Zero();
    Mat3 own = Mat3::Zero();
    for (const VertexId i : c.vertices) {
      const double m = state.vertices.mass[i.index()];
      const Vec3 r = state.vertices.position[i.index()] - c.centre;
      const Vec3 r0 = state.vertices.rest_position[i.index()] - c.rest_centre;
      P += m * state.vertices.velocity[i.index()];
      spin += m * r.cross(state.vertices.velocity[i.index()]);
      own += m * r0 * r0.transpose();
    }
    k.mass += c.mass;
    k.momentum += P;
    k.angular += c.centre.cross(P) + spin;
    k.moment += own + c.mass * c.rest_centre * c.rest_centre.transpose();
    for (const TetId t : c.tetrahedra) k.volume += state.elements.rest_volume[t.index()];
  }
  return k;
}

void hold_same(const Kept& before, const Kept& after) {
  CHECK(std::abs(after.mass - before.mass) <= 1e-12 * before.mass);
  CHECK(std::abs(after.volume - before.volume) <= 1e-12 * before.volume);
  CHECK((after.momentum - before.momentum).norm() <= 1e-12 * before.momentum_size);
  CHECK((after.angular - before.angular).norm() <= 1e-12 * before.angular_size);
  CHECK((after.moment - before.moment).norm() <= 1e-12 * before.moment.norm());
}

bool is_solid(const TetMesh& mesh) {
  if (has_error(check_mesh(mesh))) return false;
  return std::ranges::all_of(mesh.tetrahedra, [&](const auto& t) {
    std::array<Vec3, 4> p;
    for (std::size_t a = 0; a < 4; ++a) p[a] = Vec3(mesh.points[t[a]].data());
    return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) > 0;
  });
}

struct TornBody {
  sunder::Cells cells;
  MechanicsState state;
};

/// A body somewhere, turning, flying, strained and shaking.
TornBody moving_body(const TetMesh& mesh, std::mt19937_64& random) {
  VolumeMap map = std::move(*build_map(mesh));
  const Material material{.young_modulus = 1e9};
  MechanicsState state = columns_of(map, material);
  Eigen::Quaterniond turn(signed_unit(random), signed_unit(random), signed_unit(random), 1);
  for (const Component& c : state.components) {
    place(state, c.id,
          {turn.normalized(), random_vector(random), 3 * random_vector(random),
           5 * random_vector(random)});
  }
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    state.vertices.position[v] += 1e-4 * random_vector(random);
    state.vertices.velocity[v] += 0.1 * random_vector(random);
  }
  for (const Component& c : state.components) reframe(state, c.id);
  set_stress(state, map, material);
  sunder::Cells cells = make_cells(std::move(map), state);
  return {std::move(cells), std::move(state)};
}

/// Splits up to `fans` fans at random and rebuilds every piece. Gives the report of the rebuild.
RebuildReport tear(TornBody& body, std::size_t fans, std::mt19937_64& random, std::size_t& made) {
  ComponentScratch scratch;
  for (std::size_t k = 0; k < fans; ++k) {
    const VertexId v{below(random, body.cells.map.vertices())};
    const Vec3 normal = random_vector(random).normalized();
    const VertexStar star = vertex_star(body.cells.map, v);
    made += !split_fan({body.cells, body.state}, star, normal, {}, scratch).faces.empty();
  }
  MechanicsScratch mechanics;
  body.state.elements.component = body.cells.labels.of_tetrahedron;
  std::vector<ComponentId> all;
  for (std::size_t id = 0; id < body.cells.labels.size.size(); ++id) all.emplace_back(id);
  return rebuild(body.state, body.cells.map.corners(), all, mechanics);
}

/// J, of each tetrahedron: a quarter of its mass moves with each corner.
std::vector<double> kinetic_of_elements(const Simulation& sim) {
  const MechanicsState& m = sim.state->mechanics;
  std::vector<double> kinetic(m.elements.size(), 0);
  for (std::size_t t = 0; t < kinetic.size(); ++t) {
    for (const VertexId v : sim.state->cells.map.corners(TetId{t})) {
      kinetic[t] += m.elements.mass[t] / 8 * m.vertices.velocity[v.index()].squaredNorm();
    }
  }
  return kinetic;
}

/// Pieces that deform keep their kinetic energy; those that became rigid give up no more than is
/// reported. (They may gain: they take their shape at rest, and turn faster where that is smaller.)
void hold_kinetic(const std::vector<double>& before, const Simulation& now, double released) {
  const std::vector<double> after = kinetic_of_elements(now);
  double kept = 0, kept_before = 0, rigid = 0, rigid_before = 0;
  for (std::size_t t = 0; t < after.size(); ++t) {
    const ComponentId id = now.state->mechanics.elements.component[t];
    const bool isolated = now.state->mechanics.components[id.index()].rigid;
    (isolated ? rigid : kept) += after[t];
    (isolated ? rigid_before : kept_before) += before[t];
  }
  CHECK(std::abs(kept - kept_before) <= 1e-12 * kept_before);
  CHECK(rigid_before - rigid <= released + 1e-12 * rigid_before);
  CHECK(std::abs(rigid_before - rigid) <= 1e-3 * rigid_before);
}

}  // namespace

TEST_CASE("random fans of random bodies keep mass, momentum and what pieces do not give up",
          "[fracture][conservation]") {
  constexpr unsigned seed = 1121;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t bodies = 0, fans = 0, pieces = 0, rigid = 0;
  for (const BodyFamily& family : body_families(400)) {
    for (int body_number = 0; body_number < 20; ++body_number) {
      const TetMesh mesh = family.draw(random);
      if (!is_solid(mesh)) continue;
      INFO(family.name << " " << body_number << ", " << mesh.tetrahedra.size() << " tetrahedra");
      TornBody body = moving_body(mesh, random);
      ++bodies;
      for (int round = 0; round < 6; ++round) {
        const Kept before = of_rows(body.state);
        const std::size_t old_rigid = static_cast<std::size_t>(
            std::ranges::count(body.state.components, true, &Component::rigid));
        const RebuildReport report = tear(body, 1 + below(random, 8), random, fans);
        const Kept rows = of_rows(body.state);
        hold_same(before, rows);
        hold_same(before, of_pieces(body.state));
        const double given_up = report.energy_released - report.strain_released;
        CHECK(given_up >= -1e-12 * before.kinetic);
        CHECK(std::abs(before.kinetic - rows.kinetic - given_up) <= 1e-12 * before.kinetic);
        const std::size_t now_rigid = static_cast<std::size_t>(
            std::ranges::count(body.state.components, true, &Component::rigid));
        // Only newly rigid pieces give up energy.
        if (now_rigid == old_rigid)
          CHECK(std::abs(report.energy_released) <= 1e-12 * before.kinetic);
      }
      for (const Component& c : body.state.components) {
        pieces += !c.tetrahedra.empty();
        rigid += c.rigid;
      }
    }
  }
  INFO(bodies << " bodies, " << fans << " fans, " << pieces << " pieces, " << rigid << " rigid");
  CHECK(bodies > 80);
  CHECK(fans > 1000);
  CHECK(rigid > 50);
}

TEST_CASE("steps that break keep across their fans what the state had before them",
          "[fracture][conservation]") {
  constexpr unsigned seed = 2111;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t fans = 0, rigid_steps = 0;
  for (int number = 0; number < 4; ++number) {
    Scene scene;
    scene.fracture.crack = CrackMode::paper;
    scene.bodies.push_back(
        {.name = "bar",
         .mesh = jittered(kuhn_box({6, 2, 2}, 0.1), 0.015, static_cast<unsigned>(number))});
    scene.bodies[0].material.tensile_strength = 2e6;
    scene.bodies[0].velocity = 4 * random_vector(random);
    // A rim speed at which rho w^2 L^2 / 8 is far over the strength.
    scene.bodies[0].spin = random_vector(random) + Vec3(0, 500, 300);
    scene.integrator.time_step = 1e-4;
    // One part a step, and nobody leaves the full rung: the observer sees the state that breaks.
    scene.impact.window = false;
    scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
    auto built = build_simulation(std::move(scene));
    REQUIRE(built);
    Simulation& sim = *built;
    for (int step = 0; step < 30; ++step) {
      Kept before;
      std::vector<double> kinetic;
      const StepReport report = advance(sim, [&](const Simulation& now, const PartReport&) {
        before = of_rows(now.state->mechanics);
        kinetic = kinetic_of_elements(now);
      });
      REQUIRE(report.status.outcome == StepOutcome::fine);
      if (report.fracture.fans.empty()) continue;
      fans += report.fracture.fans.size();
      hold_same(before, of_rows(sim.state->mechanics));
      hold_same(before, of_pieces(sim.state->mechanics));
      hold_kinetic(kinetic, sim, report.energy_released);
      rigid_steps += report.energy_released > 0;
    }
  }
  INFO(fans << " fans, " << rigid_steps << " steps in which pieces became rigid");
  CHECK(fans > 100);
  CHECK(rigid_steps > 0);
}

namespace {

/// A pulled bar that breaks: fans of its run, as a script, and where its vertices end.
struct PulledRun {
  FanScript script;
  std::vector<Vec3> position;
};

Simulation pulled() {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back({.name = "bar", .mesh = jittered(kuhn_box({6, 2, 2}, 0.1), 0.01, 4)});
  scene.bodies[0].held = {
      {.minimum = {-0.02, -1, -1}, .maximum = {0.02, 1, 1}, .velocity = {-0.05, 0, 0}},
      {.minimum = {0.58, -1, -1}, .maximum = {0.62, 1, 1}, .velocity = {0.05, 0, 0}}};
  scene.gravity.acceleration.setZero();
  return std::move(*build_simulation(std::move(scene)));
}

PulledRun pulled_run(std::optional<FanScript> script) {
  Simulation sim = pulled();
  sim.state->script = std::move(script);
  PulledRun run;
  for (int i = 0; i < 20; ++i) {
    const StepReport report = advance(sim);
    for (std::size_t k = 0; k < report.fracture.fans.size(); ++k) {
      const FanEvent& fan = report.fracture.fans[k];
      run.script.fans.push_back(
          {{report.step, report.fan_part[k]}, fan.round, fan.vertex, fan.normal, fan.stress});
    }
    if (report.departed) break;
  }
  if (sim.state->script) run.script.departure = sim.state->script->departure;
  run.position = sim.state->mechanics.vertices.position;
  return run;
}

}  // namespace

TEST_CASE("a script of a run's fans makes the run again, and one that does not fit stops it",
          "[fracture][replay]") {
  const PulledRun first = pulled_run(std::nullopt);
  REQUIRE(first.script.fans.size() > 10);
  const PulledRun again = pulled_run(FanScript{first.script.fans});
  CHECK_FALSE(again.script.departure);
  REQUIRE(again.position.size() == first.position.size());
  for (std::size_t v = 0; v < first.position.size(); ++v) {
    REQUIRE(first.position[v] == again.position[v]);
  }
  const auto departs_at = [&](std::size_t row, auto change) {
    FanScript script{first.script.fans};
    change(script.fans[row]);
    const PulledRun run = pulled_run(std::move(script));
    REQUIRE(run.script.departure);
    CHECK_FALSE(run.script.departure->reason.empty());
    return run.script.departure->fan;
  };
  CHECK(departs_at(3, [](ScriptedFan& f) { f.vertex = VertexId{99999}; }) == 3);
  CHECK(departs_at(3, [](ScriptedFan& f) { f.normal.setZero(); }) == 3);
  CHECK(departs_at(3, [](ScriptedFan& f) { f.normal *= std::nan(""); }) == 3);
  const std::size_t last = first.script.fans.size() - 1;
  CHECK(departs_at(last, [](ScriptedFan& f) { f.place.part = 7; }) == last);
}

// SPDX-License-Identifier: MIT
// Bodies of order 2 in motion: flight, equilibrium in time, contact, cracks, saving, both kernels.
#include <catch2/catch.hpp>

#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/rows.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/kernel/edge_nodes.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

BodySettings body(const std::array<int, 3>& cells, double size) {
  BodySettings body;
  body.mesh = suite::kuhn_box(cells, size);
  body.order = 2;
  return body;
}

/// A bar that falls on a corner and breaks.
Scene breaking_bar() {
  Scene scene;
  scene.bodies.push_back(body({6, 2, 2}, 0.05));
  scene.bodies[0].material.tensile_strength = 3e6;
  scene.bodies[0].translation = {0, 0, 0.2};
  scene.bodies[0].rotation = Eigen::Quaterniond(0.9, 0.3, 0.2, 0.1).normalized();
  scene.bodies[0].velocity = {0, 0, -4};
  scene.obstacles.push_back({Plane{}});
  scene.integrator.time_step = 1e-4;
  return scene;
}

/// Steps until something broke, and `more`.
std::size_t run_until_broken(Simulation& sim, int more) {
  std::size_t fans = 0;
  for (int k = 0, left = 2000; k < left; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    if (fans == 0 && !report.fracture.fans.empty()) left = k + more;
    fans += report.fracture.fans.size();
  }
  return fans;
}

}  // namespace

TEST_CASE("a bar of order 2 flies and spins: momentum, spin and energy stay", "[order][run]") {
  Scene scene;
  scene.bodies.push_back(body({4, 1, 1}, 0.1));
  scene.bodies[0].velocity = {1, 2, 3};
  scene.bodies[0].spin = {3, -1, 2};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  Simulation sim = built(std::move(scene));
  const VertexColumns& v = sim.state->mechanics.vertices;
  const Vec3 p = momentum(v), L = angular_momentum(v);
  const double kinetic = kinetic_energy(v);
  for (int k = 0; k < 200; ++k) advance(sim);
  CHECK((momentum(v) - p).norm() < 1e-12 * p.norm());
  CHECK((angular_momentum(v) - L).norm() < 1e-11 * L.norm());
  CHECK(kinetic_energy(v) + strain_energy(sim.state->mechanics) == Approx(kinetic).epsilon(1e-4));
}

TEST_CASE("a cantilever of order 2 comes to rest where statics says", "[order][run]") {
  Scene scene;
  scene.bodies.push_back(body({10, 1, 1}, 0.1));
  scene.bodies[0].held = {{.minimum = {-1, -1, -1}, .maximum = {1e-6, 9, 9}}};
  scene.bodies[0].loads = {
      {.minimum = {-1, -1, 0.1 - 1e-6}, .maximum = {99, 9, 9}, .pressure = 1e3, .ramp_time = 0.5}};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.integrator.time_step = 1e-3;
  Result<Simulation> still = build_statics(scene);
  REQUIRE(still);
  REQUIRE(solve_scene(*still));
  Simulation sim = built(std::move(scene));
  REQUIRE(sim.state->mechanics.vertices.size() > sim.bodies[0].end_point);
  for (int k = 0; k < 3000; ++k) advance(sim);
  const std::vector<Vec3>&moved = sim.state->mechanics.vertices.displacement,
        &wanted = still->state->mechanics.vertices.displacement;
  REQUIRE(moved.size() == wanted.size());
  double worst = 0, most = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    worst = std::max(worst, (moved[i] - wanted[i]).norm());
    most = std::max(most, wanted[i].norm());
  }
  CHECK(most > 1e-6);
  CHECK(worst < 1e-6 * most);
}

TEST_CASE("blocks of order 2 pressed together: stress is even and the same in both",
          "[order][contact]") {
  // nu = 0: no friction is asked for, and the solution is exact. Faces bulge by less than gaps are
  // tolerated: they have to be met where they bulge.
  const auto [pressure, friction] =
      GENERATE(std::pair(1e4, 0.0), std::pair(1e5, 0.0), std::pair(1e4, 0.5), std::pair(1e6, 0.5));
  Scene scene;
  for (const double z : {0.0, 0.2}) {
    scene.bodies.push_back(body({2, 2, 2}, 0.1));
    scene.bodies.back().material.poisson_ratio = 0;
    scene.bodies.back().translation = {0, 0, z};
  }
  scene.bodies[1].loads = {{.minimum = {-1, -1, 0.2 - 1e-6},
                            .maximum = {9, 9, 9},
                            .pressure = pressure,
                            .ramp_time = 0.05}};
  scene.obstacles.push_back({Plane{}});
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.contact.tolerance = 1e-9;
  scene.contact.max_iterations = 2000;
  scene.contact.friction = friction;
  scene.obstacles[0].friction = friction;
  scene.integrator.time_step = 1e-3;
  Simulation sim = built(std::move(scene));
  for (int k = 0; k < 200; ++k) {
    REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
  }
  double worst = 0;
  for (const std::array<Mat3, 4>& at : sim.state->mechanics.elements.corner_stress) {
    for (const Mat3& stress : at) {
      const Mat3 wanted = Vec3(0, 0, -pressure).asDiagonal();
      worst = std::max(worst, (stress - wanted).cwiseAbs().maxCoeff());
    }
  }
  INFO(pressure << " Pa, friction " << friction);
  CHECK(worst < 1e-4 * pressure);
}

TEST_CASE(
    "a bar of order 2 breaks: energy and momentum are accounted for, rows of edges stay whole",
    "[order][run][fracture]") {
  Scene scene = breaking_bar();
  scene.energy_ledger = true;
  Simulation sim = built(std::move(scene));
  double residual = 0, moved = 0;
  Impulse left = -total_momentum(*sim.state);
  std::size_t fans = 0;
  for (int k = 0; k < 600; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    residual += report.energy.residual;
    moved += report.energy.moved;
    fans += report.fracture.fans.size();
    for_each_counter<MomentumLedger>(
        [&](const auto& counter) { left -= report.momentum.*counter.member; });
    REQUIRE(check_map(sim).empty());
  }
  left += total_momentum(*sim.state);
  CHECK(fans > 5);
  // The residual of blows in their sub-steps, as of order 1 (docs/lab/accuracy.md, Energy ledger).
  CHECK(std::abs(residual) < 2e-4 * moved);
  CHECK(left.head<3>().norm() < 1e-10 * 4 * sim.state->mechanics.elements.size());
  double mass = 0, of_nodes = 0;
  for (const double m : sim.state->mechanics.elements.mass) mass += m;
  for (const double m : sim.state->mechanics.vertices.mass) of_nodes += m;
  CHECK(of_nodes == Approx(mass).epsilon(1e-12));
}

TEST_CASE("both kernels break a bar of order 2 alike, and a saved one goes on to the same bytes",
          "[order][run][saved]") {
  Simulation dense = built(breaking_bar());
  Scene scene = breaking_bar();
  scene.topology.kernel = MapKernel::lcc;
  Simulation darts = built(std::move(scene));
  const std::size_t fans = run_until_broken(dense, 5);
  CHECK(fans > 0);
  CHECK(run_until_broken(darts, 5) == fans);
  CHECK(first_difference(dense, darts).empty());
  CHECK(dense.state->mechanics.elements.edge_nodes == darts.state->mechanics.elements.edge_nodes);
  Result<Simulation> again = restore(saved_state(dense));
  for (const Finding& f : again.findings) UNSCOPED_INFO(f.code << ": " << f.text);
  REQUIRE(again);
  for (int k = 0; k < 20; ++k) {
    advance(dense);
    advance(*again);
  }
  CHECK(first_difference(dense, *again).empty());
}

TEST_CASE("faces split by hand in a bar of order 2: pieces with their nodes", "[order][rows]") {
  Scene scene;
  scene.bodies.push_back(body({2, 1, 1}, 0.1));
  scene.gravity.acceleration.setZero();
  Simulation sim = built(std::move(scene));
  // The faces of the square half-way along the bar.
  std::vector<HalfFaceId> faces;
  const VolumeMap& map = map_of(sim);
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const auto corners = corners_of_face(map.corners(TetId{f / 4}), HalfFaceId{f});
    const bool is_middle = std::ranges::all_of(
        corners, [&](VertexId v) { return std::abs(map.point(v)[0] - 0.1) < 1e-9; });
    if (is_middle) faces.push_back(HalfFaceId{f});
  }
  REQUIRE(faces.size() == 4);
  const std::size_t before = map.vertices();
  const Result<FanEvent> event = split_faces(sim, faces);
  REQUIRE(event);
  // Four corners and five edges of the square come apart.
  CHECK(map.vertices() == before + 4 + 5);
  CHECK(event->nodes.size() == 5);
  CHECK(event->components.created == 1);
  CHECK(check_map(sim).empty());
  CHECK(sim.state->mechanics.vertices.size() == map.vertices());
  for (int k = 0; k < 10; ++k) CHECK(advance(sim).status.outcome == StepOutcome::fine);
}

TEST_CASE("what bodies of order 2 cannot have is refused, with the key", "[order][run]") {
  const auto code = [](auto change) {
    Scene scene = breaking_bar();
    change(scene);
    const Result<Simulation> refused = build_simulation(std::move(scene));
    REQUIRE(!refused);
    CHECK(refused.findings.front().code == "second_order_in_motion");
    return refused.findings.front().text;
  };
  const auto names = [&](const std::string& text, const char* key) {
    return text.find(key) != std::string::npos;
  };
  CHECK(names(code([](Scene& s) { s.integrator.isolated = IsolatedTetrahedra::qr; }), "isolated"));
  CHECK(names(code([](Scene& s) { s.contact.method = ContactMethod::penalty; }), "contact.method"));
}

TEST_CASE("bars of order 2 fall and come to rest at any stiffness and step, and gain no energy",
          "[order][run]") {
  const double young = GENERATE(1e5, 1e8, 1e11);
  const double step = GENERATE(1e-4, 1e-3, 1.0 / 60);
  INFO("E " << young << " Pa, step " << step << " s");
  Scene scene;
  scene.bodies.push_back(body({4, 1, 1}, 0.1));
  scene.bodies[0].material.young_modulus = young;
  scene.bodies[0].translation = {0, 0, 0.02};
  scene.bodies[0].rotation = Eigen::AngleAxisd(0.1, Vec3::UnitY());
  scene.obstacles.push_back({Plane{}});
  scene.fracture.mode = FractureMode::off;
  scene.integrator.time_step = step;
  Simulation sim = built(std::move(scene));
  const MechanicsState& m = sim.state->mechanics;
  const Vec3 g = sim.scene.gravity.acceleration;
  const auto energy = [&] {
    return kinetic_energy(m.vertices) + strain_energy(m) + gravity_energy(m.vertices, g);
  };
  const double start = energy();
  double fall = 0;  // J, of a fall by 0.1 m
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    fall += m.vertices.mass[v] * 9.81 * 0.1;
  }
  double most = start;
  for (int k = 0; k < 300; ++k) {
    REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
    most = std::max(most, energy());
  }
  // The fall is known at the ends of steps only.
  CHECK(most <= start + (1e-3 + 9.81 * step * step / 0.1) * fall);
}

// SPDX-License-Identifier: MIT
// The rungs of components: their bounds hold, and the omitted terms do not matter.
#include "fracture/simulation/ladder.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "fracture/algorithms/node_stress.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// One body in the air, without gravity.
Scene floating(TetMesh mesh) {
  Scene scene;
  scene.bodies.push_back({.name = "body", .mesh = std::move(mesh), .material = {}, .held = {}});
  scene.gravity.acceleration.setZero();
  return scene;
}

void full_always(Scene& scene) {
  scene.ladder.rigid = scene.ladder.quasi_static = scene.ladder.sleep = false;
}

double largest_node_stress(const Simulation& sim) {
  std::vector<Mat3> stress;
  const ElementColumns& elements = sim.state->mechanics.elements;
  average_node_stress(stress,
                      {sim.state->cells.map.corners(), elements.stress, elements.rest_volume},
                      sim.state->cells.map.vertices());
  double largest = 0;
  for (const Mat3& sigma : stress) {
    largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Mat3>(sigma).eigenvalues()[2]);
  }
  return largest;
}

/// Bodies of many shapes, all about 0.1 m.
std::vector<TetMesh> shapes() {
  return {jittered(kuhn_box({12, 2, 2}, 0.01), 1e-3, 1),
          jittered(kuhn_box({8, 8, 2}, 0.0125), 1e-3, 2),
          jittered(kuhn_box({3, 3, 3}, 0.03), 3e-3, 3),
          ring({6, 6, 2}, 0.02),
          kuhn_cubes(
              {8, 8, 2}, [](int i, int j, int) { return i < 2 || j < 2; }, 0.0125),
          two_tetrahedra()};
}

Rung rung(const Simulation& sim, std::size_t component = 0) {
  return sim.state->mechanics.components[component].rung;
}

}  // namespace

TEST_CASE("a body that swings in flight never exceeds the bound of its energy", "[ladder]") {
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  for (const TetMesh& mesh : shapes()) {
    Scene scene = floating(mesh);
    full_always(scene);
    scene.fracture.mode = FractureMode::off;
    scene.integrator.rho_infinity = 0.5;
    scene.integrator.time_step = 2e-6;
    Simulation sim = built(scene);
    VertexColumns& vertices = sim.state->mechanics.vertices;
    for (Vec3& v : vertices.velocity)
      v = 0.1 * Vec3(normal(random), normal(random), normal(random));
    reframe(sim.state->mechanics, ComponentId{0});
    const double bound =
        flight_stress_bound(sim.state->mechanics, sim.state->mechanics.components[0]);
    double largest = 0;
    for (int i = 0; i < 100; ++i) {
      REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
      largest = std::max(largest, largest_node_stress(sim));
    }
    CAPTURE(mesh.tetrahedra.size(), bound, largest);
    CHECK(largest > 0);
    CHECK(largest <= bound);
  }
}

TEST_CASE("the bound holds in uniaxial strain, where stress costs the least energy", "[ladder]") {
  const double nu = GENERATE(0.0, 0.22, 0.3, 0.4, 0.45);
  Scene scene = floating(kuhn_box({1, 1, 1}, 0.1));
  scene.bodies[0].material.poisson_ratio = nu;
  Simulation sim = built(scene);
  MechanicsState& m = sim.state->mechanics;
  const auto [lambda, mu] = lame(scene.bodies[0].material);
  // One star is the whole cube: the bound is reached, not only held.
  const double strain = 1e-4;
  for (Mat3& sigma : m.elements.stress) {
    sigma = lambda * strain * Mat3::Identity();
    sigma(0, 0) += 2 * mu * strain;
  }
  const double bound = flight_stress_bound(m, m.components[0]);
  CAPTURE(nu, bound, largest_node_stress(sim));
  CHECK(largest_node_stress(sim) <= bound * (1 + 1e-9));
}

TEST_CASE("a spinning body is stressed by less than the bound of its spin", "[ladder]") {
  for (const TetMesh& mesh : shapes()) {
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 1}}) {
      Scene scene = floating(mesh);
      full_always(scene);
      scene.fracture.mode = FractureMode::off;
      scene.bodies[0].spin = 50 * axis.normalized();
      scene.integrator.time_step = 1e-3;
      Simulation sim = built(scene);
      double fastest = 0;
      for (const Vec3& v : sim.state->mechanics.vertices.velocity)
        fastest = std::max(fastest, v.norm());
      for (int i = 0; i < 20; ++i) REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
      const double bound = 2 * Material{}.density * fastest * fastest;
      CAPTURE(mesh.tetrahedra.size(), axis.transpose(), bound);
      CHECK(largest_node_stress(sim) > 0);
      CHECK(largest_node_stress(sim) <= bound);
    }
  }
}

TEST_CASE("what flies rigidly flies as it would have with its deformation", "[ladder]") {
  Scene scene = floating(jittered(kuhn_box({5, 3, 2}, 0.04), 4e-3, 7));
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.bodies[0].velocity = {1, 2, 3};
  scene.bodies[0].spin = {3, 5, 2};
  Simulation rigid = built(scene);
  full_always(scene);
  Simulation full = built(scene);
  std::size_t steps = 0;
  for (int i = 0; i < 200; ++i) {
    advance(rigid);
    advance(full);
    steps += rung(rigid) == Rung::rigid;
    CHECK(rung(full) == Rung::full);
  }
  CHECK(steps > 150);
  const VertexColumns &a = rigid.state->mechanics.vertices, &b = full.state->mechanics.vertices;
  double apart = 0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    apart = std::max(apart, (a.position[v] - b.position[v]).norm());
  }
  CAPTURE(apart);
  CHECK(apart < 1e-7);  // a strain of 5e-9, and its effect on the inertia in 0.2 s
  CHECK((momentum(a) - momentum(b)).norm() < 1e-11 * momentum(b).norm());
  CHECK((angular_momentum(a) - angular_momentum(b)).norm() < 1e-8 * angular_momentum(b).norm());
}

TEST_CASE("a body that spins near its strength is never taken for rigid", "[ladder]") {
  Scene scene = floating(kuhn_box({12, 2, 2}, 0.05));
  scene.bodies[0].spin = {0, 0, 60};  // rho w^2 L^2 / 8 = 0.4 MPa of 3: the bound says 4.5
  Simulation sim = built(scene);
  for (int i = 0; i < 50; ++i) {
    advance(sim);
    CHECK(rung(sim) == Rung::full);
  }
}

TEST_CASE("a body that lies still sleeps, and a ball that falls on it wakes it", "[ladder]") {
  Scene scene = floating(jittered(kuhn_box({3, 3, 3}, 0.05), 4e-3, 3));
  scene.gravity.acceleration = {0, 0, -9.81};
  double low = 1;
  for (const Point& p : scene.bodies[0].mesh.points) low = std::min(low, p[2]);
  scene.bodies[0].translation = {0, 0, 1e-4 - low};
  // Falls for 0.45 s; one metre.
  scene.obstacles = {{.shape = Plane{}}, {.shape = Sphere{{0.075, 0.075, 1.2}, 0.04}, .mass = 2.0}};
  scene.contact.tolerance = 1e-6;  // so that the two are alike when the ball comes
  Simulation sim = built(scene);
  Scene always = scene;
  full_always(always);
  Simulation full = built(always);
  double slept = 0;
  std::size_t fans = 0, fans_full = 0;
  Rung before_ball = Rung::full;
  for (int i = 0; i < 600; ++i) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    fans += report.fracture.fans.size();
    fans_full += advance(full).fracture.fans.size();
    slept += rung(sim) == Rung::asleep;
    if (sim.state->mechanics.time < 0.44) before_ball = rung(sim);
  }
  CHECK(before_ball == Rung::asleep);
  CHECK(slept > 100);
  CHECK(fans > 0);
  CHECK(fans == fans_full);
}

TEST_CASE("a body that lies on springs sleeps, keeps its place, and wakes as a ball meets it",
          "[ladder]") {
  Scene scene = floating(kuhn_box({3, 3, 3}, 0.05));
  scene.gravity.acceleration = {0, 0, -9.81};
  // Falls for 1 s.
  scene.obstacles = {{.shape = Plane{}}, {.shape = Sphere{{0.075, 0.075, 5.1}, 0.04}, .mass = 2.0}};
  scene.contact.method = ContactMethod::penalty;
  scene.contact.penalty_stiffness = 1e4;
  scene.contact.penalty_damping = 12;
  Simulation sim = built(scene);
  const auto& body = sim.state->mechanics.components[0];
  int slept = 0;
  while (simulated_time(sim) < 0.95) {
    advance(sim);
    slept += rung(sim) == Rung::asleep;
  }
  CHECK(slept > 50);
  CHECK(body.centre.z() - 0.075 == Approx(-body.mass * 9.81 / (16 * 1e4)).epsilon(1e-3));
  while (simulated_time(sim) < 1.02) advance(sim);
  CHECK(rung(sim) == Rung::full);
}

TEST_CASE("a held bar under a load that is raised slowly goes from equilibrium to equilibrium",
          "[ladder]") {
  Scene scene = floating(jittered(kuhn_box({8, 2, 2}, 0.05), 4e-3, 9));
  scene.bodies[0].held = {{.minimum = {-0.01, -1, -1}, .maximum = {0.01, 1, 1}}};
  scene.gravity = {{0, 0, -9.81}, 0.5};
  Simulation sim = built(scene);
  full_always(scene);
  Simulation full = built(scene);
  std::size_t steps = 0;
  double apart = 0, largest = 0;
  for (int i = 0; i < 500; ++i) {
    advance(sim);
    advance(full);
    steps += rung(sim) == Rung::quasi_static;
    const auto &a = sim.state->mechanics.vertices, &b = full.state->mechanics.vertices;
    for (std::size_t v = 0; v < a.size(); ++v) {
      apart = std::max(apart, (a.displacement[v] - b.displacement[v]).norm());
      largest = std::max(largest, b.displacement[v].norm());
    }
  }
  CHECK(steps > 400);
  CAPTURE(apart, largest);
  CHECK(apart < 5e-3 * largest);
}

TEST_CASE("a body too slender for one frame is warned of, a stout one is not", "[ladder]") {
  const auto warned = [](int length, double strength) {
    Scene scene = floating(kuhn_box({length, 2, 2}, 0.01));
    scene.bodies[0].material.tensile_strength = strength;
    scene.obstacles = {Obstacle{Sphere{{0, 0, -9}, 1}}};  // something to meet
    const Result<Simulation> sim = build_simulation(scene);
    REQUIRE(sim);
    return std::ranges::any_of(sim.findings, [](const Finding& f) {
      return f.code == "slender_body" && f.severity == Severity::warning;
    });
  };
  CHECK(!warned(30, 3e6));  // L/t = 15, strain 1e-4: a tenth at 32
  CHECK(warned(80, 3e6));
  CHECK(warned(30, 30e6));
  CHECK(!warned(80, std::numeric_limits<double>::infinity()));
}

TEST_CASE("a sleep of no length is refused", "[ladder]") {
  Scene scene = floating(two_tetrahedra());
  scene.ladder.sleep_after = 0;
  const Result<Simulation> sim = build_simulation(scene);
  CHECK(!sim);
  REQUIRE(!sim.findings.empty());
  CHECK(sim.findings.front().text == "ladder.sleep_after is 0 s; allowed is above 0");
}

TEST_CASE("what is hung on one edge swings, and is in no equilibrium of its own", "[ladder]") {
  Scene scene;
  scene.bodies.push_back(
      {.mesh = suite::kuhn_box({2, 1, 1}, 0.1), .held = {{{-1e-6, -1, -1e-6}, {1e-6, 1, 1e-6}}}});
  scene.gravity.ramp_time = 10;
  Simulation sim = built(scene);
  for (int k = 0; k < 100; ++k) {
    REQUIRE(advance(sim).status.outcome == StepOutcome::fine);
    CHECK(sim.state->mechanics.components[0].rung == Rung::full);
  }
}

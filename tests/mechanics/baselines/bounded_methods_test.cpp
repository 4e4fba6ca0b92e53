// SPDX-License-Identifier: MIT
// Baselines with a bound: sub-steps, modes, isolated tetrahedra; and every method with contact.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/baselines/verlet.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Corners of a cube that do not touch: every axis is a principal one.
Body regular_tetrahedron(double size) {
  return {{size * Vec3(1, 1, 1), size * Vec3(1, -1, -1), size * Vec3(-1, 1, -1),
           size * Vec3(-1, -1, 1)},
          {{VertexId{0}, VertexId{2}, VertexId{1}, VertexId{3}}}};
}

/// Turn of the component about z from one orientation to another, rad.
double turn_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond turn = b * a.conjugate();
  return 2 * std::atan2(turn.z(), turn.w());
}

}  // namespace

TEST_CASE("sub-steps are Verlet's own steps, as few as the bound allows",
          "[mechanics][baselines]") {
  std::mt19937 random(21);
  INFO("seed 21");
  const Body body = kuhn_block({3, 2, 2}, Vec3(0.6, 0.4, 0.4));
  const int order = GENERATE(1, 2);
  MechanicsState start = state_of_order(order, body, {.young_modulus = 1e8});
  place(start, ComponentId{0}, {.spin = Vec3(1, 5, -2)});
  deform(start, 1e-4, random);
  const double bound = explicit_step_bound(start);
  const double h = 20.5 * bound;
  const std::uint32_t count = sub_step_count(h, bound);
  CHECK(count == static_cast<std::uint32_t>(std::ceil(20.5 / 0.9)));
  MechanicsState divided = start, small = start;
  const StepStatus status =
      run(divided, body, {.time_step = h, .integrator = Integrator::sub_stepped}, 3);
  CHECK(status.outcome == StepOutcome::fine);
  CHECK(status.solve.sub_steps == count);
  run(small, body, {.time_step = h / count, .integrator = Integrator::verlet},
      static_cast<int>(3 * count));
  for (std::size_t v = 0; v < start.vertices.size(); ++v) {
    CHECK((divided.vertices.position[v] - small.vertices.position[v]).norm() < 1e-12);
  }
}

TEST_CASE("more sub-steps than allowed are refused with what to do", "[mechanics][baselines]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(0.2, 0.2, 0.2));
  MechanicsState state = state_of(body, {.young_modulus = 3e10});
  IntegratorSettings settings{.time_step = 1, .integrator = Integrator::sub_stepped};
  settings.max_sub_steps = 100;
  const StepStatus status = run(state, body, settings, 1);
  REQUIRE(status.outcome == StepOutcome::too_many_sub_steps);
  const Finding finding = to_finding(status);
  CHECK(finding.code == "too_many_sub_steps");
  CHECK(finding.remedy.find("max_sub_steps") != std::string::npos);
  CHECK(state.vertices.position == body.rest);
}

TEST_CASE("modes are exact at any step: amplitude, phase and energy",
          "[mechanics][baselines][vibration]") {
  const Material material{.young_modulus = 7e10, .poisson_ratio = 0, .density = 2500};
  const int order = GENERATE(1, 2);
  const Body body = kuhn_block({order == 1 ? 20 : 10, 1, 1}, Vec3(1, 0.05, 0.05));
  MechanicsState start = state_of_order(order, body, material);
  for (Vec3& x : start.vertices.position) x.x() += 1e-6 * std::sin(pi * x.x());
  reframe(start, ComponentId{0});
  const double length = 2.0 / 2642.7;  // two periods
  // Small explicit steps are the truth, to 1e-3.
  MechanicsState truth = start;
  const double small = 0.1 * explicit_step_bound(start);
  const int steps = static_cast<int>(std::ceil(length / small));
  run(truth, body, {.time_step = length / steps, .integrator = Integrator::verlet}, steps);
  for (const int count : {1, 2, 7, 100}) {
    INFO(count << " steps");
    MechanicsState state = start;
    MechanicsScratch scratch;
    measure_elements(state, scratch, body.corners);
    const double energy = total_energy(state);
    const StepStatus status =
        run(state, body, {.time_step = length / count, .integrator = Integrator::modal}, count);
    CHECK(status.outcome == StepOutcome::fine);
    CHECK(total_energy(state) == Approx(energy).epsilon(1e-8));
    CHECK(axial_amplitude(state) == Approx(axial_amplitude(truth)).epsilon(2e-3));
  }
}

TEST_CASE("modes under a sudden load swing about the static answer for ever",
          "[mechanics][baselines][vibration]") {
  const Body body = kuhn_block({6, 2, 2}, Vec3(0.6, 0.2, 0.2));
  const int order = GENERATE(1, 2);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e8});
  hold_below(state, body, -0.29);
  const Loads loads{.gravity = Vec3(9.81, 0, 0)};
  double worst = 0;
  run(state, body, {.time_step = 1e-3, .integrator = Integrator::modal}, 500, loads, [&] {
    const double total = total_energy(state) + gravity_energy(state.vertices, loads.gravity);
    double start = 0;
    for (std::size_t v = 0; v < state.vertices.size(); ++v) {
      start -= state.vertices.mass[v] * loads.gravity.dot(state.vertices.rest_position[v]);
    }
    worst = std::max(worst, std::abs(total - start) / strain_energy(state));
  });
  CHECK(worst < 1e-6);
}

TEST_CASE("a projected tetrahedron turns by atan(sin phi / (2 - cos phi)) after phi",
          "[mechanics][baselines][isolated]") {
  const Body body = regular_tetrahedron(0.05);
  MechanicsState state = state_of(body, {});
  REQUIRE(state.components[0].rigid);
  const double w = 50, h = 1e-2;
  const Vec3 velocity(1, 0, 2);
  place(state, ComponentId{0}, {.velocity = velocity, .spin = Vec3(0, 0, w)});
  IntegratorSettings settings{.time_step = h};
  settings.isolated = IsolatedTetrahedra::projection;
  // The first step starts from the tangent: x* = x + h v.
  double expected = std::atan(h * w);
  Eigen::Quaterniond last = state.components[0].orientation;
  int steps = 0;
  run(state, body, settings, 100, {}, [&] {
    const double turn = turn_between(last, state.components[0].orientation);
    CHECK(turn == Approx(expected).epsilon(1e-10));
    expected = std::atan(std::sin(turn) / (2 - std::cos(turn)));
    last = state.components[0].orientation;
    ++steps;
  });
  CHECK(steps == 100);
  // w0 / sqrt(1 + 2 h w0^2 t) = 0.14 of it after a second, for small turns.
  CHECK(expected / (h * w) == Approx(0.14).epsilon(0.1));
  CHECK((state.components[0].centre - velocity).norm() < 1e-12);
  CHECK((momentum(state.vertices) - state.components[0].mass * velocity).norm() < 1e-12);
}

TEST_CASE(
    "a tetrahedron in the frame of its edges loses its spin like implicit Euler, a rigid one "
    "none",
    "[mechanics][baselines][isolated]") {
  const Body body = regular_tetrahedron(0.05);
  const double w = 50, h = 1e-2;
  const auto left = [&](IsolatedTetrahedra isolated) {
    MechanicsState state = state_of(body, {});
    place(state, ComponentId{0}, {.velocity = Vec3(1, 0, 2), .spin = Vec3(0, 0, w)});
    const double L = angular_momentum(state.vertices).z();
    IntegratorSettings settings{.time_step = h};
    settings.isolated = isolated;
    const Loads loads{.gravity = Vec3(0, 0, -9.81)};
    REQUIRE(run(state, body, settings, 100, loads).outcome == StepOutcome::fine);
    CHECK((state.components[0].centre - Vec3(1, 0, 2 - 0.5 * 9.81)).norm() < 1e-11);
    const Vec3 p = momentum(state.vertices);
    return (angular_momentum(state.vertices) - state.components[0].centre.cross(p)).z() / L;
  };
  CHECK(left(IsolatedTetrahedra::rigid) == Approx(1).epsilon(1e-12));
  CHECK(left(IsolatedTetrahedra::qr) == Approx(0.14).epsilon(0.15));
  CHECK(left(IsolatedTetrahedra::projection) == Approx(0.14).epsilon(0.15));
}

TEST_CASE("every method lets a body fall on a plane and rest there", "[mechanics][baselines]") {
  using enum Integrator;
  const auto corotational = ElasticModel::corotational;
  const std::vector<IntegratorSettings> methods = {
      {.integrator = implicit_euler},
      {.integrator = broyden},
      {.integrator = broyden, .broyden_start = BroydenStart::factor},
      {.integrator = newton_cg},
      {.integrator = modal},
      {.integrator = implicit_euler, .model = corotational},
      {.integrator = implicit_euler,
       .model = corotational,
       .corotational_solve = CorotationalSolve::prefactored},
      {.integrator = newton_cg, .model = corotational}};
  const Body body = kuhn_block({2, 2, 2}, Vec3(0.2, 0.2, 0.2));
  for (std::size_t k = 0; k < methods.size(); ++k) {
    INFO("method " << k);
    ContactScene scene{body, state_of(body, material_of(1e9))};
    place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.11}});
    scene.loads.gravity = {0, 0, -9.81};
    scene.integrator = methods[k];
    scene.integrator.time_step = 1e-3;
    scene.obstacles = {Obstacle{Plane{}}};
    double deepest = 0;
    for (int i = 0; i < 300; ++i) {
      const ContactStepResult result = scene.step();
      REQUIRE(result.status.outcome == StepOutcome::fine);
      for (const Vec3& x : scene.state.vertices.position) deepest = std::max(deepest, -x.z());
    }
    CHECK(deepest < 1e-4);
    CHECK(scene.state.components[0].centre.z() == Approx(0.1).margin(1e-3));
    // Modes are not damped; all others come to rest.
    const double speed = scene.state.components[0].momentum.norm() / scene.state.components[0].mass;
    CHECK(speed < (scene.integrator.integrator == modal ? 0.1 : 1e-3));
  }
}

TEST_CASE("isolated tetrahedra of every kind feel contact and come to rest",
          "[mechanics][baselines][isolated]") {
  const Body body = regular_tetrahedron(0.05);
  for (const auto isolated :
       {IsolatedTetrahedra::rigid, IsolatedTetrahedra::projection, IsolatedTetrahedra::qr}) {
    INFO("kind " << static_cast<int>(isolated));
    ContactScene scene{body, state_of(body, material_of(1e9))};
    place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.2}, .spin = Vec3(3, 1, 2)});
    scene.loads.gravity = {0, 0, -9.81};
    scene.integrator.time_step = 1e-3;
    scene.integrator.isolated = isolated;
    scene.obstacles = {Obstacle{Plane{}}};
    for (int i = 0; i < 2000; ++i) {
      REQUIRE(scene.step().status.outcome == StepOutcome::fine);
    }
    const Component& component = scene.state.components[0];
    CHECK(component.momentum.norm() / component.mass < 1e-2);
    for (const Vec3& x : scene.state.vertices.position) CHECK(x.z() > -1e-3);
    // On a face: the middle is a quarter of the height above it.
    CHECK(component.centre.z() == Approx(0.05 / std::sqrt(3.0)).margin(1e-3));
  }
}

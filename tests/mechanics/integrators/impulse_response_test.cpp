// SPDX-License-Identifier: MIT
// Impulses: their effect at once, and the response matrix as the derivative of the step.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/element/energy.hpp"
#include "mechanics/integrators/impulse_response.hpp"
#include "mechanics/state/living.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Positions of `vertices` at the end of the step after `impulses`, 3 k.
Eigen::VectorXd stepped(MechanicsState state, MechanicsScratch& scratch, const StepInput& input,
                        const std::vector<VertexImpulse>& impulses,
                        const std::vector<VertexId>& vertices) {
  apply_impulses(state, impulses);
  const std::vector<ComponentId> all = living_components(state);
  predict(scratch, state, input, all);
  Eigen::VectorXd x(3 * vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    x.segment<3>(static_cast<Eigen::Index>(3 * i)) =
        scratch.predicted.position[vertices[i].index()];
  }
  return x;
}

/// Response by central differences of the step.
Eigen::MatrixXd difference(const MechanicsState& state, MechanicsScratch& scratch,
                           const StepInput& input, const std::vector<VertexId>& vertices,
                           double size) {
  const auto k = static_cast<Eigen::Index>(vertices.size());
  Eigen::MatrixXd Y(3 * k, 3 * k);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 j = size * Vec3::Unit(axis);
      const Eigen::VectorXd up = stepped(state, scratch, input, {{vertices[i], j}}, vertices);
      const Eigen::VectorXd down = stepped(state, scratch, input, {{vertices[i], -j}}, vertices);
      Y.col(static_cast<Eigen::Index>(3 * i) + axis) = (up - down) / (2 * size);
    }
  }
  return Y;
}

}  // namespace

TEST_CASE("an impulse changes the velocity of its vertex by j / m and nothing else",
          "[mechanics][impulse]") {
  std::mt19937 random(61);
  INFO("seed 61");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5)), 0.02, random);
  MechanicsState state = state_of(body, {.young_modulus = 1e8});
  place(state, ComponentId{0},
        {.orientation = random_rotation(random), .velocity = Vec3(1, 2, 3), .spin = Vec3(5, 4, 1)});
  deform(state, 1e-2, random);
  const MechanicsState before = state;
  const std::vector<VertexImpulse> hits = {
      {VertexId{5}, Vec3(1, 2, -3)}, {VertexId{20}, Vec3(0, -4, 1)}, {VertexId{5}, Vec3(2, 0, 0)}};
  apply_impulses(state, hits);
  std::vector<Vec3> expected = before.vertices.velocity;
  for (const VertexImpulse& hit : hits) {
    expected[hit.vertex.index()] += hit.impulse / before.vertices.mass[hit.vertex.index()];
  }
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    CHECK((state.vertices.velocity[v] - expected[v]).norm() < 1e-14 * (1 + expected[v].norm()));
    CHECK(state.vertices.position[v] == before.vertices.position[v]);
  }
  // The frame's description says the same: refitting it from x and v changes nothing.
  MechanicsState refitted = state;
  reframe(refitted, ComponentId{0});
  const Component& a = state.components[0];
  const Component& b = refitted.components[0];
  CHECK((a.momentum - b.momentum).norm() < 1e-13 * a.momentum.norm());
  CHECK((a.angular_momentum - b.angular_momentum).norm() < 1e-12 * a.angular_momentum.norm());
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    CHECK((state.vertices.displacement_rate[v] - refitted.vertices.displacement_rate[v]).norm() <
          1e-12);
  }
}

TEST_CASE("the response matrix is the derivative of the step", "[mechanics][impulse]") {
  std::mt19937 random(62);
  INFO("seed 62");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5)), 0.02, random);
  const Integrator integrator =
      GENERATE(Integrator::floating_frame, Integrator::implicit_euler, Integrator::verlet);
  const double rho = integrator == Integrator::floating_frame ? GENERATE(0.0, 0.5) : 0.0;
  const double h = integrator == Integrator::verlet ? 1e-6 : GENERATE(1e-5, 1e-3);
  const bool damped = integrator == Integrator::verlet ? false : GENERATE(false, true);
  const bool supported = GENERATE(false, true);
  IntegratorSettings settings{.time_step = h, .integrator = integrator, .rho_infinity = rho};
  if (damped) settings.damping = {.mass_factor = 20, .stiffness_factor = 1e-4};
  MechanicsState state = state_of(body, {.young_modulus = 1e8});
  MechanicsScratch scratch;
  if (supported) {
    state.motions.push_back({.velocity = Vec3(0, 0, 0.1)});
    for (std::size_t v = 0; v < 9; ++v) state.vertices.support[v] = MotionId{0};
    const std::vector<ComponentId> whole = {ComponentId{0}};
    rebuild(state, body.corners, whole, scratch);
  }
  place(state, ComponentId{0},
        {.orientation = random_rotation(random), .velocity = Vec3(0, 0, 0.1)});
  const Loads loads{.gravity = Vec3(0, 0, -9.81)};
  const StepInput input{body.corners, loads, settings};
  const std::vector<VertexId> struck = {VertexId{2}, VertexId{17}, VertexId{30}, VertexId{18}};

  const Eigen::MatrixXd Y = end_of_step_response(state, input, {ComponentId{0}, struck});
  // At rest the step is linear in the impulse but for the turn of the frame, second order: an
  // impulse that moves vertices by 1e-6 m leaves 1e-6 relative, rounding of x 1e-16 / 1e-6.
  const double size = 1e-6 / Y.diagonal().maxCoeff();
  const Eigen::MatrixXd expected = difference(state, scratch, input, struck, size);
  CHECK((Y - expected).norm() < 1e-7 * expected.norm());
  CHECK((Y - Y.transpose()).norm() < 1e-12 * Y.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Y);
  CHECK(solver.eigenvalues().minCoeff() > -1e-12 * solver.eigenvalues().maxCoeff());
  if (supported) CHECK(Y.topRows(3).isZero());  // vertex 2 is held
}

TEST_CASE("the response of a spinning, deformed body is right to the order of h w",
          "[mechanics][impulse]") {
  std::mt19937 random(63);
  INFO("seed 63");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5)), 0.02, random);
  const double h = 1e-3, w = 20;
  MechanicsState state = state_of(body, {.young_modulus = 1e8});
  place(state, ComponentId{0},
        {.orientation = random_rotation(random), .spin = w * Vec3(1, 2, 2) / 3});
  deform(state, 1e-3, random);
  const IntegratorSettings settings{.time_step = h};
  const Loads none;
  const StepInput input{body.corners, none, settings};
  const std::vector<VertexId> struck = {VertexId{2}, VertexId{17}, VertexId{30}};
  MechanicsScratch scratch;
  const Eigen::MatrixXd Y = end_of_step_response(state, input, {ComponentId{0}, struck});
  const double size = 1e-6 / Y.diagonal().maxCoeff();
  const Eigen::MatrixXd expected = difference(state, scratch, input, struck, size);
  CHECK((Y - expected).norm() < 2 * h * w * expected.norm());
}

TEST_CASE("an isolated tetrahedron answers as a rigid body", "[mechanics][impulse][isolated]") {
  const Body body = single_tetrahedron(0.1);
  MechanicsState state = state_of(body, {});
  const IntegratorSettings settings{.time_step = 1e-3};
  const Loads none;
  const StepInput input{body.corners, none, settings};
  const std::vector<VertexId> struck = {VertexId{0}, VertexId{3}};
  MechanicsScratch scratch;
  const Eigen::MatrixXd Y = end_of_step_response(state, input, {ComponentId{0}, struck});
  const double size = 1e-7 / Y.diagonal().maxCoeff();
  const Eigen::MatrixXd expected = difference(state, scratch, input, struck, size);
  CHECK((Y - expected).norm() < 1e-6 * expected.norm());

  const Vec3 j(1, 2, 3);
  const Vec3 P = momentum(state.vertices), L = angular_momentum(state.vertices);
  const std::vector<VertexImpulse> hit = {{VertexId{1}, j}};
  apply_impulses(state, hit);
  CHECK((momentum(state.vertices) - P - j).norm() < 1e-14 * j.norm());
  const Vec3 torque = state.vertices.position[1].cross(j);
  CHECK((angular_momentum(state.vertices) - L - torque).norm() < 1e-13 * torque.norm());
}

TEST_CASE("predicting again after impulses is a step from the struck state",
          "[mechanics][impulse]") {
  std::mt19937 random(64);
  INFO("seed 64");
  const Body body = kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5));
  MechanicsState a = state_of(body, {.young_modulus = 1e8});
  place(a, ComponentId{0}, {.spin = Vec3(3, 1, 2)});
  deform(a, 1e-3, random);
  MechanicsState b = a;
  const IntegratorSettings settings;
  const Loads none;
  const StepInput input{body.corners, none, settings};
  const std::vector<VertexImpulse> hits = {{VertexId{7}, Vec3(1, 2, 3)}};
  const std::vector<ComponentId> all = {ComponentId{0}};

  MechanicsScratch twice, once;
  predict(twice, a, input, all);
  end_of_step_response(a, input, {ComponentId{0}, std::array{VertexId{7}}});
  apply_impulses(a, hits);
  predict(twice, a, input, all);
  adopt(a, twice, input);
  apply_impulses(b, hits);
  advance(b, once, input);
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    CHECK(a.vertices.position[v] == b.vertices.position[v]);
    CHECK(a.vertices.velocity[v] == b.vertices.velocity[v]);
  }
}

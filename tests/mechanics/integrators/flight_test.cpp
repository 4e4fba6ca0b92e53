// SPDX-License-Identifier: MIT
// Free bodies: momenta, energy, spin and the stress of spinning, with every integrator.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/baselines/verlet.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/frame/rotation.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

double largest_stress(const MechanicsState& state) {
  double largest = 0;
  for (const Mat3& sigma : state.elements.stress) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(sigma, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues()[2]);
  }
  return largest;
}

}  // namespace

TEST_CASE("momenta of a spinning, vibrating body stay, recomputed from x and v, for 10^4 steps",
          "[mechanics][flight]") {
  std::mt19937 random(41);
  INFO("seed 41");
  const Body body = shaken(kuhn_block({4, 2, 2}, Vec3(1, 0.5, 0.5)), 0.02, random);
  const double h = GENERATE(1e-4, 1e-2);
  MechanicsState state = state_of(body, {.young_modulus = 1e8});
  place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3), .spin = Vec3(5, 20, 10)});
  deform(state, 1e-2, random);
  const Vec3 P = momentum(state.vertices);
  const Vec3 L = angular_momentum(state.vertices);
  double drift_P = 0, drift_L = 0;
  double energy = 0, most_energy = 0;
  const StepStatus status = run(state, body, {.time_step = h}, 10000, {}, [&] {
    drift_P = std::max(drift_P, (momentum(state.vertices) - P).norm() / P.norm());
    drift_L = std::max(drift_L, (angular_momentum(state.vertices) - L).norm() / L.norm());
    const double now = total_energy(state);
    if (energy == 0) energy = now;
    most_energy = std::max(most_energy, now);
  });
  REQUIRE(status.outcome == StepOutcome::fine);
  CHECK(drift_P < 1e-10);
  CHECK(drift_L < 1e-10);
  CHECK(most_energy <= energy * (1 + 1e-12));
}

TEST_CASE("the centre of mass is on the parabola", "[mechanics][flight]") {
  std::mt19937 random(42);
  INFO("seed 42");
  const Body body = kuhn_block({3, 2, 2}, Vec3(0.3, 0.2, 0.2));
  const double h = GENERATE(1e-5, 1e-3, 1.0 / 30);
  const double E = GENERATE(1e5, 1e8, 1e12);
  MechanicsState state = state_of(body, {.young_modulus = E});
  place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3), .spin = Vec3(1, 2, 1)});
  deform(state, 1e-3, random);
  const Vec3 start = state.components[0].centre;
  const Vec3 velocity = state.components[0].momentum / state.components[0].mass;
  const Loads loads{.gravity = Vec3(0, 0, -9.81)};
  const StepStatus status = run(state, body, {.time_step = h}, 300, loads);
  REQUIRE(status.outcome == StepOutcome::fine);
  const double t = 300 * h;
  Vec3 centre = Vec3::Zero();
  double mass = 0;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    centre += state.vertices.mass[v] * state.vertices.position[v];
    mass += state.vertices.mass[v];
  }
  centre /= mass;
  const Vec3 expected = start + t * velocity + 0.5 * t * t * loads.gravity;
  CHECK((centre - expected).norm() < 1e-12 * (1 + expected.norm()));
}

TEST_CASE("energy without load never grows, at any stiffness and step", "[mechanics][flight]") {
  const Body body = kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5));
  const double E = GENERATE(1e6, 1e8, 3e10, 1e12);
  const double h = GENERATE(1e-6, 1e-4, 1e-2, 1.0 / 30);
  const double rho = GENERATE(0.0, 0.5);
  std::mt19937 random(43);
  INFO("seed 43, E " << E << ", h " << h << ", rho " << rho);
  MechanicsState state = state_of(body, {.young_modulus = E});
  place(state, ComponentId{0}, {.spin = Vec3(3, 4, 1)});
  deform(state, 1e-4, random);
  double energy = 0, growth = 0;
  const IntegratorSettings settings{.time_step = h, .rho_infinity = rho};
  const StepStatus status = run(state, body, settings, 500, {}, [&] {
    const double now = total_energy(state);
    if (energy == 0) energy = now;
    growth = std::max(growth, now / energy - 1);
  });
  REQUIRE(status.outcome == StepOutcome::fine);
  // Rigid rotation is second order: its own energy error is (h w)^2 times the strain's share.
  CHECK(growth < 1e-6);
}

TEST_CASE("a stiff body at 50 rad/s and 10 ms carries its centrifugal stress and no more",
          "[mechanics][flight][spin]") {
  const double w = 50, length = 1;
  const Body body = kuhn_block({10, 2, 2}, Vec3(length, 0.1, 0.1));
  const Material material{.young_modulus = 30e9};
  const double h = GENERATE(1e-4, 1e-3, 1e-2);
  MechanicsState state = state_of(body, material);
  place(state, ComponentId{0}, {.spin = Vec3(0, 0, w)});
  const Vec3 L = angular_momentum(state.vertices);
  double peak = 0;
  const StepStatus status = run(state, body, {.time_step = h}, 200, {},
                                [&] { peak = std::max(peak, largest_stress(state)); });
  REQUIRE(status.outcome == StepOutcome::fine);
  // rho w^2 L^2 / 8 on the axis of a thin rod. The middle elements' mean is 1 % below; lateral
  // inertia and the shape of single tetrahedra add 3 %.
  const double expected = material.density * w * w * length * length / 8;
  CHECK(largest_stress(state) == Approx(expected).epsilon(0.05));
  // A sudden start at small steps is a real wave, of twice the static stress at most.
  CHECK(peak < 2.2 * expected);
  CHECK(peak < material.tensile_strength);
  CHECK((angular_momentum(state.vertices) - L).norm() < 1e-12 * L.norm());
}

TEST_CASE("implicit Euler in the predicted frame loses spin as w0 / sqrt(1 + 2 h w0^2 t)",
          "[mechanics][flight][implicit_euler]") {
  // A square plate about its normal: the decay follows in closed form for a stiff planar body.
  const Body body = kuhn_block({4, 4, 1}, Vec3(1, 1, 0.1));
  const double w0 = 10, h = 1e-3;
  MechanicsState state = state_of(body, {.young_modulus = 1e13});
  place(state, ComponentId{0}, {.spin = Vec3(0, 0, w0)});
  const double L0 = angular_momentum(state.vertices).norm();
  const IntegratorSettings settings{.time_step = h,
                                    .integrator = Integrator::implicit_euler,
                                    .euler_frame = EulerFrame::predicted};
  const StepStatus status = run(state, body, settings, 1000);
  REQUIRE(status.outcome == StepOutcome::fine);
  const double expected = 1 / std::sqrt(1 + 2 * h * w0 * w0 * 1.0);
  // Three digits: the next term of the series is (h w0)^2 = 1e-4.
  CHECK(angular_momentum(state.vertices).norm() / L0 == Approx(expected).epsilon(1e-3));
}

TEST_CASE("implicit Euler in the frame of x_n makes the false stress E (h w)^2 / (2 (1 - nu))",
          "[mechanics][flight][implicit_euler]") {
  const Body body = kuhn_block({4, 4, 1}, Vec3(1, 1, 0.1));
  const Material material{.young_modulus = 1e12, .poisson_ratio = 0.2};
  const double w = 50, h = 1e-3;
  MechanicsState state = state_of(body, material);
  place(state, ComponentId{0}, {.spin = Vec3(0, 0, w)});
  const IntegratorSettings settings{.time_step = h, .integrator = Integrator::implicit_euler};
  const StepStatus status = run(state, body, settings, 100);
  REQUIRE(status.outcome == StepOutcome::fine);
  const double expected = material.young_modulus * h * h * w * w / (2 * (1 - 0.2));
  // Plane stress and plane strain differ by nu; the plate is in between at a 10th of its width.
  CHECK(largest_stress(state) == Approx(expected).epsilon(0.15));
}

TEST_CASE("an isolated tetrahedron keeps its spin and its shape", "[mechanics][flight][isolated]") {
  std::mt19937 random(44);
  INFO("seed 44");
  const double size = GENERATE(1e-3, 1.0);
  const double h = GENERATE(1e-4, 1e-2);
  const Body body = single_tetrahedron(size);
  MechanicsState state = state_of(body, {});
  REQUIRE(state.components[0].rigid);
  place(state, ComponentId{0}, {.velocity = Vec3(1, 0, 0), .spin = Vec3(30, 40, 5)});
  const Vec3 L = state.components[0].angular_momentum;
  const double energy = kinetic_energy(state.vertices);
  const StepStatus status = run(state, body, {.time_step = h}, 10000);
  REQUIRE(status.outcome == StepOutcome::fine);
  // L about the centre, recomputed from the vertices.
  Vec3 now = Vec3::Zero();
  for (std::size_t v = 0; v < 4; ++v) {
    now +=
        state.vertices.mass[v] *
        (state.vertices.position[v] - state.components[0].centre).cross(state.vertices.velocity[v]);
  }
  // Positions of 100 m (10^4 steps at 1 m/s) hold 1e-3 m to 1e-11 only.
  const double rounding = 1e-13 + 1e-14 * 1e4 * h / size;
  CHECK((now - L).norm() < rounding * L.norm());
  CHECK(kinetic_energy(state.vertices) == Approx(energy).epsilon(1e-10));
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double length = (state.vertices.position[a] - state.vertices.position[b]).norm();
      CHECK(length == Approx((body.rest[a] - body.rest[b]).norm()).epsilon(rounding));
    }
  }
}

TEST_CASE("a rod spun about a principal axis turns by the exact angle", "[mechanics][flight]") {
  const Body body = kuhn_block({4, 2, 2}, Vec3(1, 0.3, 0.2));
  MechanicsState state = state_of(body, {.young_modulus = 1e13});
  // Kuhn's diagonals tilt the principal axes of the lumped masses by some degrees.
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(state.components[0].rest_inertia);
  const Vec3 spin = 20 * axes.eigenvectors().col(2);
  place(state, ComponentId{0}, {.spin = spin});
  run(state, body, {.time_step = 1e-2}, 100);
  const Eigen::Quaterniond expected = rotation_of(spin);
  const double off = 2 * (state.components[0].orientation.conjugate() * expected).vec().norm();
  // 20 rad less the centrifugal growth of the inertia, about rho w^2 L^2 / (4 E) = 2e-8 of it.
  CHECK(off < 1e-6);
}

TEST_CASE("floating frame and verlet, which share no formula of motion, agree",
          "[mechanics][flight][twin]") {
  std::mt19937 random(45);
  INFO("seed 45");
  const Body body = kuhn_block({3, 2, 2}, Vec3(1, 0.6, 0.5));
  const Material material{.young_modulus = 1e7, .density = 1000};
  MechanicsState start = state_of(body, material);
  place(start, ComponentId{0}, {.velocity = Vec3(0.1, 0, 0), .spin = Vec3(2, 3, 4)});
  deform(start, 1e-3, random);
  const double h = 0.05 * explicit_step_bound(start);
  const int steps = 400;
  MechanicsState twin = start;
  run(twin, body, {.time_step = h, .integrator = Integrator::verlet}, steps);
  const auto gap = [&](double step, int count, double rho) {
    MechanicsState state = start;
    run(state, body, {.time_step = step, .rho_infinity = rho}, count);
    double worst = 0;
    for (std::size_t v = 0; v < body.rest.size(); ++v) {
      worst = std::max(worst, (state.vertices.position[v] - twin.vertices.position[v]).norm());
    }
    return worst;
  };
  const double amplitude = 1e-3 * start.components[0].rest_radius;
  // Second order: rest_radius * 1e-3 of vibration, its phase wrong by (w h)^2 at most.
  CHECK(gap(h, steps, 0.5) < 0.05 * amplitude);
  CHECK(gap(h, steps, 0) < 0.3 * amplitude);
}

TEST_CASE("verlet is bounded below the element bound and reports what happens far above",
          "[mechanics][flight][verlet]") {
  std::mt19937 random(46);
  INFO("seed 46");
  const Body body = kuhn_block({3, 2, 2}, Vec3(1, 0.6, 0.5));
  MechanicsState state = state_of(body, {.young_modulus = 1e9});
  const double bound = explicit_step_bound(state);
  deform(state, 1e-3, random);
  MechanicsState wild = state;
  double energy = 0, most = 0;
  StepStatus status =
      run(state, body, {.time_step = bound, .integrator = Integrator::verlet}, 2000, {}, [&] {
        if (energy == 0) energy = total_energy(state);
        most = std::max(most, total_energy(state));
      });
  CHECK(status.outcome == StepOutcome::fine);
  CHECK(most < 3 * energy);
  status = run(wild, body, {.time_step = 2 * bound, .integrator = Integrator::verlet}, 2000);
  REQUIRE(status.outcome != StepOutcome::fine);
  const Finding finding = to_finding(status);
  CHECK(finding.code == "diverged");
  CHECK(finding.ids.size() == 1);
  CHECK(finding.remedy.find("explicit_step_bound") != std::string::npos);
}

TEST_CASE("a rigid body turns by the exact angle in a step of many turns", "[mechanics][flight]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(1, 0.7, 0.5));
  const Material material{.young_modulus = 1e9};
  MechanicsState state = state_of(body, material);
  state.components[0].rung = Rung::rigid;
  // About any other axis the spin would not be steady.
  const Eigen::SelfAdjointEigenSolver<Mat3> inertia(state.components[0].rest_inertia);
  const Vec3 axis = inertia.eigenvectors().col(2);
  place(state, ComponentId{0}, {.spin = 10 * axis});
  MechanicsScratch scratch;
  const Loads none;
  const IntegratorSettings settings{.time_step = 80};
  const StepStatus status = advance(state, scratch, {body.corners, none, settings});
  REQUIRE(status.outcome == StepOutcome::fine);
  const Eigen::Quaterniond& R = state.components[0].orientation;
  // 800 rad.
  CHECK(std::abs(R.w()) == Approx(std::abs(std::cos(400.0))).margin(1e-6));
  CHECK(std::abs(R.vec().dot(axis)) == Approx(std::abs(std::sin(400.0))).margin(1e-6));
}

TEST_CASE("a step that a body spins through too often is refused by the key time_step",
          "[mechanics][flight][failure]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(1, 0.7, 0.5));
  const Rung rung = GENERATE(Rung::rigid, Rung::full);
  MechanicsState state = state_of(body, {.young_modulus = 1e9});
  state.components[0].rung = rung;
  place(state, ComponentId{0}, {.spin = Vec3(1, 2, 100)});
  MechanicsScratch scratch;
  const Loads none;
  const IntegratorSettings settings{.time_step = 80};
  const StepStatus status = advance(state, scratch, {body.corners, none, settings});
  REQUIRE(status.outcome == StepOutcome::spun_too_far);
  CHECK(status.turned == Approx(80 * Vec3(1, 2, 100).norm()).epsilon(1e-6));
  const Finding finding = to_finding(status);
  CHECK(finding.code == "spun_too_far");
  CHECK(finding.text.find("spins by 8e+03 rad within one step") != std::string::npos);
  CHECK(finding.remedy.find("time_step below 0.0314 s") != std::string::npos);
}

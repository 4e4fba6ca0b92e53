// SPDX-License-Identifier: MIT
// Damping of explicit steps: viscous forces, their work, and the largest stable step.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/baselines/verlet.hpp"
#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Sum, moment about the origin, power, and sum of sizes of forces at x on points with velocity v.
/// v.
struct Totals {
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double power = 0, size = 0;
};

Totals totals(std::span<const Vec3> force, std::span<const Vec3> x, std::span<const Vec3> v) {
  Totals all;
  for (std::size_t i = 0; i < x.size(); ++i) {
    all.sum += force[i];
    all.moment += x[i].cross(force[i]);
    all.power += v[i].dot(force[i]);
    all.size += force[i].norm();
  }
  return all;
}

/// Largest size of an eigenvalue of damped Verlet for x'' = -w^2 x, of a sub-step of h among many
/// (`ends` = false) and of a step that is one (`ends`): half the kick before it and half after it.
double spectral_radius(double w, double b, double h, bool ends) {
  const auto kick = [&](double length) {
    return (Eigen::Matrix2d() << 1, 0, -length * w * w, 1 - length * b * w * w).finished();
  };
  const Eigen::Matrix2d drift = (Eigen::Matrix2d() << 1, h, 0, 1).finished();
  const Eigen::Matrix2d first = kick(ends ? h / 2 : h), last = kick(ends ? h / 2 : 0);
  const Eigen::Matrix2d step = last * drift * first;
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("a viscosity feels no rigid motion, has no net force or torque and only takes energy",
          "[mechanics][baselines][damping]") {
  std::mt19937 random(61);
  INFO("seed 61");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.6, 0.6)), 0.03, random);
  const int order = GENERATE(1, 2);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e6, .poisson_ratio = 0.3});
  const Component& component = state.components[0];
  const double factor = 1e-3;
  for (int k = 0; k < 10; ++k) {
    // Strained by a tenth, turned and far away; even k: moving rigidly, odd: anyhow.
    const Mat3 R = random_rotation(random).toRotationMatrix();
    const Vec3 place = 10 * random_vector(random), spin = random_vector(random),
               speed = random_vector(random);
    std::vector<Vec3> x, v;
    for (const Vec3& X : state.vertices.rest_position) {
      x.push_back(R * (X + 0.05 * random_vector(random)) + place);
      v.push_back(k % 2 == 0 ? Vec3(speed + spin.cross(x.back())) : random_vector(random));
    }
    std::vector<Vec3> force(x.size());
    viscous_forces(force, {state, body.corners, x}, v, component, factor);
    const Totals all = totals(force, x, v);
    if (k % 2 == 0) {
      CHECK(all.size < 1e-10 * factor * 1e6);
      continue;
    }
    CHECK(all.size > 1e-2 * factor * 1e6);
    CHECK(all.sum.norm() < 1e-12 * all.size);
    CHECK(all.moment.norm() < 1e-11 * all.size);
    CHECK(all.power < 0);
  }
}

TEST_CASE("where nothing is strained a viscosity is the stiffness of the rate",
          "[mechanics][baselines][damping]") {
  std::mt19937 random(62);
  INFO("seed 62");
  const Body body = shaken(kuhn_block({2, 2, 3}, Vec3(0.5, 0.5, 1)), 0.03, random);
  const int order = GENERATE(1, 2);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e6, .poisson_ratio = 0.3});
  const Mat3 R = random_rotation(random).toRotationMatrix();
  std::vector<Vec3> x, v;
  for (const Vec3& X : state.vertices.rest_position) {
    x.push_back(R * X);
    v.push_back(random_vector(random));
  }
  const ElasticInput input{state, body.corners, x};
  const Component& component = state.components[0];
  std::vector<Mat3> turns;
  element_rotations(turns, input, component);
  std::vector<Vec3> force(x.size()), product(x.size());
  viscous_forces(force, input, v, component, 2e-3);
  corotational_product(product, {input, component, turns}, v);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK((force[i] + 2e-3 * product[i]).norm() < 1e-9 * product[i].norm());
  }
}

TEST_CASE("the stable step with damping is where the spectral radius passes one",
          "[mechanics][baselines][damping]") {
  const double w = 3e5, bound = 2 / w;
  CHECK(damped_step_bound(bound, 0) == Approx(bound));
  CHECK(damped_step_bound(bound, 1e6 * bound) == Approx(0.5e-6 * bound));
  CHECK(std::isinf(damped_step_bound(std::numeric_limits<double>::infinity(), 1)));
  for (const double b : {0.0, 0.1, 1.0, 10.0, 1e4}) {
    const double h = damped_step_bound(bound, b * bound);
    INFO(b);
    for (const bool ends : {false, true}) {
      CHECK(spectral_radius(w, b * bound, 0.999 * h, ends) < 1 + 1e-12);
    }
    CHECK(spectral_radius(w, b * bound, 1.001 * h, false) > 1);
  }
}

TEST_CASE("explicit steps with damping: a mode falls as it should, its energy is in the account",
          "[mechanics][baselines][damping]") {
  const Material material{.young_modulus = 7e10, .poisson_ratio = 0, .density = 2500};
  const int order = GENERATE(1, 2);
  const ElasticModel model = GENERATE(ElasticModel::rigid_reference, ElasticModel::corotational);
  const Integrator integrator = GENERATE(Integrator::sub_stepped, Integrator::verlet);
  const Body body = kuhn_block({order == 1 ? 20 : 10, 1, 1}, Vec3(1, 0.05, 0.05));
  MechanicsState state = state_of_order(order, body, material);
  for (Vec3& x : state.vertices.position) x.x() += 1e-6 * std::sin(pi * x.x());
  reframe(state, ComponentId{0});
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners, {.model = model});
  const double start = total_energy(state), amplitude = axial_amplitude(state);
  // c / 2L, as a bar of lumped masses has it; a tenth of critical damping.
  const double w = 2 * pi * 2642.7, ratio = 0.1, factor = 2 * ratio / w;
  IntegratorSettings settings{.integrator = integrator, .model = model};
  settings.damping.stiffness_factor = factor;
  const double bound = damped_step_bound(explicit_step_bound(state), factor);
  const double length = 2 * pi / w / std::sqrt(1 - ratio * ratio);  // a period
  const int steps = integrator == Integrator::verlet ? static_cast<int>(1.2 * length / bound) : 50;
  settings.time_step = length / steps;
  double taken = 0;
  for (int i = 0; i < steps; ++i) {
    const StepStatus status = advance(state, scratch, {body.corners, {}, settings});
    REQUIRE(status.outcome == StepOutcome::fine);
    CHECK(status.damping_work >= 0);
    taken += status.damping_work;
  }
  const double left = std::exp(-2 * pi * ratio / std::sqrt(1 - ratio * ratio));
  CHECK(axial_amplitude(state) == Approx(left * amplitude).epsilon(0.02));
  CHECK(start - total_energy(state) == Approx(taken).epsilon(2e-3));
}

TEST_CASE("strong damping stays bounded and leaves momenta and a spin as they were",
          "[mechanics][baselines][damping]") {
  std::mt19937 random(63);
  INFO("seed 63");
  const Body body = kuhn_block({4, 2, 2}, Vec3(0.8, 0.4, 0.4));
  const int order = GENERATE(1, 2);
  const ElasticModel model = GENERATE(ElasticModel::rigid_reference, ElasticModel::corotational);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e8});
  place(state, ComponentId{0}, {.velocity = Vec3(0.3, 0, 1), .spin = Vec3(1, 5, -2)});
  deform(state, 1e-3, random);
  const double bound = explicit_step_bound(state);
  IntegratorSettings settings{
      .time_step = 5 * bound, .integrator = Integrator::sub_stepped, .model = model};
  settings.damping.stiffness_factor = 4 * bound;
  const Vec3 linear = momentum(state.vertices), angular = angular_momentum(state.vertices);
  StepStatus last;
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners, {.model = model});
  const double wild = strain_energy(state);
  for (int i = 0; i < 400; ++i) {
    last = advance(state, scratch, {body.corners, {}, settings});
    REQUIRE(last.outcome == StepOutcome::fine);
  }
  CHECK((momentum(state.vertices) - linear).norm() < 1e-12 * linear.norm());
  CHECK((angular_momentum(state.vertices) - angular).norm() < 1e-11 * angular.norm());
  // The ringing is gone; the stretch by the spin stays.
  CHECK(strain_energy(state) < 0.01 * wild);
  CHECK(last.solve.sub_steps ==
        sub_step_count(settings.time_step, damped_step_bound(bound, 4 * bound)));
}

TEST_CASE("damping on moving supports: nothing at a common speed, all of it where one pulls",
          "[mechanics][baselines][damping][supports]") {
  const Body body = kuhn_block({6, 2, 2}, Vec3(0.6, 0.2, 0.2));
  const int order = GENERATE(1, 2);
  const double pull = GENERATE(0.0, 0.05);
  MechanicsState state = state_of_order(order, body, {.young_modulus = 1e8, .poisson_ratio = 0});
  state.motions = {{.velocity = Vec3(0.2, 0, 0.1)}, {.velocity = Vec3(0.2 + pull, 0, 0.1)}};
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const double x = state.vertices.rest_position[v].x();
    if (x < -0.29) state.vertices.support[v] = MotionId{0};
    if (x > 0.29) state.vertices.support[v] = MotionId{1};
  }
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
  // At once the even stretch that the supports ask for.
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const double x = state.vertices.rest_position[v].x();
    state.vertices.velocity[v] = state.motions[0].velocity + Vec3(pull * (x + 0.3) / 0.6, 0, 0);
  }
  reframe(state, ComponentId{0});
  IntegratorSettings settings{.time_step = 1e-4, .integrator = Integrator::sub_stepped};
  settings.damping.stiffness_factor = 1e-4;
  double taken = 0;
  for (int i = 0; i < 20; ++i) {
    const StepStatus status = advance(state, scratch, {body.corners, {}, settings});
    REQUIRE(status.outcome == StepOutcome::fine);
    taken += status.damping_work;
  }
  // b E (e')^2 V t, with an even rate of strain e'.
  const double rate = pull / 0.6, volume = 0.6 * 0.2 * 0.2;
  CHECK(taken == Approx(1e-4 * 1e8 * rate * rate * volume * 20e-4).epsilon(1e-3).margin(1e-12));
}

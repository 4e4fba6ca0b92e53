// SPDX-License-Identifier: MIT
// Pieces against each other by their surfaces.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/state/living.hpp"
#include "tests/mechanics/contact/cut_block.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

Body moved(Body body, const Vec3& shift) {
  for (Vec3& x : body.rest) x += shift;
  return body;
}

ContactScene scene_of(const SeveralBodies& all, double young_modulus, double time_step) {
  ContactScene scene{all.body, state_of(all, material_of(young_modulus))};
  scene.integrator.time_step = time_step;
  return scene;
}

/// Cuts a block at x = `plane` and gives the right side a new id.
void cut(ContactScene& scene, double plane) {
  std::vector<bool> right;
  for (const Corners& corners : scene.body.corners) {
    right.push_back(!(centre_of(corners, scene.state.vertices.rest_position).x() < plane));
  }
  part(scene.state, scene.body, right, true, scene.mechanics);
}

/// Twelve bars with balls that interlock as they fall, and a ball on top, 36 J.
ContactScene interlocked_bars() {
  std::mt19937 random(21);
  std::vector<Body> parts;
  for (int k = 0; k < 12; ++k) {
    parts.push_back(moved(kuhn_block({1, 1, 2}, {0.05, 0.05, 0.1}),
                          0.1 * random_vector(random) + Vec3(0, 0, 0.12 + 0.02 * k)));
  }
  ContactScene scene = scene_of(together(parts), 1e8, 1e-3);
  scene.loads.gravity = {0, 0, -9.81};
  Obstacle ball{Sphere{{0, 0, 0.6}, 0.08}, {0, 0, -3}};
  ball.mass = 2;
  scene.obstacles = {Obstacle{Plane{}}, ball};
  return scene;
}

}  // namespace

TEST_CASE("a body cut in two at rest keeps zero kinetic energy", "[mechanics][contact]") {
  const Body body = kuhn_block({4, 3, 3}, {0.4, 0.3, 0.3});
  ContactScene scene{body, state_of(body, material_of(3e10))};
  scene.integrator.time_step = GENERATE(1e-5, 1e-3, 1.0 / 60);
  place(scene.state, ComponentId{0},
        {.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized())),
         .translation = {1, 2, 3}});
  scene.step();
  cut(scene, 0.0);
  REQUIRE(living_components(scene.state).size() == 2);
  const std::vector<Vec3> before = scene.state.vertices.position;
  double kinetic = 0;
  for (int k = 0; k < 100; ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    CHECK(result.report.contacts == 0);
    kinetic = std::max(kinetic, kinetic_energy(scene.state.vertices));
  }
  // Rounding of positions (4e-16 m) over a step, for the whole mass of 86 kg.
  const double rounding = 64 * 4e-16 / scene.integrator.time_step;
  CHECK(kinetic <= 0.5 * 86.4 * rounding * rounding);
  for (std::size_t v = 0; v < before.size(); ++v) {
    CHECK((scene.state.vertices.position[v] - before[v]).norm() < 1e-12);
  }
}

TEST_CASE("pieces that part and are pushed back meet where they were one", "[mechanics][contact]") {
  const Body body = kuhn_block({4, 3, 3}, {0.4, 0.3, 0.3});
  ContactScene scene{body, state_of(body, material_of(1e9))};
  scene.integrator.time_step = 1e-3;
  scene.step();
  cut(scene, 0.0);
  // No partners: the search alone closes the gap. Apart by 2 cm, then back at 1 m/s, aside by 1 cm,
  // so that no vertex meets its former copy.
  place(scene.state, ComponentId{1}, {.translation = {0.02, 0.01, 0.01}, .velocity = {-0.5, 0, 0}});
  place(scene.state, ComponentId{0}, {.velocity = {0.5, 0, 0}});
  const auto distance = [&] {
    return scene.state.components[1].centre.x() - scene.state.components[0].centre.x();
  };
  double least = distance();
  for (int k = 0; k < 60; ++k) {
    scene.step();
    least = std::min(least, distance());
  }
  CHECK(least > 0.2 - 1e-3);
  CHECK(least < 0.2 + 1e-3);
}

TEST_CASE("two equal blocks head-on keep their momentum exactly and never gain energy",
          "[mechanics][contact]") {
  const double time_step = GENERATE(1e-5, 1e-3, 1e-2);
  const double young_modulus = GENERATE(1e6, 1e10);
  const Body block = kuhn_block({3, 3, 3}, {0.3, 0.3, 0.3});
  const SeveralBodies all = together({moved(block, {-0.2, 0, 0}), moved(block, {0.2, 0.02, 0.01})});
  ContactScene scene = scene_of(all, young_modulus, time_step);
  place(scene.state, ComponentId{0}, {.velocity = {3, 0, 0}});
  place(scene.state, ComponentId{1}, {.velocity = {-1, 0, 0}});
  const Vec3 p0 = momentum(scene.state.vertices);
  const double e0 = scene.energy();
  std::uint32_t most = 0;
  for (int k = 0; k < std::min(6000, static_cast<int>(0.2 / time_step)); ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    most = std::max(most, result.report.contacts);
    CHECK((momentum(scene.state.vertices) - p0).norm() < 1e-12 * 64.8 * 4);
    CHECK(scene.energy() <= e0 * (1 + 1e-9));
  }
  CHECK(most > 4);
  INFO("h " << time_step << " E " << young_modulus);
  // They did not pass through each other: 0.06 s and more at 4 m/s would have brought the centres
  // within 0.16 m. Their surfaces meet at 0.3 m, and the soft ones are squeezed.
  const double apart = scene.state.components[1].centre.x() - scene.state.components[0].centre.x();
  CHECK(apart > 0.29);
}

TEST_CASE("pieces that meet off centre with friction keep their momentum and angular momentum",
          "[mechanics][contact]") {
  // Every way in which an impulse reaches a body: split between frame and deformation, explicit
  // steps, jumps of velocities, whole bodies of one tetrahedron.
  struct Way {
    Integrator integrator;
    Deformation deformation;
    double time_step;
  };
  const Way way = GENERATE(Way{Integrator::floating_frame, Deformation::whole, 1e-3},
                           Way{Integrator::floating_frame, Deformation::whole, 1.0 / 60},
                           Way{Integrator::floating_frame, Deformation::wave, 1e-4},
                           Way{Integrator::verlet, Deformation::whole, 1e-5});
  const bool chips = GENERATE(false, true);
  const Body block = kuhn_block({2, 2, 2}, {0.3, 0.3, 0.3});
  const Body chip = single_tetrahedron(0.3);
  const SeveralBodies all =
      together({moved(chips ? chip : block, {-0.25, 0, 0}), moved(block, {0.25, 0.1, 0.05}),
                moved(chips ? chip : block, {-0.1, 0.45, 0})});
  ContactScene scene = scene_of(all, 1e8, way.time_step);
  scene.integrator.integrator = way.integrator;
  place(scene.state, ComponentId{0}, {.velocity = {3, 0, 0}, .spin = {1, 2, 3}});
  place(scene.state, ComponentId{1}, {.velocity = {0, 0, 0}, .spin = {0, 0, -4}});
  const Vec3 p0 = momentum(scene.state.vertices), l0 = angular_momentum(scene.state.vertices);
  const double hit0 = scene.state.components[1].momentum.norm();
  double passed = 0;
  const int steps = static_cast<int>(0.15 / way.time_step);
  for (int k = 0; k < steps; ++k) {
    const ContactStepResult result =
        scene.step({.deformation = way.deformation, .contacts_for = way.time_step});
    REQUIRE(result.status.outcome == StepOutcome::fine);
    for (const ContactPoint& c : result.contacts) passed += c.impulse.norm();
  }
  INFO("h " << way.time_step << " integrator " << static_cast<int>(way.integrator)
            << " deformation " << static_cast<int>(way.deformation) << " chips " << chips
            << " passed " << passed);
  REQUIRE(scene.state.components[1].momentum.norm() > hit0 + (chips ? 0.1 : 10));
  CHECK((momentum(scene.state.vertices) - p0).norm() < 1e-9 * passed);
  CHECK((angular_momentum(scene.state.vertices) - l0).norm() < 1e-9 * passed * 0.3);
}

TEST_CASE("a heap of chips stays finite, settles, and costs bounded work", "[mechanics][contact]") {
  const unsigned seed = 4;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const int count = 80;
  std::vector<Body> chips;
  for (int k = 0; k < count; ++k) {
    // On a grid that leaves room between them.
    const Vec3 place(k % 4 * 0.07, k / 4 % 4 * 0.07, 0.05 + k / 16 * 0.07);
    chips.push_back(moved(single_tetrahedron(0.05), place + 0.005 * random_vector(random)));
  }
  const SeveralBodies all = together(chips);
  ContactScene scene = scene_of(all, 1e9, 2e-3);
  scene.loads.gravity = {0, 0, -9.81};
  scene.obstacles = {Obstacle{Plane{}}};
  const double e0 = scene.energy();
  double highest = 0;
  int most_iterations = 0;
  double deepest = 0;
  for (int k = 0; k < 400; ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    most_iterations = std::max(most_iterations, result.report.iterations);
    deepest = std::max(deepest, result.report.deepest);
    highest = std::max(highest, scene.energy());
  }
  // Time is bounded by sweeps, not by a clock. Chips of 5 cm: a tenth of that is deep.
  CHECK(most_iterations <= scene.contact.max_passes * scene.contact.max_iterations);
  CHECK(deepest < 0.005);
  CHECK(highest <= e0 * (1 + 1e-9));
  double mass = 0;
  for (const Component& c : scene.state.components) mass += c.mass;
  CHECK(kinetic_energy(scene.state.vertices) < 0.5 * mass * 0.3 * 0.3);
  for (const Component& c : scene.state.components) CHECK(c.centre.z() > 0);
}

TEST_CASE("the same scene gives the same bytes", "[mechanics][contact]") {
  std::vector<Vec3> first;
  for (int run = 0; run < 2; ++run) {
    ContactScene scene = interlocked_bars();
    for (int k = 0; k < 50; ++k) scene.step();
    if (run == 0) first = scene.state.vertices.position;
    CHECK(first == scene.state.vertices.position);
  }
}

TEST_CASE("a wedge gains no energy however long it is swept, and says where it was not solved",
          "[mechanics][contact]") {
  const int sweeps = GENERATE(40, 200, 1000, 2000, 10000);
  INFO("sweeps " << sweeps);
  ContactScene scene = interlocked_bars();
  scene.contact.max_iterations = sweeps;
  const double e0 = scene.energy();
  int not_solved = 0;
  for (int k = 0; k < (sweeps > 2000 ? 20 : 100); ++k) {
    const ContactStepResult result = scene.step();
    not_solved += result.report.converged ? 0 : 1;
    CHECK(scene.energy() <= e0 * (1 + 1e-9));
  }
  if (sweeps == 40) CHECK(not_solved > 0);
}

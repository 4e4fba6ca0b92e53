// SPDX-License-Identifier: MIT
// Bodies against planes, boxes and balls: rest, impact, friction, momentum and energy.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mechanics/contact/settings/contact_fields.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr double g = 9.81;

ContactScene block_over_plane(double young_modulus, double time_step, int cells = 3) {
  const Body body = kuhn_block({cells, cells, cells}, {1, 1, 1});
  ContactScene scene{body, state_of(body, material_of(young_modulus))};
  scene.obstacles = {Obstacle{Plane{}}};
  scene.loads.gravity = {0, 0, -g};
  scene.integrator.time_step = time_step;
  return scene;
}

double lowest(const MechanicsState& state) {
  double low = std::numeric_limits<double>::infinity();
  for (const Vec3& x : state.vertices.position) low = std::min(low, x.z());
  return low;
}

double speed(const MechanicsState& state, const Vec3& direction) {
  return direction.dot(state.components[0].momentum) / state.components[0].mass;
}

}  // namespace

TEST_CASE("a block set on a plane comes to rest on it and weighs what it weighs",
          "[mechanics][contact]") {
  const double time_step = GENERATE(1e-4, 1e-3, 1.0 / 60);
  ContactScene scene = block_over_plane(1e7, time_step);
  scene.integrator.damping.stiffness_factor = 1e-2;  // so that it stops ringing in this test
  place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.5}});
  const double mass = scene.state.components[0].mass;
  const int steps = static_cast<int>(1.0 / time_step);
  double impulse = 0, late_impulse = 0;
  for (int k = 0; k < steps; ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    CHECK(result.report.converged);
    impulse += result.report.impulse_of(0).z();
    if (k >= steps / 2) late_impulse += result.report.impulse_of(0).z();
  }
  INFO("time step " << time_step);
  // The sum of impulses is the weight times the time less the momentum that is left: exactly.
  const double weight = mass * g;
  CHECK(impulse - weight * time_step * steps ==
        Approx(scene.state.components[0].momentum.z()).margin(1e-9 * weight));
  CHECK(late_impulse == Approx(weight * time_step * (steps - steps / 2)).epsilon(1e-5));
  CHECK(kinetic_energy(scene.state.vertices) < 1e-9 * 0.5 * mass);  // 45 micrometres a second
  // Uniform support: the mean vertical stress at height z is rho g (1 - z), 1/2 in the mean.
  double mean_stress = 0;
  for (std::size_t t = 0; t < scene.state.elements.size(); ++t) {
    mean_stress += scene.state.elements.rest_volume[t] * scene.state.elements.stress[t](2, 2);
  }
  // Volume average of stress is - sum f z, whatever the mesh: f is the weight of lumped vertices.
  double moment = 0;
  for (std::size_t v = 0; v < scene.state.vertices.size(); ++v) {
    moment += scene.state.vertices.mass[v] * g * (scene.state.vertices.rest_position[v].z() + 0.5);
  }
  CHECK(mean_stress == Approx(-moment).epsilon(1e-4));
  CHECK(lowest(scene.state) > -scene.contact.allowed_penetration);
  CHECK(lowest(scene.state) < 1e-7);
}

TEST_CASE("a falling cube never gains energy and never rebounds faster than it came",
          "[mechanics][contact]") {
  const double time_step = GENERATE(1e-5, 1e-4, 1e-3, 1.0 / 60);
  const double young_modulus = GENERATE(1e6, 1e8, 1e11);
  const double tilt = GENERATE(0.0, 0.4);
  ContactScene scene = block_over_plane(young_modulus, time_step);
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(tilt, Vec3(1, 0.3, 0).normalized()));
  place(scene.state, ComponentId{0}, {.orientation = turned, .velocity = {0, 0, -1}});
  const double below = lowest(scene.state);
  const double height = 1e-3 - below;
  place(scene.state, ComponentId{0},
        {.orientation = turned, .translation = {0, 0, height}, .velocity = {0, 0, -1}});
  INFO("time step " << time_step << " E " << young_modulus << " tilt " << tilt);

  const double start = scene.energy();
  const double impact = kinetic_energy(scene.state.vertices);
  const int steps = std::min(2500, static_cast<int>(0.6 / time_step));
  double highest = -std::numeric_limits<double>::infinity();
  double fastest = 0, last = start, largest_regain = 0;
  for (int k = 0; k < steps; ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    const double now = scene.energy();
    highest = std::max(highest, now);
    largest_regain = std::max(largest_regain, now - last);
    last = now;
    // Speed upwards at the height of the start: a tilted cube has height to fall.
    const double up = std::max(0.0, speed(scene.state, Vec3::UnitZ()));
    const double fallen = height - scene.state.components[0].centre.z();
    fastest = std::max(fastest, up * up - 2 * g * fallen);
  }
  CHECK(highest <= start + 1e-9 * std::abs(start));
  CHECK(fastest <= 1);
  // The scheme remembers accelerations, so a step may give back a little of the energy taken before
  // from the struck layer (a sixth of the mass, 0.17 of the energy). A fifth of it is the bound.
  CHECK(largest_regain <= 0.034 * impact);
}

TEST_CASE("a ball strikes a block: momentum and angular momentum of both stay",
          "[mechanics][contact]") {
  const Integrator integrator = GENERATE(Integrator::floating_frame, Integrator::implicit_euler);
  const double time_step = GENERATE(1e-4, 1e-2);
  const Body body = kuhn_block({3, 3, 3}, {1, 1, 1});
  ContactScene scene{body, state_of(body, material_of(1e9))};
  scene.integrator.time_step = time_step;
  scene.integrator.integrator = integrator;
  Obstacle ball{Sphere{{0.1, 0.17, 0.9}, 0.3}, {0.5, 0, -6}, {1, 2, 3}};
  ball.mass = 150;
  scene.obstacles = {ball};
  const Vec3 p0 = scene.total_momentum(), l0 = scene.total_angular_momentum();
  const double e0 = scene.energy();
  double given = 0;
  for (int k = 0; k < static_cast<int>(0.1 / time_step); ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    given += result.report.impulse_of(0).norm();
    CHECK((scene.total_momentum() - p0).norm() < 1e-12 * p0.norm());
  }
  CHECK(given > 100);
  CHECK(scene.energy() <= e0);
  if (integrator == Integrator::floating_frame) {
    // Sides of a contact act along one line but for the part of the step before they meet.
    CHECK((scene.total_angular_momentum() - l0).norm() < 1e-9 * l0.norm());
  }
}

TEST_CASE("free balls fall, rest on a plane and do not pass through each other",
          "[mechanics][contact]") {
  const Body body = single_tetrahedron(0.1);
  ContactScene scene{body, state_of(body, material_of(1e9))};
  place(scene.state, ComponentId{0}, {.translation = {50, 0, 50}});
  scene.loads.gravity = {0, 0, -g};
  scene.integrator.time_step = 1e-2;
  Obstacle low{Sphere{{0, 0, 0.5}, 0.2}}, high{Sphere{{0.0, 0, 1.5}, 0.3}};
  low.mass = 10;
  high.mass = 40;
  scene.obstacles = {Obstacle{Plane{}}, low, high};
  for (int k = 0; k < 100; ++k) {
    scene.step();
    const Vec3 a = std::get<Sphere>(scene.obstacles[1].shape).center;
    const Vec3 b = std::get<Sphere>(scene.obstacles[2].shape).center;
    CHECK(a.z() > 0.2 - 1e-6);
    CHECK((b - a).norm() > 0.5 - 1e-6);
  }
  CHECK(std::get<Sphere>(scene.obstacles[1].shape).center.z() == Approx(0.2).margin(1e-6));
  CHECK(std::get<Sphere>(scene.obstacles[2].shape).center.z() == Approx(0.7).margin(1e-6));
  CHECK(scene.obstacles[2].velocity.norm() < 1e-9);
}

TEST_CASE("a sliding block decelerates by mu g and stops", "[mechanics][contact]") {
  const double young_modulus = GENERATE(1e8, 1e11);
  ContactScene scene = block_over_plane(young_modulus, 1e-3);
  scene.contact.friction = 0.3;
  scene.obstacles[0].friction = 0.3;
  place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.5}, .velocity = {1, 0, 0}});
  const double mu = 0.3, duration = 0.2;
  double last = 1;
  for (int k = 0; k < 200; ++k) {
    scene.step();
    CHECK(speed(scene.state, Vec3::UnitX()) < last + 1e-3);
    last = speed(scene.state, Vec3::UnitX());
  }
  // A soft block rings while it slides: 1e8 Pa leaves a ripple of a few parts in a thousand.
  CHECK(last == Approx(1 - mu * g * duration).epsilon(young_modulus > 1e10 ? 1e-4 : 1e-2));
  for (int k = 0; k < 400; ++k) scene.step();
  // The rest of the soft block's motion is its ringing on the spot.
  CHECK(std::abs(speed(scene.state, Vec3::UnitX())) < (young_modulus > 1e10 ? 1e-6 : 2e-3));
}

TEST_CASE("a block does not slide down a plane less steep than its friction",
          "[mechanics][contact]") {
  const double slope = GENERATE(0.2, 0.4);
  const double mu = 0.3;
  ContactScene scene = block_over_plane(1e10, 1e-3);
  scene.contact.friction = mu;
  scene.obstacles[0].friction = mu;
  // Gravity is turned instead of the plane.
  scene.loads.gravity = g * Vec3(std::sin(slope), 0, -std::cos(slope));
  place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.5}});
  for (int k = 0; k < 100; ++k) scene.step();
  const double expected = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)) * 0.1);
  CHECK(speed(scene.state, Vec3::UnitX()) == Approx(expected).margin(1e-4));
}

TEST_CASE(
    "a flat bar on a rigid wall presses it with rho c v and never rebounds faster than it came",
    "[mechanics][contact]") {
  // nu = 0 and no friction: one-dimensional. Contact force rho c v A for a time 2 L / c.
  const double E = 3e10, rho = 2400, v = 1, length = 1, area = 0.01;
  const double c = std::sqrt(E / rho);
  const Body body = kuhn_block({50, 2, 2}, {length, 0.1, 0.1});
  struct Expected {
    double step;         ///< h c / L
    double least_force;  ///< mean force / (rho c v A) in the middle half of the contact
    double rebound;      ///< least rebound / v
    double tension;      ///< most tension / (rho c v) while the wall is touched
  };
  // The values reached, less a margin of 0.02: the second-order scheme (rho_infinity = 0) damps
  // waves shorter than ten steps. The exact bar has 1, 1, 0.
  const Expected expected =
      GENERATE(Expected{0.005, 0.97, 0.94, 0.42}, Expected{0.02, 0.96, 0.89, 0.28},
               Expected{0.1, 0.88, 0.69, 0.23}, Expected{1.0, 0.74, 0.11, 0.02},
               Expected{10.0, 0.0, 0.0, 0.02});
  const double h = expected.step * length / c;
  ContactScene scene{body, state_of(body, material_of(E, rho, 0.0))};
  scene.integrator.time_step = h;
  scene.contact.friction = 0;
  scene.obstacles = {Obstacle{Plane{Vec3::UnitX(), -0.5 * length}, {0, 0, 0}, {0, 0, 0}, 0}};
  place(scene.state, ComponentId{0}, {.velocity = {-v, 0, 0}});
  const double e0 = scene.energy();
  double sum = 0, tension = 0, pressure = 0;
  int counted = 0;
  for (int k = 0; k < static_cast<int>(3 / expected.step) + 3; ++k) {
    const ContactStepResult result = scene.step();
    const double time = (k + 1) * expected.step;
    if (time > 0.5 && time <= 1.5) {
      sum += result.report.impulse_of(0).x() / h;
      ++counted;
    }
    for (const Mat3& stress : scene.state.elements.stress) {
      pressure = std::max(pressure, -stress(0, 0));
      if (result.report.contacts > 0) tension = std::max(tension, stress(0, 0));
    }
    CHECK(scene.energy() <= e0 * (1 + 1e-9));
  }
  const double rebound = speed(scene.state, Vec3::UnitX());
  const double force = counted > 0 ? sum / counted / (rho * c * v * area) : 0;
  INFO("step " << expected.step << " L/c: force " << force << ", pressure "
               << pressure / (rho * c * v) << ", tension " << tension / (rho * c * v)
               << ", rebound " << rebound / v);
  CHECK(force >= expected.least_force);
  CHECK(force <= 1.02);
  CHECK(pressure <= 1.3 * rho * c * v);
  CHECK(tension <= expected.tension * rho * c * v);
  CHECK(rebound >= expected.rebound * v);
  CHECK(rebound <= v);
}

TEST_CASE("of many contacts a set that spans the patch holds a body as all of them do",
          "[mechanics][contact]") {
  const auto resting = [](std::uint32_t most) {
    const Body body = kuhn_block({8, 8, 2}, {0.8, 0.8, 0.2});
    ContactScene scene{body, state_of(body, material_of(3e10))};
    scene.integrator.time_step = 1e-3;
    scene.loads.gravity = {0, 0, -9.81};
    scene.obstacles = {Obstacle{Plane{}}};
    scene.contact.max_contacts_per_pair = most;
    scene.contact.max_passes = 1;
    place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.1}});
    std::uint64_t left_out = 0;
    std::uint32_t candidates = 0;
    for (int k = 0; k < 300; ++k) {
      const ContactReport report = scene.step().report;
      left_out += report.left_out;
      candidates = std::max(candidates, report.candidates);
    }
    CHECK(left_out == 0);
    CHECK(candidates <= most);
    CHECK(scene.state.components[0].orientation.angularDistance(Eigen::Quaterniond::Identity()) <
          1e-6);
    return scene.state.components[0].centre.z();
  };
  const double all = resting(81), some = resting(16);
  CHECK(std::abs(all - 0.1) < 1e-5);
  CHECK(std::abs(some - all) < 1e-5);
}

TEST_CASE("a body held inside an obstacle at the start comes out slowly", "[mechanics][contact]") {
  ContactScene scene = block_over_plane(1e9, 1e-3);
  scene.loads.gravity.setZero();
  place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.45}});
  double fastest = 0;
  for (int k = 0; k < 200; ++k) {
    scene.step();
    fastest = std::max(fastest, speed(scene.state, Vec3::UnitZ()));
  }
  CHECK(fastest > 0.5 * scene.contact.push_out_speed);
  CHECK(fastest < 1.01 * scene.contact.push_out_speed);
}

TEST_CASE("a moving box pushes a block along and a fast one does not pass through it",
          "[mechanics][contact]") {
  const double pusher = GENERATE(0.5, 40.0);
  const Body body = kuhn_block({2, 2, 2}, {1, 1, 1});
  ContactScene scene{body, state_of(body, material_of(1e10))};
  scene.integrator.time_step = 1e-2;
  Obstacle box{Box{{-0.7, 0, 0}, Eigen::Quaterniond::Identity(), {0.05, 2, 2}}, {pusher, 0, 0}};
  scene.obstacles = {box};
  for (int k = 0; k < 100; ++k) scene.step();
  CHECK(speed(scene.state, Vec3::UnitX()) == Approx(pusher).epsilon(0.02));
  double low = 1e300;
  for (const Vec3& x : scene.state.vertices.position) low = std::min(low, x.x());
  CHECK(low > std::get<Box>(scene.obstacles[0].shape).center.x() + 0.05 - 1e-3);
}

TEST_CASE("what is wrong with contact settings is found, all of it", "[mechanics][contact]") {
  CHECK(check_settings(ContactSettings{}, "contact").empty());
  ContactSettings wrong;
  wrong.friction = -1;
  wrong.compliance = std::numeric_limits<double>::quiet_NaN();
  wrong.max_iterations = 0;
  const std::vector<Finding> findings = check_settings(wrong, "contact");
  REQUIRE(findings.size() == 3);
  CHECK(findings[0].text.find("contact.friction is -1; allowed is at least 0") !=
        std::string::npos);
  for (const Finding& f : findings) CHECK_FALSE(f.remedy.empty());
}

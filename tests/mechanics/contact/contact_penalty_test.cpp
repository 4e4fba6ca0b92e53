// SPDX-License-Identifier: MIT
// Contact as the paper has it: its springs against a plain twin, conserved quantities, and
// failures.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <tuple>

#include "mechanics/contact/settings/contact_fields.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr double g = 9.81;

Body moved(Body body, const Vec3& shift) {
  for (Vec3& x : body.rest) x += shift;
  return body;
}

ContactScene scene_of(const SeveralBodies& all, double time_step) {
  ContactScene scene{all.body, state_of(all, material_of(1e8))};
  scene.integrator.time_step = time_step;
  scene.contact.method = ContactMethod::penalty;
  return scene;
}

/// A free ball of 2 kg and 0.1 m at `height` over a plane, and a body that is far away.
ContactScene ball_on_plane(double height, double time_step) {
  const SeveralBodies far = together({moved(single_tetrahedron(0.1), {0, 0, 50})});
  ContactScene scene = scene_of(far, time_step);
  scene.obstacles = {Obstacle{Plane{}}, Obstacle{.shape = Sphere{{0, 0, 0.1 + height}, 0.1}}};
  scene.obstacles[1].mass = 2;
  return scene;
}

double depth_of_ball(const ContactScene& scene) {
  return 0.1 - std::get<Sphere>(scene.obstacles[1].shape).center.z();
}

/// Two blocks that meet off centre, and a chip between them.
ContactScene off_centre(double time_step) {
  const Body block = kuhn_block({2, 2, 2}, {0.3, 0.3, 0.3});
  const SeveralBodies all = together({moved(block, {-0.25, 0, 0}), moved(block, {0.25, 0.1, 0.05}),
                                      moved(single_tetrahedron(0.1), {-0.05, 0.05, 0})});
  ContactScene scene = scene_of(all, time_step);
  place(scene.state, ComponentId{0}, {.velocity = {3, 0, 0}, .spin = {1, 2, 3}});
  place(scene.state, ComponentId{1}, {.spin = {0, 0, -4}});
  scene.contact.penalty_stiffness = 1e5;
  return scene;
}

using Forces = std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>,
                        Vec3>;  // ball, vertex, obstacle, tetrahedron

/// Springs without dampers, each pair looked at, shapes by hand: planes and spheres.
Forces plain_forces(const ContactScene& scene) {
  Forces forces;
  constexpr std::uint32_t none = VertexId::none().value;
  const double k = scene.contact.penalty_stiffness;
  const auto push = [&](const Obstacle& o, const Vec3& x, double radius) -> Vec3 {
    if (const auto* plane = std::get_if<Plane>(&o.shape)) {
      const double depth = plane->offset + radius - plane->normal.dot(x);
      return std::max(0.0, k * depth) * plane->normal;
    }
    const Sphere& sphere = std::get<Sphere>(o.shape);
    const Vec3 out = x - sphere.center;
    return std::max(0.0, k * (sphere.radius + radius - out.norm())) * out.normalized();
  };
  const auto add = [&](std::uint32_t ball, std::uint32_t vertex, std::uint32_t obstacle,
                       std::uint32_t tetrahedron, const Vec3& force) {
    if (!force.isZero(0)) forces[{ball, vertex, obstacle, tetrahedron}] = force;
  };
  const std::vector<Vec3>& x = scene.state.vertices.position;
  for (std::uint32_t o = 0; o < scene.obstacles.size(); ++o) {
    for (std::uint32_t v = 0; v < x.size(); ++v) {
      add(none, v, o, none, push(scene.obstacles[o], x[v], 0));
    }
    if (!scene.obstacles[o].mass) continue;
    const Sphere& ball = std::get<Sphere>(scene.obstacles[o].shape);
    for (std::uint32_t p = 0; p < scene.obstacles.size(); ++p) {
      if (p == o || (scene.obstacles[p].mass && p < o)) continue;
      add(o, none, p, none, push(scene.obstacles[p], ball.center, ball.radius));
    }
  }
  for (std::uint32_t t = 0; t < scene.body.corners.size(); ++t) {
    Vec3 middle = Vec3::Zero(), rest_middle = Vec3::Zero();
    double radius = 0;
    for (VertexId c : scene.body.corners[t]) {
      middle += x[c.index()] / 4;
      rest_middle += scene.state.vertices.rest_position[c.index()] / 4;
    }
    for (VertexId c : scene.body.corners[t]) {
      const Vec3 arm = scene.state.vertices.rest_position[c.index()] - rest_middle;
      radius = std::max(radius, scene.contact.ball_share * arm.norm());
    }
    for (std::uint32_t v = 0; v < x.size(); ++v) {
      if (scene.state.vertices.component[v] == scene.state.elements.component[t]) continue;
      add(none, v, none, t, push(Obstacle{Sphere{middle, radius}}, x[v], 0));
    }
  }
  return forces;
}

}  // namespace

TEST_CASE("the springs of penalty are those of a plain twin", "[mechanics][contact][penalty]") {
  ContactScene scene = off_centre(1e-3);
  scene.contact.ball_share = GENERATE(0.5, 1.0);
  scene.obstacles = {Obstacle{Plane{{0, 0, 1}, -0.1}}, Obstacle{Sphere{{0.5, 0, 0}, 0.2}},
                     Obstacle{Sphere{{0.5, 0.3, 0.1}, 0.2}}};
  scene.obstacles[1].mass = 3;
  scene.obstacles[2].mass = 5;
  std::size_t most = 0, of_pieces = 0;
  for (int step = 0; step < 40; ++step) {
    const Forces expected = plain_forces(scene);
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    REQUIRE(result.contacts.size() == expected.size());
    for (const ContactPoint& c : result.contacts) {
      const Vec3& force = expected.at({c.ball, c.vertex.value, c.obstacle, c.tetrahedron.value});
      CHECK((c.impulse - 1e-3 * force).norm() < 1e-12 * (1 + force.norm()));
      of_pieces += !c.tetrahedron.is_none();
    }
    most = std::max(most, expected.size());
  }
  CHECK(most > 10);
  CHECK(of_pieces > 50);
}

TEST_CASE("penalty keeps momentum and angular momentum, with friction too",
          "[mechanics][contact][penalty]") {
  struct Way {
    Integrator integrator;
    double time_step;
  };
  const Way way = GENERATE(Way{Integrator::floating_frame, 1e-3}, Way{Integrator::verlet, 1e-5},
                           Way{Integrator::modal, 1e-3});
  ContactScene scene = off_centre(way.time_step);
  scene.integrator.integrator = way.integrator;
  scene.contact.penalty_damping = GENERATE(0.0, 100.0);
  scene.obstacles = {Obstacle{.shape = Sphere{{0.3, 0.5, 0}, 0.1}, .velocity = {0, -3, 0}}};
  scene.obstacles[0].mass = 3;
  const Vec3 p0 = scene.total_momentum(), l0 = scene.total_angular_momentum();
  double passed = 0, slid = 0;
  for (int k = 0; k < static_cast<int>(0.15 / way.time_step); ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    for (const ContactPoint& c : result.contacts) {
      passed += c.impulse.norm();
      const double pressed = c.normal.dot(c.impulse);
      const double friction = (c.impulse - pressed * c.normal).norm();
      CHECK(pressed >= 0);
      CHECK(friction <= c.friction * pressed * (1 + 1e-9) + 1e-12);
      slid += friction;
    }
  }
  CHECK(passed > 10);
  CHECK((slid > 0.1) == (scene.contact.penalty_damping > 0));
  CHECK((scene.total_momentum() - p0).norm() < 1e-12 * p0.norm());
  CHECK((scene.total_angular_momentum() - l0).norm() < 1e-11 * l0.norm());
}

TEST_CASE("on springs a ball rests at m g / k, and a block with n vertices below at m g / (n k)",
          "[mechanics][contact][penalty]") {
  ContactScene ball = ball_on_plane(0, 1e-3);
  ball.loads.gravity = {0, 0, -g};
  ball.contact.penalty_damping = 500;
  for (int k = 0; k < 500; ++k) ball.step();
  CHECK(depth_of_ball(ball) == Approx(2 * g / 1e5).epsilon(1e-9));

  ContactScene block = scene_of(together({kuhn_block({2, 2, 2}, {0.2, 0.2, 0.2})}), 1e-3);
  block.obstacles = {Obstacle{Plane{{0, 0, 1}, -0.1}}};
  block.loads.gravity = {0, 0, -g};
  block.contact.penalty_damping = 200;
  block.integrator.damping.stiffness_factor = 1e-3;
  for (int k = 0; k < 2000; ++k) block.step();
  double sum = 0;
  int below = 0;
  for (const Vec3& x : block.state.vertices.position) {
    if (x.z() > -0.1) continue;
    sum += -0.1 - x.z();
    ++below;
  }
  CHECK(below == 9);
  CHECK(sum / below == Approx(block.state.components[0].mass * g / (below * 1e5)).epsilon(1e-6));
}

TEST_CASE("a spring held down is stable up to 2 sqrt(m / k) and no further",
          "[mechanics][contact][penalty]") {
  // Pressed by much weight, so that the ball never leaves: the linear oscillator.
  const double bound = 2 * std::sqrt(2 / 1e5);
  for (const double part : {0.99, 1.01}) {
    ContactScene scene = ball_on_plane(-2e-3, part * bound);
    scene.loads.gravity = {0, 0, -100};  // rests at 2 mm
    scene.obstacles[1].velocity = {0, 0, 1e-9};
    double largest = 0;
    for (int k = 0; k < 60; ++k) {
      scene.step();
      largest = std::max(largest, std::abs(depth_of_ball(scene) - 2e-3));
    }
    INFO("step over bound " << part);
    CHECK((largest < 1e-10) == (part < 1));
  }
}

TEST_CASE("penalty lets a fast vertex pass a thin wall, impulses do not",
          "[mechanics][contact][penalty]") {
  for (const ContactMethod method : {ContactMethod::penalty, ContactMethod::impulses}) {
    ContactScene scene = scene_of(together({kuhn_block({2, 2, 2}, {0.2, 0.2, 0.2})}), 1e-2);
    scene.contact.method = method;
    Box wall;
    wall.center = {0.25, 0, 0};
    wall.half_extent = {0.01, 1, 1};
    scene.obstacles = {Obstacle{wall}};
    // From one side of the wall to the other in two steps, no vertex inside as one begins.
    place(scene.state, ComponentId{0}, {.velocity = {27, 0, 0}});
    for (int k = 0; k < 10; ++k) scene.step();
    CHECK((scene.state.components[0].centre.x() > 1) == (method == ContactMethod::penalty));
  }
}

TEST_CASE("pieces that come apart at rest are thrown apart by the paper's balls",
          "[mechanics][contact][penalty]") {
  // Two blocks face to face, as a crack leaves them.
  const Body block = kuhn_block({2, 2, 2}, {0.2, 0.2, 0.2});
  const SeveralBodies all = together({moved(block, {-0.1, 0, 0}), moved(block, {0.1, 0, 0})});
  for (const ContactMethod method : {ContactMethod::penalty, ContactMethod::impulses}) {
    ContactScene scene = scene_of(all, 1e-3);
    scene.contact.method = method;
    scene.contact.ball_share = 1;
    for (int k = 0; k < 50; ++k) scene.step();
    const double speed = scene.state.components[1].momentum.x() / scene.state.components[1].mass;
    CHECK((speed > 0.1) == (method == ContactMethod::penalty));
    CHECK(scene.total_momentum().norm() < 1e-12 * scene.state.components[1].mass);
  }
}

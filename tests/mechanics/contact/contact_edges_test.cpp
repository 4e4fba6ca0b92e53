// SPDX-License-Identifier: MIT
// Edges that meet edges, of pieces and of boxes.
#include "mechanics/contact/detection/contact_edges.hpp"

#include <catch2/catch.hpp>

#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A bar along x, 1 m long, that stands on one of its edges. With two cells a vertex is in its
/// middle.
Body bar_on_edge(double turn, const Vec3& place, int cells = 1) {
  Body bar = kuhn_block({cells, 1, 1}, {1, 0.1, 0.1});
  const Eigen::Quaterniond about_own(Eigen::AngleAxisd(pi / 4, Vec3::UnitX()));
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
  for (Vec3& x : bar.rest) x = about_z * (about_own * x) + place;
  return bar;
}

}  // namespace

TEST_CASE("crossed bars meet edge to edge and do not sink into each other",
          "[mechanics][contact]") {
  const double degrees = GENERATE(90.0, 60.0, 30.0, 10.0);
  const double step = GENERATE(1e-4, 1e-3, 1.0 / 60);
  const int cells = GENERATE(1, 2, 3);
  INFO(degrees << " degrees, step " << step << ", " << cells << " cells");
  const double half = 0.1 / std::sqrt(2.0);
  const SeveralBodies all =
      together({bar_on_edge(0, Vec3::Zero(), cells),
                bar_on_edge(degrees * pi / 180, Vec3(0, 0, 2 * half + 0.002), cells)});
  ContactScene scene{all.body, state_of(all, material_of(1e10))};
  scene.integrator.time_step = step;
  for (std::size_t k = 0; k < 2; ++k) {
    scene.state.components[k].rigid = true;
    place(scene.state, ComponentId{k}, {.velocity = Vec3(0, 0, k == 1 ? -1 : 0)});
  }
  const Vec3 momentum = scene.total_momentum(), angular = scene.total_angular_momentum();
  bool have_met = false;
  for (int k = 0; k < 2 + static_cast<int>(0.004 / step); ++k) {
    for (const ContactPoint& c : scene.step_in_parts().contacts) {
      if (c.impulse.isZero(0)) continue;
      have_met = true;
      CHECK(std::abs(c.normal.z()) > 0.999);
    }
  }
  CHECK(have_met);
  const double gap = scene.state.components[1].centre.z() - scene.state.components[0].centre.z();
  CHECK(gap > 2 * half - 1e-5);
  CHECK((scene.total_momentum() - momentum).norm() < 1e-12 * momentum.norm());
  CHECK((scene.total_angular_momentum() - angular).norm() < 1e-10);
}

TEST_CASE("a bar comes to rest across the edge of a box", "[mechanics][contact]") {
  const Body bar = bar_on_edge(0.3, Vec3(0, 0, 0.1 / std::sqrt(2.0) + 0.002));
  ContactScene scene{bar, state_of(together({bar}), material_of(1e10))};
  scene.state.components[0].rigid = true;
  scene.loads.gravity = {0, 0, -9.81};
  scene.integrator.time_step = 1e-3;
  // A box that stands on an edge below, along y, and no wider than the bar is long.
  Box box{{0, 0, -std::sqrt(0.5)},
          Eigen::Quaterniond(Eigen::AngleAxisd(pi / 4, Vec3::UnitY())),
          {0.5, 2, 0.5}};
  scene.obstacles = {{box}};
  for (int k = 0; k < 40; ++k) scene.step();
  CHECK(scene.state.components[0].centre.z() > 0.1 / std::sqrt(2.0) - 2e-5);
}

TEST_CASE("flat seams between faces are no edges", "[mechanics][contact]") {
  // Two blocks face to face: vertices bear them, and no diagonal of a face meets another.
  Body top = kuhn_block({2, 2, 2}, {1, 1, 1});
  for (Vec3& x : top.rest) x += Vec3(0.13, 0.07, 1 + 1e-4);
  const SeveralBodies all = together({kuhn_block({2, 2, 2}, {1, 1, 1}), top});
  ContactScene scene{all.body, state_of(all, material_of(1e10))};
  for (std::size_t k = 0; k < 2; ++k) {
    scene.state.components[k].rigid = true;
    place(scene.state, ComponentId{k}, {.velocity = Vec3(0, 0, k == 1 ? -1 : 0)});
  }
  scene.integrator.time_step = 1e-3;
  const ContactStepResult result = scene.step();
  CHECK(result.report.contacts > 0);
  for (const ContactPoint& c : result.contacts) {
    CHECK(std::abs(c.normal.z()) > 0.999);
    // Along the borders alone.
    if (c.tetrahedron_a.is_none()) continue;
    const Vec3 place = nodes_of_a(c, scene.body.corners).sum(scene.state.vertices.position);
    CHECK((place - scene.state.components[1].centre).cwiseAbs().head<2>().maxCoeff() > 0.499);
  }
}

namespace {

/// A scene of obstacles alone: its one body is far away.
ContactScene scene_of(std::vector<Obstacle> obstacles) {
  const Body bar = bar_on_edge(0, Vec3(0, 0, 100));
  ContactScene scene{bar, state_of(together({bar}), material_of(1e10))};
  scene.state.components[0].rigid = true;
  scene.obstacles = std::move(obstacles);
  return scene;
}

/// Steps to one time at least, s.
void run_to(ContactScene& scene, double time) {
  for (double t = 0; t < time; t += scene.integrator.time_step) scene.step_in_parts();
}

}  // namespace

TEST_CASE("a free box that is turned by half a right angle rests on one of its size",
          "[mechanics][contact]") {
  // No corner of either lies in a face of the other.
  const double step = GENERATE(1e-3, 1.0 / 60);
  INFO("step " << step);
  const auto turned = [](double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  };
  ContactScene scene =
      scene_of({{Box{{0, 0, 0}, turned(0.1), {0.5, 0.5, 0.5}}},
                {.shape = Box{{0, 0, 1}, turned(0.1 + pi / 4), {0.5, 0.5, 0.5}}, .mass = 2}});
  scene.loads.gravity = {0, 0, -9.81};
  scene.integrator.time_step = step;
  run_to(scene, 0.5);
  const Obstacle& upper = scene.obstacles[1];
  CHECK(std::abs(pose_of(upper.shape).centre.z() - 1) < 1e-5);
  CHECK(upper.velocity.norm() < 1e-6);
  CHECK(upper.spin.norm() < 1e-6);
}

TEST_CASE("free bars meet edge to edge, whatever the speed", "[mechanics][contact]") {
  const double speed = GENERATE(0.5, 5.0, 50.0, 500.0);
  const double degrees = GENERATE(90.0, 35.0);
  INFO(speed << " m/s, " << degrees << " degrees");
  const auto on_edge = [&](double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()) *
                              Eigen::AngleAxisd(pi / 4, Vec3::UnitX()));
  };
  const Vec3 half(0.5, 0.05, 0.05);
  const double apart = 2 * std::sqrt(0.5) * 0.1;
  ContactScene scene =
      scene_of({{.shape = Box{{0, 0, 0}, on_edge(0), half}, .mass = 1},
                {.shape = Box{{0, 0, apart + 0.01}, on_edge(degrees * pi / 180), half},
                 .velocity = Vec3(0, 0, -speed),
                 .mass = 1}});
  scene.integrator.time_step = 1e-3;
  run_to(scene, 0.05);
  const auto height = [&](std::size_t row) {
    return pose_of(scene.obstacles[row].shape).centre.z();
  };
  CHECK(height(1) - height(0) > apart - 1e-5);
  const Vec3 sum = scene.obstacles[0].velocity + scene.obstacles[1].velocity;
  CHECK((sum - Vec3(0, 0, -speed)).norm() < 1e-9 * speed);
  CHECK(scene.obstacles[0].velocity.z() < -0.4 * speed);
}

// SPDX-License-Identifier: MIT
// Load curves of slow tests: forces on the obstacles that press, over how far they have come.
#include <catch2/catch.hpp>

#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A body of concrete that does not break, without friction and weight.
Scene pressed(TetMesh mesh, int order) {
  Scene scene;
  BodySettings body;
  body.mesh = std::move(mesh);
  body.order = order;
  scene.bodies = {body};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::off;
  scene.contact.friction = 0;
  scene.integrator.time_step = 1e-3;
  return scene;
}

/// N along z on an obstacle, the mean over the last of so many steps.
double force_after(Scene scene, std::size_t obstacle, int steps) {
  for (Obstacle& o : scene.obstacles) o.friction = 0;
  Simulation sim = built(std::move(scene));
  sim.reports_forces = true;
  const double step = sim.scene.integrator.time_step;
  StepReport report;
  for (int k = 0; k < steps; ++k) report = advance(sim);
  return report.forces.obstacle[obstacle][2] / step;
}

/// A box that stands on an edge along y; the edge at a place points down or up.
Obstacle edge_at_place(double x, double z, bool down) {
  const double half = 0.02;
  const double middle = z + (down ? 1 : -1) * half * std::sqrt(2.0);
  return {Box{{x, 0, middle},
              Eigen::Quaterniond(Eigen::AngleAxisd(std::acos(std::sqrt(0.5)), Vec3::UnitY())),
              {half, 0.1, half}}};
}

}  // namespace

TEST_CASE("a block pressed between two planes bears E A times its strain", "[accuracy][contact]") {
  const double size = 0.1, speed = 0.01;
  Scene scene = pressed(suite::kuhn_box({2, 2, 4}, 0.05), 1);
  scene.obstacles = {{.shape = Plane{}}, {.shape = Plane{-Vec3::UnitZ(), -0.2}}};
  scene.obstacles[1].velocity = {0, 0, -speed};
  const int steps = 20;
  const double force = force_after(scene, 1, steps);
  const double strain = speed * 1e-3 * steps / 0.2;
  CHECK(force == Approx(Material{}.young_modulus * size * size * strain).epsilon(1e-4));
}

TEST_CASE("a beam between edges of boxes is as stiff as Timoshenko's, wherever its vertices are",
          "[accuracy][contact]") {
  const double off = GENERATE(0.0, 3e-4, 0.004);
  INFO("edges " << off << " m from vertices");
  const double h = 0.04, span = 0.4 - 2 * off, speed = 0.002;
  TetMesh mesh = suite::kuhn_box({24, 2, 2}, 0.02);
  for (Point& p : mesh.points) p = {p[0] - 0.24, p[1] - 0.02, p[2]};
  Scene scene = pressed(mesh, 2);
  scene.obstacles = {edge_at_place(-0.2 + off, 0, false), edge_at_place(0.2 - off, 0, false),
                     edge_at_place(0, h, true)};
  scene.obstacles[2].velocity = {0, 0, -speed};
  const int steps = 40;
  const double force = force_after(scene, 2, steps);
  const double E = Material{}.young_modulus, G = 0.5 * E / (1 + Material{}.poisson_ratio);
  const double I = h * h * h * h / 12;
  const double give = span * span * span / (48 * E * I) + span / (4 * 5.0 / 6 * G * h * h);
  CHECK(force * give / (speed * 1e-3 * steps) == Approx(1).epsilon(0.03));
}

// SPDX-License-Identifier: MIT
// Halves of a cut body in whole steps: Coulomb's law on the cut, and pieces that meet again.
#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/state/living.hpp"
#include "tests/mechanics/contact/cut_block.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A plate of 0.3 m x 0.3 m x 0.05 m on a held block, both once one body, tilted about y.
struct Tilted {
  ContactScene scene;
  Vec3 down_the_slope, out;

  Tilted(double angle, double time_step)
      : scene{kuhn_block({3, 3, 2}, {0.3, 0.3, 0.1}),
              state_of(kuhn_block({3, 3, 2}, {0.3, 0.3, 0.1}), material_of(1e9))} {
    const std::vector<bool> upper = above(scene.body);
    // An inradius of its tetrahedra is 12 mm; the sliding distance in the test is less.
    scene.memory.partners = partners_between(scene.body.corners, upper, 0.006);
    scene.state.motions.push_back({});
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle * degree, Vec3::UnitY()));
    place(scene.state, ComponentId{0}, {.orientation = turn, .translation = {1, 2, 3}});
    for (std::size_t v = 0; v < scene.state.vertices.size(); ++v) {
      if (scene.state.vertices.rest_position[v].z() < -0.01) {
        scene.state.vertices.support[v] = MotionId{0};
      }
    }
    part(scene.state, scene.body, upper, true, scene.mechanics);
    scene.integrator.time_step = time_step;
    scene.loads.gravity = {0, 0, -9.81};
    scene.contact.friction = 0.5;
    down_the_slope = turn * Vec3::UnitX();
    out = turn * Vec3::UnitZ();
  }
};

}  // namespace

TEST_CASE("a plate on a tilted cut sticks below Coulomb's angle and slides above it",
          "[mechanics][contact][partners]") {
  const double time_step = GENERATE(1e-3, 1e-2);
  const double angle = GENERATE(0.0, 15.0, 25.0, 28.0, 40.0);
  INFO("h " << time_step << " angle " << angle);
  Tilted tilted(angle, time_step);
  ContactScene& scene = tilted.scene;
  REQUIRE(living_components(scene.state).size() == 2);
  const Vec3 start = scene.state.components[1].centre;
  const int steps = static_cast<int>(std::lround(0.06 / time_step));
  for (int k = 0; k < steps; ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    if (angle < 20) CHECK(result.report.converged);
  }
  CHECK(scene.memory.partners.size() == 18);
  const Vec3 way = scene.state.components[1].centre - start;
  const double t = 0.06;
  const double slide =
      std::max(0.0, 9.81 * (std::sin(angle * degree) - 0.5 * std::cos(angle * degree)));
  // A step that presses takes its weight as a blow at its start.
  CHECK(std::abs(way.dot(tilted.down_the_slope) - 0.5 * slide * t * (t + time_step)) < 4e-6);
  CHECK(std::abs(way.dot(tilted.out)) < 2e-6);
}

TEST_CASE("halves thrown apart meet again as any two pieces", "[mechanics][contact][partners]") {
  Body body = kuhn_block({4, 3, 4}, {0.4, 0.3, 0.4});
  const std::vector<bool> upper = above(body);
  ContactScene scene{body, state_of(body, material_of(1e9))};
  scene.integrator.time_step = 1e-3;
  scene.memory.partners = partners_between(body.corners, upper, 0.01);
  CHECK(scene.memory.partners.size() == 24);
  part(scene.state, scene.body, upper, true, scene.mechanics);
  const auto throw_them = [&](double speed) {
    for (const std::size_t c : {0u, 1u}) {
      for (const VertexId v : scene.state.components[c].vertices) {
        scene.state.vertices.velocity[v.index()] = (c == 0 ? -speed : speed) * Vec3::UnitZ();
      }
      reframe(scene.state, ComponentId{c});
    }
  };
  const auto distance = [&] {
    return scene.state.components[1].centre.z() - scene.state.components[0].centre.z();
  };
  scene.step();
  throw_them(1);
  int contacts = 0;
  for (int k = 0; k < 20; ++k) contacts += static_cast<int>(scene.step().report.contacts);
  CHECK(contacts == 0);
  CHECK(distance() == Approx(0.24).epsilon(1e-9));
  CHECK(scene.memory.partners.empty());
  throw_them(-1);
  const double energy = scene.energy();
  for (int k = 0; k < 100; ++k) {
    const ContactStepResult result = scene.step();
    REQUIRE(result.status.outcome == StepOutcome::fine);
    for (const ContactPoint& c : result.contacts) CHECK(c.face.is_none());
    contacts += static_cast<int>(result.report.contacts);
    CHECK(scene.energy() <= energy * (1 + 1e-9));
    CHECK(scene.total_momentum().norm() < 1e-10);
  }
  CHECK(contacts > 0);
  CHECK(scene.memory.partners.empty());
  // Vertices reach the balls of tetrahedra, half as large as those round them: a few cm deep.
  CHECK(distance() > 0.2 - 0.06);
}

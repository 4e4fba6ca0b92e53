// SPDX-License-Identifier: MIT
// Bodies that meet where supports hold them: no impulse parts them, and none is looked for.
#include <catch2/catch.hpp>

#include "mechanics/rebuild.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

void rebuild_both(ContactScene& scene) {
  const std::array<ComponentId, 2> both = {ComponentId{0}, ComponentId{1}};
  rebuild(scene.state, scene.body.corners, both, scene.mechanics);
}

/// Two tetrahedra that are held by three corners each, on faces that overlap by `depth` (m).
ContactScene held_pair(double depth, std::mt19937& random) {
  const double size = 0.014;
  Body lower = single_tetrahedron(size), upper = lower;
  const Eigen::Quaterniond turn = random_rotation(random);
  std::uniform_real_distribution<double> share(0.05, 0.3);
  const Vec3 shift(share(random) * size, share(random) * size, -depth);
  for (Vec3& x : upper.rest) x = turn * (x + shift);
  for (Vec3& x : lower.rest) x = turn * Vec3(x.x(), x.y(), -x.z());
  std::swap(lower.corners[0][1], lower.corners[0][2]);
  const SeveralBodies both = together({lower, upper});
  ContactScene scene{both.body, state_of(both, material_of(7e10, 2500))};
  scene.state.motions.push_back({});
  for (const std::size_t v : {0u, 1u, 2u, 4u, 5u, 6u})
    scene.state.vertices.support[v] = MotionId{0};
  rebuild_both(scene);
  scene.integrator.time_step = 5e-5;
  return scene;
}

}  // namespace

TEST_CASE("bodies that overlap where both are held stay as they are", "[mechanics][contact]") {
  std::mt19937 random(5);
  for (int k = 0; k < 200; ++k) {
    ContactScene scene = held_pair(1e-4, random);
    const std::vector<Vec3> start = scene.state.vertices.position;
    const ContactStepResult result = scene.step();
    INFO("pair " << k);
    CHECK(result.report.converged);
    CHECK(result.report.residual <= result.report.tolerated);
    for (std::size_t v = 0; v < start.size(); ++v) {
      CHECK((scene.state.vertices.position[v] - start[v]).norm() < 1e-9);
    }
  }
}

TEST_CASE("a held body still stops one that is loose", "[mechanics][contact]") {
  std::mt19937 random(6);
  ContactScene scene = held_pair(-1e-4, random);
  for (const std::size_t v : {4u, 5u, 6u}) scene.state.vertices.support[v] = MotionId::none();
  rebuild_both(scene);
  REQUIRE_FALSE(scene.state.components[1].supported);
  const Component& loose = scene.state.components[1];
  const Vec3 towards = (scene.state.components[0].centre - loose.centre).normalized();
  place(scene.state, loose.id,
        {.orientation = Eigen::Quaterniond::Identity(), .velocity = 10 * towards});
  double deepest = 0;
  for (int k = 0; k < 10; ++k) {
    deepest = std::max(deepest, scene.step_in_parts().report.deepest);
  }
  CHECK(deepest < 1e-5);
  CHECK(scene.state.components[1].momentum.dot(towards) < 0.1 * 10 * loose.mass);
}

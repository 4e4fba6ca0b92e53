// SPDX-License-Identifier: MIT
// Depths of contacts against slow twins: all axes of two solids, shares of corners, distances.
#include "mechanics/contact/detection/contact_depth.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/manifold.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Two chips at the end of a step, and obstacles.
struct Ends {
  SeveralBodies all;
  MechanicsState state;
  std::vector<PredictedFrame> frames;
  std::vector<Obstacle> obstacles;
  std::vector<Pose> ball_end;

  StepPaths paths() const {
    return {state, all.body.corners, state.vertices.position, frames, obstacles, ball_end, 1e-3};
  }
};

Ends ends_of(std::mt19937& random) {
  std::vector<Body> chips;
  for (int k = 0; k < 2; ++k) {
    Body chip = single_tetrahedron(1);
    const Eigen::Quaterniond turn = random_rotation(random);
    const Vec3 place = 0.3 * random_vector(random);
    for (Vec3& x : chip.rest) x = turn * (x + 0.2 * random_vector(random)) + place;
    chips.push_back(chip);
  }
  Ends ends{together(chips), {}, {}, {}, {}};
  ends.state = state_of(ends.all, material_of(1e9));
  ends.frames.resize(2);
  for (std::size_t k = 0; k < 2; ++k) {
    ends.frames[k].centre = ends.state.components[k].centre;
    ends.frames[k].orientation = ends.state.components[k].orientation;
  }
  return ends;
}

/// The same contact with a depth in its tangent plane, m.
ContactPoint this_deep(ContactPoint contact, const StepPaths& paths, double depth) {
  contact.offset = -depth - contact.normal.dot(path_of(contact, paths).end);
  return contact;
}

}  // namespace

TEST_CASE("the depth of two tetrahedra is that of all their axes", "[mechanics][contact]") {
  std::mt19937 random(3);
  int deep = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Ends ends = ends_of(random);
    const StepPaths paths = ends.paths();
    ContactPoint contact{.tetrahedron_a = TetId{0}, .tetrahedron = TetId{1}};
    contact.weights_a = {0.25, 0.25, 0.25, 0.25};
    const double twin = std::max(
        0.0, -separation_by_all_axes(make_tetrahedron(places_at_end(paths, TetId{0}), 15),
                                     make_tetrahedron(places_at_end(paths, TetId{1}), 15)));
    CHECK(depth_at_end(this_deep(contact, paths, 10), paths) == Approx(twin).margin(1e-12));
    CHECK(depth_at_end(this_deep(contact, paths, 0.01), paths) ==
          Approx(std::min(0.01, twin)).margin(1e-12));
    CHECK(depth_at_end(this_deep(contact, paths, -0.01), paths) == 0);
    deep += twin > 0;
  }
  CHECK(deep > 50);
  CHECK(deep < 450);
}

TEST_CASE("a vertex has its depth in a tetrahedron only while it lies within",
          "[mechanics][contact]") {
  std::mt19937 random(4);
  int within = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Ends ends = ends_of(random);
    const StepPaths paths = ends.paths();
    const ContactPoint contact{.vertex = ends.all.body.corners[0][0], .tetrahedron = TetId{1}};
    const Vec3& x = ends.state.vertices.position[contact.vertex.index()];
    const bool is_within = std::ranges::min(barycentric(places_at_end(paths, TetId{1}), x)) > 0;
    CHECK(depth_at_end(this_deep(contact, paths, 0.2), paths) == Approx(is_within ? 0.2 : 0));
    within += is_within;
  }
  CHECK(within > 5);
}

TEST_CASE("depths of vertices and spheres in obstacles are distances of surfaces",
          "[mechanics][contact]") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    Ends ends = ends_of(random);
    const Vec3 at = 0.5 * random_vector(random), from = 0.5 * random_vector(random);
    ends.obstacles = {{.shape = Sphere{at, 0.7}}, {.shape = Sphere{from, 0.2}, .mass = 1}};
    ends.ball_end = {{}, {from, Eigen::Quaterniond::Identity()}};
    const StepPaths paths = ends.paths();
    const ContactPoint vertex{.vertex = VertexId{0}, .obstacle = 0};
    const Vec3& x = ends.state.vertices.position[0];
    CHECK(depth_at_end(this_deep(vertex, paths, 10), paths) ==
          Approx(std::max(0.0, 0.7 - (x - at).norm())).margin(1e-12));
    const ContactPoint ball{.ball = 1, .obstacle = 0};
    CHECK(depth_at_end(this_deep(ball, paths, 10), paths) ==
          Approx(std::max(0.0, 0.9 - (from - at).norm())).margin(1e-12));
  }
}

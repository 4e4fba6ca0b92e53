// SPDX-License-Identifier: MIT
// The judge of contact on places and motions with known answers.
#include "tests/experiments/contact/contact_judge.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "mechanics/contact/shapes/solid_surface.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Corner of a cube of side 1 at `place`, and the three neighbours of that corner.
TetCorners tetrahedron(const Vec3& place, double side = 1) {
  return {place, Vec3(place + side * Vec3::UnitX()), Vec3(place + side * Vec3::UnitY()),
          Vec3(place + side * Vec3::UnitZ())};
}

void add(ContactFrame& frame, const TetCorners& t, std::uint32_t piece) {
  const auto first = static_cast<std::uint32_t>(frame.points.size());
  frame.points.insert(frame.points.end(), t.begin(), t.end());
  frame.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
  frame.piece.push_back(piece);
}

/// Six tetrahedra of a box [low, high].
void add_box(ContactFrame& frame, const Vec3& low, const Vec3& high, std::uint32_t piece) {
  const auto at = [&](int k) {
    return Vec3(k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
  };
  for (const auto& [a, b] : {std::pair{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}) {
    add(frame, {at(0), at(a), at(b), at(7)}, piece);
  }
}

ContactFrame two_boxes(const Vec3& low, const Vec3& size) {
  ContactFrame frame;
  add_box(frame, {0, 0, 0}, {1, 1, 1}, 0);
  add_box(frame, low, low + size, 1);
  return frame;
}

}  // namespace

TEST_CASE("the judge knows how deep tetrahedra lie in each other", "[contact][judge]") {
  const TetCorners a = tetrahedron({0, 0, 0});
  // Corner on, through the slanted face, at a distance of 1 / sqrt 3 from the origin.
  CHECK(overlap(a, tetrahedron({0.3, 0.3, 0.3})) ==
        Approx((1 - 0.9) / std::sqrt(3.0)).epsilon(1e-12));
  CHECK(overlap(a, tetrahedron({0.4, 0.4, 0.4})) < 0);
  // Edges alone: each one's edge lies over the other's face.
  const TetCorners low = {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.1, -1), Vec3(0, -0.1, -1)};
  TetCorners high = {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0.1, 0, 1), Vec3(-0.1, 0, 1)};
  for (Vec3& p : high) p[2] -= 0.01;
  CHECK(overlap(low, high) == Approx(0.01).epsilon(1e-9));
  for (Vec3& p : high) p[2] += 0.02;
  CHECK(overlap(low, high) == Approx(-0.01).epsilon(1e-9));
}

TEST_CASE("the judge knows how deep obstacles lie in a tetrahedron, and it in them",
          "[contact][judge]") {
  const TetCorners t = tetrahedron({0, 0, 0});
  CHECK(overlap(t, Shape(Plane{{0, 0, 1}, 0.2})) == Approx(0.2));
  CHECK(overlap(t, Shape(Plane{{0, 0, 1}, -0.2})) == Approx(-0.2));
  // Outside over the floor face, and a small one wholly inside.
  CHECK(overlap(t, Shape(Sphere{{0.2, 0.2, -0.1}, 0.15})) == Approx(0.05));
  CHECK(overlap(t, Shape(Sphere{{0.1, 0.15, 0.2}, 0.01})) == Approx(0.11));
  CHECK(overlap(t, Shape(Sphere{{0.2, 0.2, -0.1}, 0.05})) == Approx(-0.05));
  Box box{{0.2, 0.2, -0.1}, Eigen::Quaterniond::Identity(), {0.05, 0.05, 0.13}};
  CHECK(overlap(t, Shape(box)) == Approx(0.03));
  box.half_extent[2] = 0.09;
  CHECK(overlap(t, Shape(box)) == Approx(-0.01));
  TriangleSurface cube;
  for (int k = 0; k < 8; ++k) cube.points.emplace_back(k & 1, (k >> 1) & 1, k >> 2);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  Result<SolidSurface> surface = make_solid_surface(std::move(cube));
  REQUIRE(surface);
  const auto shared = std::make_shared<const SolidSurface>(std::move(*surface));
  // Its corner (0, 0, 1) in the floor face; then a corner of the tetrahedron in its top.
  CHECK(overlap(t, Shape(Solid{shared, {0.2, 0.2, -0.96}})) == Approx(0.04));
  CHECK(overlap(t, Shape(Solid{shared, {-0.5, -0.5, -0.9}})) == Approx(0.1));
  CHECK(overlap(t, Shape(Solid{shared, {0.2, 0.2, -1.5}})) < 0);
}

TEST_CASE("overlaps of frames are found by the grid as by all pairs", "[contact][judge]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 4), side(0.05, 0.6);
  ContactFrame frame;
  for (std::uint32_t k = 0; k < 300; ++k) {
    add(frame, tetrahedron({place(random), place(random), place(random)}, side(random)), k / 2);
  }
  const double edge = mean_edge(frame);
  FrameOverlaps slow;
  for (std::uint32_t a = 0; a < 300; ++a) {
    for (std::uint32_t b = a + 1; b < 300; ++b) {
      if (frame.piece[a] == frame.piece[b]) continue;
      TetCorners p, q;
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] = frame.points[frame.tetrahedra[a][k]];
        q[k] = frame.points[frame.tetrahedra[b][k]];
      }
      const double depth = overlap(p, q);
      if (depth <= 1e-6 * edge) continue;
      ++slow.pairs;
      slow.pieces.depth = std::max(slow.pieces.depth, depth);
    }
  }
  const FrameOverlaps seen = judge_overlaps(frame, edge);
  REQUIRE(slow.pairs > 10);
  CHECK(seen.pairs == slow.pairs);
  CHECK(seen.pieces.depth == slow.pieces.depth);
}

TEST_CASE("a body that passes through another between two frames is caught at any speed",
          "[contact][judge]") {
  const double size = GENERATE(0.002, 0.05, 2.0), way = GENERATE(3.0, 300.0, 30000.0);
  const Vec3 sizes = Vec3::Constant(size);
  const Vec3 low(0.31, 0.42, 1.01);
  const ContactFrame before = two_boxes(low, sizes);
  const ContactFrame after = two_boxes(low - Vec3(0, 0, way + size), sizes);
  const double tolerance = 0.1 * std::min(size, 1.0);
  const std::vector<Crossing> seen = judge_crossings(before, after, tolerance);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].passed);
  CHECK(seen[0].deepest.depth > tolerance);
  CHECK(before.piece[seen[0].deepest.a] != before.piece[seen[0].deepest.b]);
  // The small block has reached the large one and has not left it.
  CHECK(seen[0].deepest.time * (way + size) > 0.01);
  CHECK(seen[0].deepest.time * (way + size) < 1.02 + size);
}

TEST_CASE("a body that passes by, slides or rests does not cross", "[contact][judge]") {
  const Vec3 size = Vec3::Constant(0.2);
  // Past its side, just above it, just too deep, and at rest a little too deep.
  for (const auto& [from, to] : {std::pair{Vec3(1.01, 0.3, 3), Vec3(1.01, 0.3, -3)},
                                 std::pair{Vec3(-2, 0.3, 1.0001), Vec3(3, 0.3, 1.0001)},
                                 std::pair{Vec3(-2, 0.3, 0.9999), Vec3(3, 0.3, 0.9999)},
                                 std::pair{Vec3(0.3, 0.3, 0.99), Vec3(0.4, 0.3, 0.99)}}) {
    CHECK(judge_crossings(two_boxes(from, size), two_boxes(to, size), 0.02).empty());
  }
  const std::vector<Crossing> in =
      judge_crossings(two_boxes({0.3, 0.3, 1.1}, size), two_boxes({0.3, 0.3, 0.8}, size), 0.02);
  REQUIRE(in.size() == 1);
  CHECK_FALSE(in[0].passed);
}

TEST_CASE("an edge that goes through an edge is a crossing", "[contact][judge]") {
  ContactFrame before, after;
  add(before, {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.1, -0.1), Vec3(0, -0.1, -0.1)}, 0);
  after = before;
  const TetCorners other = {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0.1, 0, 0.1), Vec3(-0.1, 0, 0.1)};
  const auto moved = [&](double z) {
    TetCorners t = other;
    for (Vec3& p : t) p[2] += z;
    return t;
  };
  add(before, moved(0.5), 1);
  add(after, moved(-0.5), 1);
  const std::vector<Crossing> seen = judge_crossings(before, after, 0.01);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].passed);
  // They are 0.1 m high: the overlap is deepest when one is fully in the other.
  CHECK(seen[0].deepest.time == Approx(0.6).margin(0.02));
}

TEST_CASE("obstacles that pass through bodies are caught", "[contact][judge]") {
  const double radius = GENERATE(1e-3, 0.1, 1.0);
  ContactFrame before;
  add_box(before, {0, 0, 0}, {1, 1, 0.1}, 0);
  ContactFrame after = before;
  before.obstacles = {{.shape = Sphere{{0.3, 0.41, 50 + radius}, radius}}};
  after.obstacles = {{.shape = Sphere{{0.3, 0.41, -70 - radius}, radius}}};
  const std::vector<Crossing> seen = judge_crossings(before, after, 5e-4);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].passed);
  CHECK(seen[0].deepest.obstacle == 0);
  CHECK(seen[0].deepest.b == DeepestPair::none);
  // A box turns by a quarter in place, and its corner sweeps through.
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  before.obstacles = {
      {.shape = Box{{0.5, 0.5, 0.35}, Eigen::Quaterniond::Identity(), {0.2, 0.2, 0.2}}}};
  after.obstacles = {{.shape = Box{{0.5, 0.5, 0.35}, turned, {0.2, 0.2, 0.2}}}};
  const std::vector<Crossing> swept = judge_crossings(before, after, 5e-4);
  REQUIRE(swept.size() == 1);
  CHECK(swept[0].deepest.depth == Approx(0.1 + 0.2 * std::sqrt(2.0) - 0.35).margin(1e-3));
}

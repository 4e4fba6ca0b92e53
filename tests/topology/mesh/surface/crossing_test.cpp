// SPDX-License-Identifier: MIT
// Triangles that cross, compared with twins in whole numbers: axes that part them, rays that their
// corners share.
#include "topology/mesh/surface/crossing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "tests/support/crossing_twin.hpp"
#include "topology/mesh/box_tree.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Random = std::mt19937_64;

/// Points of a grid of n x n x n, each once.
std::vector<Point> grid(int n) {
  std::vector<Point> points;
  for (int i = 0; i < n * n * n; ++i) {
    points.push_back({1.0 * (i % n), 1.0 * (i / n % n), 1.0 * (i / n / n)});
  }
  return points;
}

/// Three points, not on a line; with `shared` of the corners of `other`.
Corners triangle(Random& random, const std::vector<Point>& points, const Corners& other,
                 std::size_t shared) {
  for (;;) {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = k < shared ? other[k] : static_cast<std::uint32_t>(random() % points.size());
    }
    std::shuffle(t.begin(), t.end(), random);
    if (std::set(t.begin(), t.end()).size() == 3 && is_no_line(points, t)) return t;
  }
}

}  // namespace

TEST_CASE("two triangles cross where a twin in whole numbers says so", "[mesh][crossing]") {
  Random random(20261125);
  for (const int n : {2, 3, 4, 9}) {
    const std::vector<Point> points = grid(n);
    std::array<std::array<int, 2>, 4> seen{};
    for (int round = 0; round < 6000; ++round) {
      const Corners a = triangle(random, points, {}, 0);
      const Corners b = triangle(random, points, a, static_cast<std::size_t>(round) % 4);
      INFO("grid " << n << " round " << round);
      const bool is_so = twins_cross(points, a, b);
      REQUIRE(triangles_cross(points, a, b) == is_so);
      REQUIRE(triangles_cross(points, b, a) == is_so);
      ++seen[static_cast<std::size_t>(round) % 4][is_so ? 1 : 0];
    }
    for (std::size_t shared = 0; shared < 3; ++shared) {
      if (n == 3 || n == 4) CHECK((seen[shared][0] > 20 && seen[shared][1] > 20));
    }
  }
}

TEST_CASE("a triangle crosses one that holds it, however both are turned", "[mesh][crossing]") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<Point> points;
    for (const auto& [u, v] : {std::array{0, 0}, {9, 0}, {0, 9}, {1, 1}, {2, 1}, {1, 2}}) {
      Point x{};
      x[(axis + 1) % 3] = u, x[(axis + 2) % 3] = v;
      points.push_back(x);
    }
    for (const Corners& large : {Corners{0, 1, 2}, Corners{2, 1, 0}}) {
      for (const Corners& small : {Corners{3, 4, 5}, Corners{3, 5, 4}}) {
        CHECK(triangles_cross(points, large, small));
        CHECK(triangles_cross(points, small, large));
      }
    }
  }
}

TEST_CASE("a long strip along any axis is searched to its end", "[mesh][crossing]") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<Point> points;
    std::vector<SurfaceTriangle> triangles;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      Point x{};
      x[axis] = i, x[(axis + 1) % 3] = i % 2, x[(axis + 2) % 3] = i % 2;
      points.push_back(x);
      if (i >= 2) triangles.push_back({{i - 2, i - 1, i}, i - 2});
    }
    const Crossings found = find_crossings(points, triangles);
    CHECK(found.is_finished);
    CHECK(found.pairs.empty());
  }
}

TEST_CASE("crossings found by boxes are those of all pairs of faces", "[mesh][crossing]") {
  Random random(7);
  const std::vector<Point> points = grid(7);
  for (int round = 0; round < 60; ++round) {
    std::vector<SurfaceTriangle> triangles;
    for (std::uint32_t i = 0; i < 14; ++i) {
      Corners corners;
      for (auto& c : corners) c = static_cast<std::uint32_t>(random() % points.size());
      if (std::set(corners.begin(), corners.end()).size() < 3) continue;
      // Faces have several triangles, in any order; some lie in one place.
      triangles.push_back({corners, static_cast<std::uint32_t>(random() % 9)});
      if (random() % 6 == 0)
        triangles.push_back({corners, static_cast<std::uint32_t>(random() % 9)});
    }
    std::set<std::array<std::uint32_t, 2>> slow;
    for (const SurfaceTriangle& a : triangles) {
      for (const SurfaceTriangle& b : triangles) {
        if (a.face >= b.face || !is_no_line(points, a.corners) || !is_no_line(points, b.corners))
          continue;
        if (twins_cross(points, a.corners, b.corners)) slow.insert({a.face, b.face});
      }
    }
    const Crossings found = find_crossings(points, triangles);
    CHECK(found.is_finished);
    CHECK(found.pairs == std::vector(slow.begin(), slow.end()));
  }
}

TEST_CASE("a triangle without area is held against none", "[mesh][crossing]") {
  // Corner 1 is on the line from 0 to 2, and the others share it.
  const std::vector<Point> points = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, -4, 1}, {2, -4, 1}};
  const std::vector<SurfaceTriangle> triangles = {
      {{0, 1, 2}, 0}, {{0, 3, 1}, 1}, {{1, 3, 4}, 2}, {{1, 4, 2}, 3}};
  CHECK_FALSE(has_area(points, triangles[0].corners));
  CHECK(has_area(points, triangles[1].corners));
  CHECK(find_crossings(points, triangles).pairs.empty());
}

TEST_CASE("a search ends where thousands of triangles lie through each other", "[mesh][crossing]") {
  // Alike and apart, along their normal: their boxes overlap, and they do not meet.
  const auto stacked = [](std::uint32_t n) {
    std::vector<Point> points;
    std::vector<SurfaceTriangle> triangles;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double at = i * 0x1p-20;
      for (std::size_t k = 0; k < 3; ++k) {
        points.push_back({at, at, at});
        points.back()[k] += 1;
      }
      triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, i});
    }
    // Two that cross, elsewhere and last: a search that has ended does not come to them.
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(),
                  {{9, 9, 9}, {12, 9, 9}, {9, 12, 9}, {10, 10, 8}, {10, 10, 10}, {20, 20, 9}});
    if (n == 1000) {
      triangles.push_back({{first, first + 1, first + 2}, n});
      triangles.push_back({{first + 3, first + 4, first + 5}, n + 1});
      CHECK(triangles_cross(points, triangles[n].corners, triangles[n + 1].corners));
    }
    const Crossings found = find_crossings(points, triangles);
    CHECK(found.pairs.empty());
    return found.is_finished;
  };
  CHECK(stacked(1));
  // n triangles of which each sees all: 400 n + 10 000 looks are enough for 250, not for 1 000.
  CHECK(stacked(250));
  CHECK_FALSE(stacked(1000));
}

TEST_CASE("a search ends where it has looked 10 000 times, and 400 times a triangle, not before",
          "[mesh][crossing]") {
  // Heaps of `near` and `few` triangles in parallel planes, and `apart` that lie alone: numbers for
  // which the looks at nodes and boxes of the tree come to the limit, and to one more.
  struct Case {
    int near, apart, few;
    std::size_t more;
  };
  for (const Case c : {Case{294, 56, 8, 0}, Case{295, 36, 30, 1}}) {
    std::vector<Point> points;
    std::vector<SurfaceTriangle> triangles;
    std::vector<BoundingBox> boxes;
    const auto add = [&](double at) {
      const auto p = static_cast<std::uint32_t>(points.size());
      points.insert(points.end(), {{1 + at, at, at}, {at, 1 + at, at}, {at, at, 1 + at}});
      triangles.push_back({{p, p + 1, p + 2}, p / 3});
      boxes.push_back({{at, at, at}, {1 + at, 1 + at, 1 + at}});
    };
    for (int i = 0; i < c.near; ++i) add(i * 0x1p-20);
    for (int i = 0; i < c.apart; ++i) add(4.0 * (i + 1));
    for (int i = 0; i < c.few; ++i) add(-100 - i * 0x1p-20);
    const BoxTree tree = box_tree(boxes);
    std::size_t looks = 0;
    for (const BoundingBox& own : tree.boxes) {
      const auto overlap = [&](const BoundingBox& box) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (box.low[k] > own.high[k] || own.low[k] > box.high[k]) return false;
        }
        return true;
      };
      looks += for_each_box(tree, overlap, [](std::uint32_t) {});
    }
    REQUIRE(looks == 400 * triangles.size() + 10000 + c.more);
    const Crossings found = find_crossings(points, triangles);
    CHECK(found.pairs.empty());
    CHECK(found.is_finished == (c.more == 0));
  }
}

// SPDX-License-Identifier: MIT
// Bricks are found in their triangles, whatever cuts them up; nothing else is.
#include "mechanics/rubble/convex_solid.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "mechanics/contact/shapes/manifold.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

Vec3 as_vec(const Point& p) { return {p[0], p[1], p[2]}; }

/// Faces of one tetrahedron alone, seen from outside, after `move`.
template <class Move>
Triangles outside(const TetMesh& mesh, Move move) {
  constexpr int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::map<std::array<std::uint32_t, 3>, std::vector<std::array<std::uint32_t, 3>>> seen;
  for (const auto& tet : mesh.tetrahedra) {
    for (const auto& f : faces) {
      std::array<std::uint32_t, 3> face;
      for (std::size_t k = 0; k < 3; ++k) face[k] = tet[std::size_t(f[k])];
      std::array<std::uint32_t, 3> key = face;
      std::ranges::sort(key);
      seen[key].push_back(face);
    }
  }
  Triangles triangles;
  for (const auto& [key, found] : seen) {
    if (found.size() > 1) continue;
    auto& t = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) t[k] = move(as_vec(mesh.points[found[0][k]]));
  }
  return triangles;
}

Triangles outside(const TetMesh& mesh) {
  return outside(mesh, [](const Vec3& x) { return x; });
}

constexpr double tolerance = 1e-6;

}  // namespace

TEST_CASE("a box is one solid, however it is cut and turned", "[rubble]") {
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  for (const suite::Cells cells : {suite::Cells{1, 1, 1}, {2, 3, 1}, {4, 4, 4}}) {
    const Mat3 turn = Eigen::Quaterniond(any(random), any(random), any(random), any(random))
                          .normalized()
                          .toRotationMatrix();
    const auto move = [&](const Vec3& x) -> Vec3 { return turn * x + Vec3(1, 2, 3); };
    const auto solid = find_convex_solid(outside(suite::kuhn_box(cells), move), tolerance);
    REQUIRE(solid);
    CHECK(solid->kind.vertices == 8);
    CHECK(solid->kind.faces == 6);
    CHECK(solid->kind.edges == 12);
    // It meets others as the box itself does.
    const Vec3 half = 0.5 * Vec3(cells[0], cells[1], cells[2]);
    const Polytope box = make_box(move(half), turn, half);
    const Polytope found = make_polytope(*solid, Vec3::Zero(), Mat3::Identity());
    for (int k = 0; k < 50; ++k) {
      const auto near = [&] {
        return Vec3(move(half) + Vec3(any(random), any(random), any(random)));
      };
      std::array<Vec3, 4> corners = {near(), near(), near(), near()};
      const double volume =
          (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]);
      if (volume < 0) std::swap(corners[2], corners[3]);
      const Polytope chip = make_tetrahedron(corners);
      CHECK(separation_by_all_axes(found, chip) ==
            Approx(separation_by_all_axes(box, chip)).margin(1e-12));
    }
  }
}

TEST_CASE("wedges and pairs of tetrahedra are solids with faces of three and four", "[rubble]") {
  TetMesh wedge;  // half of a cube
  wedge.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}};
  wedge.tetrahedra = {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}};
  const auto solid = find_convex_solid(outside(wedge), tolerance);
  REQUIRE(solid);
  CHECK(solid->kind.vertices == 6);
  CHECK(solid->kind.faces == 5);
  CHECK(solid->kind.edges == 9);

  TetMesh pair;
  pair.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}};
  pair.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const auto both = find_convex_solid(outside(pair), tolerance);
  REQUIRE(both);
  CHECK(both->kind.vertices == 5);
  CHECK(both->kind.faces == 6);
}

TEST_CASE("what is hollow, bent, dented or has too many faces is no such solid", "[rubble]") {
  CHECK_FALSE(find_convex_solid(outside(suite::ring({3, 3, 1})), tolerance));
  CHECK_FALSE(find_convex_solid(outside(suite::shell({3, 3, 3})), tolerance));
  const auto corner_less = [](int i, int j, int k) { return i + j + k > 0; };
  CHECK_FALSE(find_convex_solid(outside(suite::kuhn_cubes({2, 2, 2}, corner_less)), tolerance));
  CHECK_FALSE(find_convex_solid(outside(suite::closed_fan(5)), tolerance));
  // One corner moved by more than the tolerance; by less it is the box still.
  for (const double by : {1e-3, 1e-7}) {
    const auto move = [&](const Vec3& x) -> Vec3 {
      return (x - Vec3(1, 1, 1)).norm() < 1e-9 ? Vec3(x - by * Vec3(0, 0, 1)) : x;
    };
    CHECK(find_convex_solid(outside(suite::kuhn_box({1, 1, 1}), move), tolerance).has_value() ==
          (by < tolerance));
  }
}

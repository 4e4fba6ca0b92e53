// SPDX-License-Identifier: MIT
// Meshes of simple solids: valid, conforming, well shaped, at their place.
#include "topology/mesh/solids/solids.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "topology/mesh/check.hpp"
#include "topology/mesh/solids/orient.hpp"

using namespace sunder;

namespace {

void check_solid(const TetMesh& mesh, double volume, std::ptrdiff_t euler) {
  const MeshCheck check = check_file_mesh(file_mesh_of(mesh));
  for (const Finding& f : check.findings) UNSCOPED_INFO(f.text);
  CHECK(check.findings.empty());
  REQUIRE(check.counts);
  CHECK(check.counts->components == 1);
  CHECK(check.counts->boundary_sheets == 1);
  CHECK(check.counts->euler_characteristic == euler);
  CHECK(check.counts->volume == Approx(volume));
  CHECK(check.counts->vertices == mesh.points.size());
}

double least_ratio(const TetMesh& mesh) {
  return check_file_mesh(file_mesh_of(mesh)).quality->smallest_radius_ratio.value;
}

}  // namespace

TEST_CASE("boxes of any counts conform and fill their volume", "[mesh][solids]") {
  for (std::uint32_t x = 1; x <= 3; ++x) {
    for (std::uint32_t y = 1; y <= 3; ++y) {
      for (std::uint32_t z = 1; z <= 2; ++z) {
        const TetMesh mesh = box_solid({0.1 * x, 0.1 * y, 0.1 * z}, {x, y, z});
        CHECK(mesh.tetrahedra.size() == 6 * x * y * z);
        check_solid(mesh, 1e-3 * x * y * z, 1);
        CHECK(least_ratio(mesh) > 0.7);
      }
    }
  }
}

TEST_CASE("diagonals of a box run in several directions", "[mesh][solids]") {
  // Each brick has one edge through its middle: of 2 x 2 x 2 bricks one along each of four
  // diagonals.
  const TetMesh mesh = box_solid({2, 2, 2}, {2, 2, 2});
  std::map<std::array<bool, 2>, int> directions;
  for (const auto& t : mesh.tetrahedra) {
    for (const std::uint32_t a : t) {
      for (const std::uint32_t b : t) {
        const Point &p = mesh.points[a], &q = mesh.points[b];
        const double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
        if (x > 0 && y != 0 && z != 0) ++directions[{y > 0, z > 0}];
      }
    }
  }
  CHECK(directions.size() == 4);
  for (const auto& [direction, count] : directions) CHECK(count == 12);
}

TEST_CASE("cylinders have polygons for circles and conform", "[mesh][solids]") {
  for (const std::uint32_t rings : {1U, 2U, 5U}) {
    for (const std::uint32_t layers : {1U, 2U, 3U}) {
      const TetMesh mesh = cylinder_solid(0.5, 0.3 * layers, rings, layers);
      CHECK(mesh.tetrahedra.size() == 18 * rings * rings * layers);
      const double area = 3 * rings * 0.25 * std::sin(M_PI / (3 * rings));
      check_solid(mesh, area * 0.3 * layers, 1);
    }
  }
  CHECK(least_ratio(cylinder_solid(1, 2, 6, 12)) > 0.5);
}

TEST_CASE("tubes are rings and conform", "[mesh][solids]") {
  for (const std::uint32_t through : {1U, 2U, 3U}) {
    for (const std::uint32_t layers : {1U, 2U}) {
      const TetMesh mesh = tube_solid(0.8, 1, 0.4, {through, 30, layers});
      CHECK(mesh.tetrahedra.size() == 6 * through * 30 * layers);
      const double area = 15 * (1 - 0.64) * std::sin(2 * M_PI / 30);
      check_solid(mesh, area * 0.4, 0);
    }
  }
}

TEST_CASE("balls are round, conform and have no bad cell at any size", "[mesh][solids]") {
  for (const std::uint32_t shells : {1U, 2U, 3U, 6U, 10U}) {
    const TetMesh mesh = ball_solid(0.5, shells);
    CHECK(mesh.tetrahedra.size() == 20 * shells * shells * shells);
    const MeshCheck check = check_file_mesh(file_mesh_of(mesh));
    CHECK(check.findings.empty());
    check_solid(mesh, check.counts->volume, 1);
    CHECK(check.quality->smallest_radius_ratio.value > 0.5);
    const auto far = [](const Point& p) { return std::hypot(p[0], p[1], p[2]); };
    const auto surface = [&](const Point& p) { return std::abs(far(p) - 0.5) < 1e-12; };
    // As many points lie on the sphere as a divided icosahedron has.
    CHECK(std::ranges::count_if(mesh.points, surface) ==
          static_cast<std::ptrdiff_t>(10 * shells * shells + 2));
    CHECK(std::ranges::all_of(mesh.points, [&](const Point& p) { return far(p) < 0.5 + 1e-12; }));
  }
}

TEST_CASE("tetrahedra are added in positive order", "[mesh][solids]") {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_positive(mesh, {0, 1, 2, 3});
  add_positive(mesh, {0, 2, 1, 3});
  CHECK(mesh.tetrahedra[0] == std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK(mesh.tetrahedra[1] == std::array<std::uint32_t, 4>{0, 2, 3, 1});
}

// SPDX-License-Identifier: MIT
// Faulty surfaces become whole ones, and each change is counted.
#include "topology/mesh/surface/repair/surface_repair.hpp"

#include <catch2/catch.hpp>
#include <utility>

#include "tests/topology/mesh/surface/repair/cube_surface.hpp"
#include "topology/mesh/surface/edges.hpp"
#include "topology/mesh/surface/repair/facing.hpp"
#include "topology/mesh/surface/repair/holes.hpp"
#include "topology/mesh/surface/repair/stitch.hpp"
#include "topology/mesh/surface/repair/walls.hpp"
#include "topology/mesh/surface/surface_check.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// The surface of a cube of side 1 again, whatever was wrong.
void check_whole(const FileMesh& mesh, double volume = 1) {
  const SurfaceCheck check = check_surface(mesh);
  CHECK(check.is_closed);
  CHECK(check.is_oriented);
  CHECK(check.crosses_itself == false);
  REQUIRE(check.volume);
  CHECK(*check.volume == Approx(volume));
}

/// Each triangle with points of its own, moved by up to `noise`.
FileMesh soup(const FileMesh& mesh, double noise) {
  FileMesh apart;
  double moved = 0;
  for (const Triangle& t : mesh.triangles.corners) {
    const auto first = static_cast<std::uint32_t>(apart.points.size());
    for (const std::uint32_t corner : t) {
      Point p = mesh.points[corner];
      moved = moved > noise ? -noise : moved + noise / 3;
      for (double& x : p) x += moved;
      apart.points.push_back(p);
    }
    apart.triangles.corners.push_back({first, first + 1, first + 2});
  }
  return apart;
}

}  // namespace

TEST_CASE("edges are counted by their triangles", "[mesh][repair]") {
  FileMesh cube = cube_surface();
  CHECK(sides_of(cube.triangles.corners).size() == 36);
  CHECK(count_edges(cube.triangles.corners).open == 0);
  CHECK(open_sides(cube.triangles.corners).empty());
  cube.triangles.corners.pop_back();
  CHECK(count_edges(cube.triangles.corners).open == 3);
  cube.triangles.corners.push_back({0, 1, 6});
  cube.triangles.corners.push_back({0, 1, 7});
  CHECK(count_edges(cube.triangles.corners).thick == 2);  // and that from 1 to 6
}

TEST_CASE("a soup of triangles is stitched, exact or rounded", "[mesh][repair]") {
  for (const double noise : {0.0, 1e-7, 1e-6}) {
    FileMesh apart = soup(cube_surface(), noise);
    const Stitching done = stitch(apart.points, apart.triangles.corners);
    CHECK(done.points == 28);
    CHECK(done.distance <= 6 * noise);
    CHECK(count_edges(apart.triangles.corners).open == 0);
  }
  // A gap that can be seen is none of rounding.
  FileMesh wide = soup(cube_surface(), 0.02);
  stitch(wide.points, wide.triangles.corners);
  CHECK(count_edges(wide.triangles.corners).open > 0);
}

TEST_CASE("a side is divided where a point of its neighbours lies on it", "[mesh][repair]") {
  FileMesh cube = cube_surface();
  // The edge from 0 to 1 has a point in its middle, on one side of it alone.
  cube.points.push_back({0.5, 1e-9, 0});
  cube.triangles.corners[0] = {0, 2, 8};
  cube.triangles.corners.push_back({8, 2, 1});
  CHECK(count_edges(cube.triangles.corners).open == 3);
  const Stitching done = stitch(cube.points, cube.triangles.corners);
  CHECK(done.sides == 1);
  CHECK(done.points == 0);
  CHECK(cube.triangles.corners.size() == 14);
  check_whole(cube);
}

TEST_CASE("doubled faces become one, and walls between two parts none", "[mesh][repair]") {
  FileMesh doubled = cube_surface();
  doubled.triangles.corners.push_back({2, 1, 0});
  doubled.triangles.corners.push_back({0, 1, 2});
  const Walls one = drop_walls(doubled.triangles.corners);
  CHECK(one.doubled == 2);
  CHECK(one.inner == 0);
  check_whole(doubled);
  // Two cubes share the face x = 1, each with triangles of its own there.
  FileMesh pair = together(cube_surface(), cube_surface());
  for (std::size_t p = 8; p < 16; ++p) pair.points[p][0] += 1;
  for (Triangle& t : pair.triangles.corners) {
    for (std::uint32_t& corner : t) {
      const std::pair<std::uint32_t, std::uint32_t> same[] = {{8, 1}, {11, 2}, {12, 5}, {15, 6}};
      for (const auto& [own, other] : same) corner = corner == own ? other : corner;
    }
  }
  // Diagonals of the two faces agree.
  pair.triangles.corners[22] = {2, 1, 6};
  pair.triangles.corners[23] = {6, 1, 5};
  const Walls inner = drop_walls(pair.triangles.corners);
  CHECK(inner.inner == 4);
  CHECK(inner.doubled == 0);
  check_whole(pair, 2);
}

TEST_CASE("faces look outward, and those of cavities inward", "[mesh][repair]") {
  FileMesh cube = cube_surface();
  std::swap(cube.triangles.corners[3][0], cube.triangles.corners[3][1]);
  std::swap(cube.triangles.corners[7][0], cube.triangles.corners[7][1]);
  CHECK(face_outward(cube.points, cube.triangles.corners) == 2);
  check_whole(cube);
  FileMesh inside_out = cube_surface();
  for (Triangle& t : inside_out.triangles.corners) std::swap(t[0], t[1]);
  CHECK(face_outward(inside_out.points, inside_out.triangles.corners) == 12);
  check_whole(inside_out);
  FileMesh cavity = cube_surface(0.25, 0.5);
  for (Triangle& t : cavity.triangles.corners) std::swap(t[0], t[1]);
  FileMesh hollow = together(cube_surface(), cavity);
  CHECK(face_outward(hollow.points, hollow.triangles.corners) == 0);
  CHECK(shells_of(hollow.triangles.corners)[20] == 12);
  CHECK(enclosed_volume(hollow.points, hollow.triangles.corners) == Approx(0.875));
}

TEST_CASE("rims of holes are found and covered", "[mesh][repair]") {
  FileMesh cube = cube_surface();
  cube.triangles.corners.resize(10);  // the face x = 0 is open
  const std::vector<Rim> rims = rims_of(cube.triangles.corners);
  REQUIRE(rims.size() == 1);
  CHECK(rims[0].size() == 4);
  CHECK(width_of(cube.points, rims[0]) == 1);
  CHECK(middle_of(cube.points, rims[0]) == Point{0, 0.5, 0.5});
  const std::vector<Triangle> cover = cover_of(cube.points, cube.triangles.corners, rims[0]);
  REQUIRE(cover.size() == 2);
  cube.triangles.corners.insert(cube.triangles.corners.end(), cover.begin(), cover.end());
  check_whole(cube);
  // Two holes that meet at a point are two.
  FileMesh two = cube_surface();
  two.triangles.corners = {{0, 3, 2}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6},
                           {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  CHECK(rims_of(two.triangles.corners).size() == 2);
}

TEST_CASE("a surface with all of these faults is whole afterwards", "[mesh][repair]") {
  FileMesh bad = cube_surface();
  bad.triangles.corners.push_back({4, 5, 6});
  std::swap(bad.triangles.corners[5][1], bad.triangles.corners[5][2]);
  bad.triangles.corners.erase(bad.triangles.corners.begin() + 8);
  bad = soup(bad, 1e-7);
  const SurfaceRepair done = repair_surface(bad, 2);
  CHECK(done.walls.doubled == 1);
  CHECK(done.turned == 1);
  CHECK(done.holes == 1);
  CHECK(done.cover == 1);
  CHECK(done.changed());
  CHECK(repair_words(done).size() == 4);
  CHECK(bad.points.size() == 8);
  check_whole(bad);
}

TEST_CASE("wide holes are left, with their place", "[mesh][repair]") {
  FileMesh open = cube_surface();
  open.triangles.corners.resize(10);
  const SurfaceRepair done = repair_surface(open, 0.1);
  CHECK(done.holes == 0);
  CHECK(done.wide_holes == 1);
  CHECK(done.widest_left == 1);
  CHECK(done.place_left == Point{0, 0.5, 0.5});
  FileMesh whole = cube_surface();
  CHECK_FALSE(repair_surface(whole, 0.1).changed());
  CHECK(whole == cube_surface());
}

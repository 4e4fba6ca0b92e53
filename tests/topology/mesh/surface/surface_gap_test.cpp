// SPDX-License-Identifier: MIT
// Distances between surfaces with known ones.
#include "topology/mesh/surface/surface_gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/topology/mesh/surface/repair/cube_surface.hpp"
#include "topology/mesh/surface/enclosure.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("the distance from a point to triangles is that to their nearest point", "[mesh]") {
  const FileMesh cube = cube_surface();
  const NearTriangles near(cube.points, cube.triangles.corners);
  CHECK(near.distance({0.5, 0.5, 0.75}) == Approx(0.25));   // a face, from inside
  CHECK(near.distance({0.3, -2, 0.6}) == Approx(2));        // a face
  CHECK(near.distance({4, 5, 0.5}) == Approx(5));           // an edge
  CHECK(near.distance({2, 2, 2}) == Approx(std::sqrt(3)));  // a corner
  CHECK(near.distance({1, 1, 1}) == 0);
}

TEST_CASE("cubes inside each other lie apart by the way between their corners", "[mesh]") {
  const FileMesh outer = cube_surface(), inner = cube_surface(0.1, 0.8);
  const SurfaceGap gap =
      gap_between(outer.points, outer.triangles.corners, inner.points, inner.triangles.corners);
  CHECK(gap.largest == Approx(0.1 * std::sqrt(3)));
  CHECK(gap.mean > 0.1);
  CHECK(gap.mean < 0.12);
  const NearTriangles shell(outer.points, outer.triangles.corners);
  CHECK(gap_to(shell, inner.points, inner.triangles.corners).largest == Approx(0.1));
  const SurfaceGap none =
      gap_between(outer.points, outer.triangles.corners, outer.points, outer.triangles.corners);
  CHECK(none.largest < 1e-15);
}

TEST_CASE("a closed surface holds points, but not those of its cavity", "[mesh]") {
  const FileMesh hollow = together(cube_surface(), cube_surface(0.25, 0.5));
  const Enclosure body(hollow.points, hollow.triangles.corners);
  CHECK(body.holds({0.1, 0.5, 0.5}));
  CHECK(body.holds({0.9, 0.9, 0.1}));
  CHECK_FALSE(body.holds({0.5, 0.45, 0.55}));
  CHECK_FALSE(body.holds({1.5, 0.5, 0.5}));
  CHECK_FALSE(body.holds({-3, -3, -3}));
}

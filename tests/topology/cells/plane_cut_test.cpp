// SPDX-License-Identifier: MIT
// Cuts by planes whose sections are known.
#include "topology/cells/plane_cut.hpp"

#include <cmath>
#include <optional>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

struct Halves {
  double section = 0, positive = 0, negative = 0;
  std::size_t components = 0;
};

double volume_of(const VolumeMap& map, TetId t) {
  std::array<Point, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = map.point(map.corners(t)[i]);
  std::array<Point, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) d[i][k] = x[i + 1][k] - x[0][k];
  }
  return (d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
          d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
          d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) / 6;
}

Halves cut(VolumeMap& map, const CuttingPlane& plane) {
  const auto made = cut_cells(map, plane);
  REQUIRE(made);
  Halves halves;
  const auto distance = [&](const Point& x) {
    return plane.normal[0] * x[0] + plane.normal[1] * x[1] + plane.normal[2] * x[2] - plane.offset;
  };
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    double low = 0, high = 0;
    for (const VertexId v : map.corners(TetId{t})) {
      const double s = distance(map.point(v));
      low = std::min(low, s), high = std::max(high, s);
    }
    CHECK((low > -1e-12 || high < 1e-12));
    (high > -low ? halves.positive : halves.negative) += volume_of(map, TetId{t});
  }
  for (const HalfFaceId f : made->faces) {
    std::array<Point, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = map.point(corners_of_face(map.corners(tetrahedron_of(f)), f)[i]);
      CHECK(std::abs(distance(x[i])) < 1e-12);
    }
    Point a, b;
    for (std::size_t k = 0; k < 3; ++k) a[k] = x[1][k] - x[0][k], b[k] = x[2][k] - x[0][k];
    const Point n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    halves.section += std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
  }
  for (const HalfFaceId f : made->faces) split_face(map, f);
  CHECK(check(map).empty());
  halves.components = count_cells(map).components;
  return halves;
}

}  // namespace

TEST_CASE("a cube cut by planes: areas and volumes as geometry has them", "[topology][cells]") {
  struct Case {
    CuttingPlane plane;
    double section, positive;
    std::size_t components;
  };
  const double third = 1.0 / 3;
  const std::vector<Case> cases = {
      {{{1, 0, 0}, third}, 1, 2 * third, 2},                          // through no point
      {{{1, 0, 0}, 0.5}, 1, 0.5, 2},                                  // along faces that are there
      {{{1, 1, 1}, 1.5}, 3 * std::sqrt(3.0) / 4, 0.5, 2},             // the regular hexagon
      {{{1, 1, 1}, 2.75}, std::sqrt(3.0) / 2 / 16, 1.0 / 384, 2},     // a corner
      {{{1, -1, 0}, 0}, std::sqrt(2.0), 0.5, 2},                      // through two edges
      {{{0, 0, 2}, 2}, 0, 0, 1},                                      // a side of the cube
      {{{0, 0, 1}, 7}, 0, 0, 1}};                                     // beside it
  for (const Case& c : cases) {
    for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
      VolumeMap map = built(kuhn_box({2, 2, 2}, 0.5));
      map.set_kernel(kernel);
      const Halves halves = cut(map, c.plane);
      CHECK(halves.section == Approx(c.section).epsilon(1e-12).margin(1e-14));
      CHECK(halves.positive == Approx(c.positive).epsilon(1e-12).margin(1e-14));
      CHECK(halves.positive + halves.negative == Approx(1).epsilon(1e-13));
      CHECK(halves.components == c.components);
    }
  }
}

TEST_CASE("a plane that is none is refused", "[topology][cells]") {
  VolumeMap map = built(two_tetrahedra());
  CHECK_FALSE(cut_cells(map, {{0, 0, 0}, 1}));
  CHECK_FALSE(cut_cells(map, {{0, 0, 1}, std::nan("")}));
  CHECK(cut_cells(map, {{0, 0, 0}, 1}).findings[0].code == "not_a_direction");
}

TEST_CASE("a plane through points but for rounding passes through them", "[topology][cells]") {
  // 0.1, 0.2, 0.30000000000000004, ...: the sums of most are off the plane by a few units in the last place.
  VolumeMap map = built(kuhn_box({4, 4, 4}, 0.1));
  std::size_t expected = 0;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) expected += i + j <= 7 && i + j >= 3;
  }
  const auto cut = cut_cells(map, {{1, 1, 1}, 0.1 * 7});
  REQUIRE(cut);
  CHECK(cut->on_plane == expected);
  // A plane that only touches: no edge crosses it, the tolerance alone finds the corner.
  VolumeMap corner = built(kuhn_box({3, 3, 3}, 0.1));
  const auto touch = cut_cells(corner, {{1, 1, 1}, 0.9 + 5e-16});
  REQUIRE(touch);
  CHECK(touch->on_plane == 1);
  CHECK(touch->edit.vertices.empty());
}

TEST_CASE("an edge is not divided at its end", "[topology][cells]") {
  for (const double offset : {1e-14, -1e-14}) {
    VolumeMap map = built(kuhn_box({2, 2, 2}, 0.5));
    const Cells5 before = cells(map);
    const auto cut = cut_cells(map, {{0, 1, 0}, 0.5 + offset});
    REQUIRE(cut);
    CHECK(cut->on_plane == 9);
    CHECK(cut->faces.size() == 8);
    CHECK(cells(map) == before);
  }
}

TEST_CASE("vertices that were glued together lie in the plane once", "[topology][cells]") {
  VolumeMap map = built(open_fan(3));
  std::vector<std::array<HalfFaceId, 2>> sides;
  for (const HalfFaceId f : interior_faces(map)) sides.push_back({f, map.neighbour(f)});
  for (const auto& [f, g] : sides) REQUIRE(split_face(map, f).did);
  REQUIRE(glue_face(map, sides[0][0], sides[0][1]).refusal == GlueRefusal::none);
  // A plane through a row that is retired now.
  std::optional<double> height;
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    if (map.incident_tetrahedron(VertexId{v}).is_none()) height = map.point(VertexId{v})[2];
  }
  REQUIRE(height);
  std::size_t expected = 0;
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    expected += !map.incident_tetrahedron(VertexId{v}).is_none() &&
                map.point(VertexId{v})[2] == *height;
  }
  const auto cut = cut_cells(map, {{0, 0, 1}, *height});
  REQUIRE(cut);
  CHECK(cut->on_plane == expected);
}

TEST_CASE("a flat tetrahedron that lies in the plane goes with what is beneath", "[topology][cells]") {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 3, 4}, {1, 0, 3, 5}, {2, 1, 3, 5}};
  for (const double up : {1.0, -1.0}) {
    VolumeMap map = built(mesh);
    const auto cut = cut_cells(map, {{0, 0, up}, 0});
    REQUIRE(cut);
    CHECK(cut->edit.vertices.empty());
    REQUIRE(cut->faces.size() == 2);
    for (const HalfFaceId f : cut->faces) {
      CHECK(tetrahedron_of(map.neighbour(f)) == TetId{0});
      split_face(map, f);
    }
    CHECK(count_cells(map).components == 2);
  }
}

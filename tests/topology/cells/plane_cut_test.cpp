// SPDX-License-Identifier: MIT
// Cuts by planes with known sections.
#include "topology/cells/plane_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

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
          d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
         6;
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
    const Point n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0]};
    halves.section += std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
  }
  for (const HalfFaceId f : made->faces) split_face(map, f);
  CHECK(check(map).empty());
  halves.components = count_cells(map).components;
  return halves;
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The section of a plane with a body, point by point and edge by edge.
struct Met {
  std::vector<double> at;  // of each of the file's points; 0 in the plane
  std::set<std::pair<std::uint32_t, std::uint32_t>> divided;
};

Met met_by(const CuttingPlane& plane, double tolerance, const VolumeMap& map) {
  Met met;
  for (const Point& x : map.points()) {
    const Point term = {plane.normal[0] * x[0], plane.normal[1] * x[1], plane.normal[2] * x[2]};
    const double size =
        std::abs(plane.offset) + std::abs(term[0]) + std::abs(term[1]) + std::abs(term[2]);
    const double d = term[0] + term[1] + term[2] - plane.offset;
    met.at.push_back(std::abs(d) <= 8 * epsilon * size ? 0 : d);
  }
  std::set<std::uint32_t> near;
  for (const bool is_last : {false, true}) {
    for (const auto& corners : map.corners()) {
      for (const auto& [i, j] : edge_ends) {
        const auto [p, q] =
            std::minmax({map.point_of_vertex(corners[static_cast<std::size_t>(i)]),
                         map.point_of_vertex(corners[static_cast<std::size_t>(j)])});
        const double a = met.at[p], b = met.at[q];
        if (a == 0 || b == 0 || (a > 0) == (b > 0)) continue;
        if (is_last) met.divided.insert({p, q});
        if (std::abs(a) <= tolerance * (std::abs(a) + std::abs(b))) near.insert(p);
        if (std::abs(b) <= tolerance * (std::abs(a) + std::abs(b))) near.insert(q);
      }
    }
    if (is_last) break;
    for (const std::uint32_t p : near) met.at[p] = 0;
  }
  return met;
}

/// Interior half-faces with all corners in the plane, one apex above it and the other one not.
std::vector<HalfFaceId> section_of(const VolumeMap& map, const std::vector<double>& at) {
  std::vector<HalfFaceId> faces;
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    const HalfFaceId f{i}, g = map.neighbour(f);
    if (g.is_none()) continue;
    const auto apex = [&](HalfFaceId h) {
      const auto corners = map.corners(tetrahedron_of(h));
      return at[map.point_of_vertex(corners[static_cast<std::size_t>(place_of(h))])];
    };
    const auto corners = corners_of_face(map.corners(tetrahedron_of(f)), f);
    const bool is_flat =
        std::ranges::all_of(corners, [&](VertexId v) { return at[map.point_of_vertex(v)] == 0; });
    if (is_flat && apex(f) > 0 && apex(g) <= 0) faces.push_back(f);
  }
  return faces;
}

/// The plane of a face, its tetrahedron above.
CuttingPlane plane_of(const VolumeMap& map, HalfFaceId f) {
  const auto corners = corners_of_face(map.corners(tetrahedron_of(f)), f);
  const Point a = map.point(corners[0]), b = map.point(corners[1]), c = map.point(corners[2]);
  CuttingPlane plane;
  for (std::size_t i = 0; i < 3; ++i) {
    // The other way round than darts run, which have the normal outside.
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    plane.normal[i] = (b[k] - a[k]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[k] - a[k]);
    plane.offset += plane.normal[i] * a[i];
  }
  return plane;
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
      {{{1, 0, 0}, third}, 1, 2 * third, 2},                       // through no point
      {{{1, 0, 0}, 0.5}, 1, 0.5, 2},                               // along faces that are there
      {{{1, 1, 1}, 1.5}, 3 * std::sqrt(3.0) / 4, 0.5, 2},          // the regular hexagon
      {{{1, 1, 1}, 2.75}, std::sqrt(3.0) / 2 / 16, 1.0 / 384, 2},  // a corner
      {{{1, -1, 0}, 0}, std::sqrt(2.0), 0.5, 2},                   // through two edges
      {{{0, 0, 2}, 2}, 0, 0, 1},                                   // a side of the cube
      {{{0, 0, 1}, 7}, 0, 0, 1}};                                  // off it
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
  // 0.1, 0.2, 0.30000000000000004, ...: the sums of most are off the plane by a few units in the
  // last place.
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
    expected +=
        !map.incident_tetrahedron(VertexId{v}).is_none() && map.point(VertexId{v})[2] == *height;
  }
  const auto cut = cut_cells(map, {{0, 0, 1}, *height});
  REQUIRE(cut);
  CHECK(cut->on_plane == expected);
}

TEST_CASE("a flat tetrahedron that lies in the plane goes with what is beneath",
          "[topology][cells]") {
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

TEST_CASE("planes at any tolerance: what lies in them, what they divide, and their faces",
          "[topology][cells]") {
  std::mt19937_64 random(20261126);
  for (int trial = 0; trial < 200; ++trial) {
    const double cell = std::pow(10.0, static_cast<double>(below(random, 7)) - 3);
    TetMesh mesh = kuhn_box({2, 2, 2}, cell);
    for (Point& x : mesh.points) x[0] -= cell, x[1] -= 0.3 * cell;  // coordinates of both signs
    if (trial > 0 && below(random, 2) == 0) mesh = jittered(mesh, 0.1 * cell, random());
    VolumeMap map = built(mesh);
    map.set_kernel(MapKernel::dense);
    CuttingPlane plane;
    if (trial == 0 || below(random, 4) == 0) {
      plane = plane_of(map, HalfFaceId{trial == 0 ? 0 : below(random, 4 * map.tetrahedra())});
    } else {
      for (double& x : plane.normal) x = 2 * unit(random) - 1;
      const Point& x = mesh.points[below(random, mesh.points.size())];
      double size = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        plane.offset += plane.normal[i] * x[i];
        size += 2 * std::abs(plane.normal[i] * x[i]);
      }
      // Through a point, some roundings off it, or anywhere near.
      const std::size_t which = below(random, 3);
      if (which == 1) plane.offset += 40 * (unit(random) - 0.5) * epsilon * size;
      if (which == 2) plane.offset += (unit(random) - 0.5) * cell;
    }
    const double tolerance = std::array{0.0, 1e-12, 0.2, 0.45}[below(random, 4)];
    INFO(trial << ": tolerance " << tolerance << ", cells of " << cell << " m");
    Met met = met_by(plane, tolerance, map);
    const auto cut = cut_cells(map, plane, tolerance);
    REQUIRE(cut);
    CHECK(cut->on_plane == static_cast<std::size_t>(std::ranges::count(met.at, 0.0)));
    std::set<std::pair<std::uint32_t, std::uint32_t>> divided;
    for (const MiddleVertex& m : cut->edit.vertices) {
      const std::uint32_t a = map.point_of_vertex(m.ends[0]), b = map.point_of_vertex(m.ends[1]);
      divided.insert({a, b});
      CHECK(m.weight == Approx(met.at[a] / (met.at[a] - met.at[b])).epsilon(1e-14));
    }
    CHECK(divided == met.divided);
    CHECK(cut->edit.vertices.size() == divided.size());
    met.at.resize(map.points().size(), 0);
    const std::vector<HalfFaceId> section = section_of(map, met.at);
    CHECK(cut->faces == section);
    if (trial == 0) CHECK(section.front() == HalfFaceId{0});  // the very first one as well
  }
}

TEST_CASE("what is just at a tolerance lies in the plane", "[topology][cells]") {
  // Terms that sum to 2, along every two axes: of 8 units of that the first point is as far away,
  // or one unit farther.
  for (const int units : {8, 9}) {
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
      TetMesh mesh = one_tetrahedron();
      mesh.points = {{1 + units * epsilon, 8 * epsilon - 1, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 1}};
      CuttingPlane plane{{1, 1, 0}, 0};
      for (Point& x : mesh.points) std::ranges::rotate(x, x.begin() + axis);
      std::ranges::rotate(plane.normal, plane.normal.begin() + axis);
      VolumeMap map = built(mesh);
      const auto cut = cut_cells(map, plane, 0);
      REQUIRE(cut);
      CHECK(cut->on_plane == (units == 8 ? 1 : 0));
    }
  }
  // One corner on the other side, a quarter of its edges or a little more away, at every place.
  const std::array<Point, 4> places = {{{0, 0, 3}, {1, 0, 3}, {0, 1, 3}, {0.4, 0.5, 3}}};
  for (std::size_t place = 0; place < 4; ++place) {
    for (const bool is_mirrored : {false, true}) {
      for (const double depth : {1.0, 1.001}) {
        TetMesh mesh = one_tetrahedron();
        mesh.points.assign(places.begin(), places.end());
        mesh.points[place][2] = -depth;
        for (Point& x : mesh.points) x[0] *= is_mirrored ? -1 : 1;
        VolumeMap map = built(mesh);
        const auto cut = cut_cells(map, {{0, 0, 1}, 0}, 0.25);
        REQUIRE(cut);
        CHECK(cut->on_plane == (depth == 1 ? 1 : 0));
        CHECK(cut->edit.vertices.size() == (depth == 1 ? 0 : 3));
      }
    }
  }
}

TEST_CASE(
    "a face in the plane by the tolerance alone, with both its tetrahedra above, is no section",
    "[topology][cells]") {
  TetMesh mesh;  // the face stands upright on the plane
  mesh.points = {{0, 0, 0.01}, {1, 0, 0.01}, {0.5, 0, -0.02}, {0.5, 1, 1}, {0.5, -1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  VolumeMap map = built(mesh);
  const auto cut = cut_cells(map, {{0, 0, 1}, 0}, 0.4);
  REQUIRE(cut);
  CHECK(cut->on_plane == 3);
  CHECK(cut->edit.vertices.empty());
  CHECK(cut->faces.empty());
}

TEST_CASE("a plane is the same by any multiple of its numbers", "[topology][cells]") {
  const TetMesh mesh = kuhn_box({3, 2, 2}, 0.3);
  VolumeMap once = built(mesh);
  const auto cut_once = cut_cells(once, {{1, 0.5, -0.25}, 0.3125});
  REQUIRE(cut_once);
  CHECK(cut_once->faces.size() > 10);
  // The least of them leaves four bits behind its 1: products with it as it is would be as coarse.
  for (const int power : {-1070, -1000, -3, 5, 1000, 1023}) {
    INFO("2^" << power);
    VolumeMap map = built(mesh);
    const auto by = [power](double x) { return std::ldexp(x, power); };
    const auto made = cut_cells(map, {{by(1), by(0.5), by(-0.25)}, by(0.3125)});
    REQUIRE(made);
    CHECK(made->faces == cut_once->faces);
    CHECK(std::ranges::equal(map.points(), once.points()));
  }
  // Beyond all numbers once the normal is of length 1.
  VolumeMap map = built(mesh);
  const auto far = cut_cells(map, {{1e-200, 0, 0}, 1e200});
  REQUIRE(far);
  CHECK(far->faces.empty());
  CHECK(far->on_plane == 0);
}

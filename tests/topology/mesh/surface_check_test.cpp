// SPDX-License-Identifier: MIT
// Surfaces: closed, manifold, oriented, crossing themselves; area and volume.
#include "topology/mesh/surface/surface_check.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "topology/mesh/surface/exact_side.hpp"

using namespace sunder;

namespace {

/// A cube of six quadrilaterals, outward.
FileMesh cube(double size = 1, Point at = {0, 0, 0}) {
  FileMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back({at[0] + size * (i % 4 == 1 || i % 4 == 2), at[1] + size * (i % 4 >= 2),
                           at[2] + size * (i >= 4)});
  }
  for (const FaceCorners& f : faces_of(CellKind::hexahedron8)) {
    append_cell(mesh, CellKind::quad4, std::array<std::uint32_t, 4>{f[0], f[1], f[2], f[3]});
  }
  return mesh;
}

void append(FileMesh& mesh, const FileMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  const CellRows rows = rows_of(other, CellKind::quad4);
  for (std::size_t i = 0; i < rows.count; ++i) {
    std::array<std::uint32_t, 4> nodes{};
    for (std::size_t k = 0; k < 4; ++k) nodes[k] = rows[i][k] + first;
    append_cell(mesh, CellKind::quad4, nodes);
  }
}

std::size_t count(const SurfaceCheck& check, std::string_view code) {
  const auto found = std::ranges::find(check.findings, code, &Finding::code);
  return found == check.findings.end() ? 0 : found->count;
}

}  // namespace

TEST_CASE("a cube of quadrilaterals is closed, manifold, oriented and free of crossings",
          "[mesh][surface_check]") {
  const SurfaceCheck check = check_surface(cube(2, {5, 6, 7}));
  CHECK(check.findings.empty());
  CHECK((check.is_closed && check.is_manifold && check.is_oriented));
  CHECK(check.crosses_itself == false);
  CHECK(check.quadrilaterals == 6);
  CHECK((check.vertices == 8 && check.edges == 12 && check.components == 1));
  CHECK(check.euler_characteristic == 2);
  CHECK(check.area == Approx(24).epsilon(1e-14));
  CHECK(check.volume.value() == Approx(8).epsilon(1e-14));
  CHECK(check.extent.box.low == Point{5, 6, 7});
  CHECK(check.extent.box.high == Point{7, 8, 9});
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(check.extent.centre[k] == Approx(6.0 + static_cast<double>(k)).epsilon(1e-14));
  }
}

TEST_CASE("a hole, a face turned over, a second face and faces inward are told",
          "[mesh][surface_check]") {
  FileMesh mesh = cube();
  auto& points = other_cells(mesh, CellKind::quad4).points;
  SECTION("a hole") {
    points.resize(20);
    const SurfaceCheck check = check_surface(mesh);
    CHECK_FALSE(check.is_closed);
    CHECK(check.is_oriented);
    CHECK(check.boundary_edges == 4);
    CHECK(count(check, "open_edge") == 4);
    CHECK_FALSE(check.volume);
  }
  SECTION("a face turned over") {
    std::reverse(points.begin(), points.begin() + 4);
    const SurfaceCheck check = check_surface(mesh);
    CHECK(check.is_closed);
    CHECK_FALSE(check.is_oriented);
    CHECK(count(check, "inconsistent_orientation") == 4);
    CHECK_FALSE(check.volume);
  }
  SECTION("a face twice") {
    points.insert(points.end(), {points[0], points[1], points[2], points[3]});
    const SurfaceCheck check = check_surface(mesh);
    CHECK_FALSE(check.is_manifold);
    CHECK(count(check, "nonmanifold_edge") == 4);
    CHECK(count(check, "duplicate_face") == 1);
  }
  SECTION("all faces inward") {
    for (std::size_t i = 0; i < points.size(); i += 4) std::swap(points[i + 1], points[i + 3]);
    const SurfaceCheck check = check_surface(mesh);
    CHECK(count(check, "inside_out") == 1);
    CHECK(check.volume.value() == Approx(-1).epsilon(1e-14));
  }
  SECTION("corners of their own, as in STL") {
    FileMesh apart;
    const CellRows rows = rows_of(mesh, CellKind::quad4);
    for (std::size_t i = 0; i < rows.count; ++i) {
      std::array<std::uint32_t, 4> nodes{};
      for (std::size_t k = 0; k < 4; ++k) {
        nodes[k] = static_cast<std::uint32_t>(apart.points.size());
        apart.points.push_back(mesh.points[rows[i][k]]);
      }
      append_cell(apart, CellKind::quad4, nodes);
    }
    const SurfaceCheck check = check_surface(apart);
    CHECK(check.is_closed);
    CHECK(count(check, "coincident_points") == 16);
    CHECK(check.vertices == 8);
  }
}

TEST_CASE("cubes through each other cross, cubes beside each other do not",
          "[mesh][surface_check]") {
  FileMesh mesh = cube();
  SECTION("a corner inside") {
    append(mesh, cube(1, {0.5, 0.5, 0.5}));
    const SurfaceCheck check = check_surface(mesh);
    CHECK(check.crosses_itself == true);
    CHECK(count(check, "self_intersection") == 6);
    CHECK(check.components == 2);
  }
  SECTION("apart") {
    append(mesh, cube(1, {1 + 1e-15, 0, 0}));
    CHECK(check_surface(mesh).crosses_itself == false);
  }
  SECTION("touching in an edge") {
    append(mesh, cube(1, {1, 1, 0}));
    const SurfaceCheck check = check_surface(mesh);
    CHECK(check.crosses_itself == false);
    CHECK_FALSE(check.is_manifold);
    CHECK(count(check, "nonmanifold_edge") == 1);
  }
  SECTION("touching in a vertex") {
    append(mesh, cube(1, {1, 1, 1}));
    const SurfaceCheck check = check_surface(mesh);
    CHECK(check.crosses_itself == false);
    CHECK(count(check, "nonmanifold_vertex") == 1);
  }
  SECTION("a corner in the middle of a face") {
    append(mesh, cube(1, {1, 0.25, 0.25}));
    CHECK(check_surface(mesh).crosses_itself == true);
  }
}

TEST_CASE("signs of determinants are exact", "[mesh][surface_check]") {
  std::mt19937 random(20261125);
  std::uniform_int_distribution<int> small(-40, 40);
  for (int round = 0; round < 20000; ++round) {
    std::array<Point, 4> p;
    for (Point& q : p) q = {1.0 * small(random), 1.0 * small(random), 1.0 * small(random)};
    if (round % 3 == 0) p[3] = p[round % 2 == 0 ? 0 : 1];
    // Small integers: doubles compute their determinant without rounding. Shifted far away and
    // scaled by a power of two the points are still exact, and the plain formula is not.
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
      return (p[1][i] - p[0][i]) * ((p[2][j] - p[0][j]) * (p[3][k] - p[0][k]) -
                                    (p[2][k] - p[0][k]) * (p[3][j] - p[0][j]));
    };
    const double det = minor(0, 1, 2) + minor(1, 2, 0) + minor(2, 0, 1);
    const int sign = (det > 0) - (det < 0);
    std::array<Point, 4> far = p;
    for (Point& q : far) {
      q = {q[0] * 0x1p-40 + 1, q[1] * 0x1p-40 + 3, q[2] * 0x1p-40 - 2};
    }
    CHECK(side_of_plane(p[0], p[1], p[2], p[3]) == sign);
    CHECK(side_of_plane(far[0], far[1], far[2], far[3]) == sign);
    const double area =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    CHECK(side_of_line({far[0][0], far[0][1]}, {far[1][0], far[1][1]}, {far[2][0], far[2][1]}) ==
          (area > 0) - (area < 0));
  }
}

TEST_CASE("corners in the middle of sides do not make a surface cross itself",
          "[mesh][surface_check]") {
  // Two cubes side by side: a body of ten faces, of which those along two cubes are polygons with
  // corners in the middle of their long sides, at any place among their corners.
  for (std::uint32_t turn = 0; turn < 6; ++turn) {
    FileMesh mesh;
    for (int i = 0; i < 12; ++i) {
      mesh.points.push_back({1.0 * (i % 3), 1.0 * (i / 3 % 2), 1.0 * (i / 6)});
    }
    for (std::array<std::uint32_t, 6> face : {std::array<std::uint32_t, 6>{0, 3, 4, 5, 2, 1},
                                              {6, 7, 8, 11, 10, 9},
                                              {0, 1, 2, 8, 7, 6}}) {
      std::ranges::rotate(face, face.begin() + turn);
      append_cell(mesh, CellKind::polygon, face);
    }
    for (const std::array<std::uint32_t, 4>& face :
         {std::array<std::uint32_t, 4>{3, 9, 10, 4}, {4, 10, 11, 5}, {0, 6, 9, 3}, {2, 5, 11, 8}}) {
      append_cell(mesh, CellKind::quad4, face);
    }
    const SurfaceCheck check = check_surface(mesh);
    CHECK(check.findings.empty());
    CHECK(check.crosses_itself == false);
    CHECK(check.volume.value() == Approx(2).epsilon(1e-14));
  }
}

TEST_CASE("where there are no faces nothing is closed and nothing is told",
          "[mesh][surface_check]") {
  FileMesh mesh;
  mesh.points = {{1, 2, 3}};
  const SurfaceCheck check = check_surface(mesh);
  CHECK_FALSE(check.is_closed);
  CHECK(check.findings.empty());
  CHECK((check.vertices == 0 && check.edges == 0 && check.components == 0 && check.area == 0));
}

TEST_CASE("area, volume and centre lose nothing far from the origin", "[mesh][surface_check]") {
  const Point at = {0x1p40, 0x1p41, -0x1p40};
  const SurfaceCheck check = check_surface(cube(2, at));
  CHECK(check.area == Approx(24).epsilon(1e-14));
  CHECK(check.volume.value() == Approx(8).epsilon(1e-14));
  CHECK(check.extent.centre == Point{at[0] + 1, at[1] + 1, at[2] + 1});
}

TEST_CASE("the centre is that of the volume, without one of the area, without that of the box",
          "[mesh][surface_check]") {
  using Faces = std::vector<std::array<std::uint32_t, 3>>;
  const auto checked = [](std::vector<Point> points, const Faces& faces) {
    FileMesh mesh;
    mesh.points = std::move(points);
    mesh.triangles.corners = faces;
    return check_surface(mesh);
  };
  const auto near = [](const Point& a, const Point& b) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(a[k] == Approx(b[k]).margin(1e-14));
  };
  const Faces outward = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const double height : {0.5, 3.0}) {
    const SurfaceCheck solid = checked({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, height}}, outward);
    CHECK(solid.volume.value() == Approx(height / 3));
    if (height == 3) CHECK(solid.volume == 1.0);
    CHECK(solid.findings.empty());
    near(solid.extent.centre, {0.25, 0.5, height / 4});
  }
  const std::vector<Point> half = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  near(checked(half, {{0, 1, 2}}).extent.centre, {1 / 3.0, 1 / 3.0, 0});
  const SurfaceCheck sheets = checked(half, {{0, 1, 2}, {2, 1, 0}});
  CHECK(sheets.is_closed);
  CHECK(sheets.volume == 0.0);
  CHECK(count(sheets, "inside_out") == 0);
  near(sheets.extent.centre, {1 / 3.0, 1 / 3.0, 0});
  // Face 0 lies on a line, exactly; from the middle of the box its corners seem to leave it.
  const SurfaceCheck line = checked(
      {{0, 0, 0}, {1, 3, 7}, {3, 9, 21}, {0.1, 0.7, 0.3}, {-17.3, 3, 5}}, {{0, 1, 2}, {0, 3, 4}});
  REQUIRE(count(line, "flat_face") == 1);
  const SurfaceCheck nothing = checked({{0, 0, 0}, {2, 0, 0}, {6, 0, 0}}, {{0, 1, 2}});
  CHECK(nothing.extent.centre == Point{3, 0, 0});
}

TEST_CASE("copies of faces are told by rows, in whatever order corners and faces stand",
          "[mesh][surface_check]") {
  FileMesh mesh;
  mesh.points = {{1, 1, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {2, 2, 3}, {3, 2, 2}};
  mesh.triangles.corners = {{3, 4, 5}, {0, 1, 2}, {5, 3, 4}, {2, 0, 1}};
  const SurfaceCheck check = check_surface(mesh);
  CHECK(check.vertices == 6);  // the least place of all is not the first point
  const auto found = std::ranges::find(check.findings, "duplicate_face", &Finding::code);
  REQUIRE(found != check.findings.end());
  CHECK(found->ids == std::vector<std::int64_t>{2, 3});
}

TEST_CASE("a face on a line has no area, whatever rounding makes of it", "[mesh][surface_check]") {
  // (t, 3 t, 0) for three t, the first of which is lost to rounding where it is taken from others.
  FileMesh mesh;
  const double t = 3 * 0x1p-54;
  mesh.points = {{t, 3 * t, 0}, {1, 3, 0}, {5, 15, 0}, {-5, -15, 1}, {0, 7, -1}};
  append_cell(mesh, CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  append_cell(mesh, CellKind::triangle, std::array<std::uint32_t, 3>{2, 3, 4});
  const SurfaceCheck check = check_surface(mesh);
  const auto flat = std::ranges::find(check.findings, "flat_face", &Finding::code);
  REQUIRE(flat != check.findings.end());
  CHECK(flat->ids == std::vector<std::int64_t>{0});
}

TEST_CASE("one face may be closed: a polygon forth and back", "[mesh][surface_check]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}};
  CHECK_FALSE(check_surface(mesh).is_closed);
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 4>{0, 1, 2, 1});
  const SurfaceCheck check = check_surface(mesh);
  CHECK((check.is_closed && check.is_oriented));
  CHECK(check.edges == 2);
}

TEST_CASE("a needle has its area, and where areas have no number the centre is the box's",
          "[mesh][surface_check]") {
  // The face without extent puts the middle of the box at the origin.
  FileMesh needle;
  needle.points = {{0, 0, 0}, {1, 0.3, 0.2}, {0.3e-10, 0.7e-10, 0.4e-10}, {-1, -0.3, -0.2}};
  append_cell(needle, CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  append_cell(needle, CellKind::triangle, std::array<std::uint32_t, 3>{3, 3, 3});
  const double a = 0.3 * 0.4 - 0.2 * 0.7, b = 0.2 * 0.3 - 1 * 0.4, c = 1 * 0.7 - 0.3 * 0.3;
  CHECK(check_surface(needle).area ==
        Approx(std::sqrt(a * a + b * b + c * c) / 2 * 1e-10).epsilon(1e-13));
  FileMesh huge;
  huge.points = {{0, 0, 0}, {1e200, 1e120, 0}, {1e200, 2e120, 1}};
  append_cell(huge, CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  const SurfaceCheck check = check_surface(huge);
  CHECK(check.extent.centre == Point{5e199, 1e120, 0.5});
}

TEST_CASE("the centre of tetrahedra is found from the first corner, small as they may be",
          "[mesh][surface_check]") {
  // A first one without volume reaches so far that nothing is left of numbers taken from there.
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1e17, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0}};
  mesh.tetrahedra.corners = {{0, 1, 0, 0}, {0, 4, 2, 3}};
  const std::optional<Extent> extent = extent_of_tetrahedra(mesh);
  REQUIRE(extent);
  CHECK(extent->centre == Point{0.125, 0.125, 0.125});
  CHECK(extent->box.high == Point{1e17, 0.5, 0.5});
}

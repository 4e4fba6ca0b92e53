// SPDX-License-Identifier: MIT
// A file's points, cells and data after operations on its map.
#include "topology/cells/file_cells.hpp"

#include <algorithm>
#include <numeric>

#include "tests/support/built.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/cells/refine.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Doubles = std::vector<double>;
using Whole = std::vector<std::int64_t>;

/// A tetrahedron on each side of the triangle 0 1 2, with the triangle, two edges of it, and a
/// column of every kind.
FileMesh small() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.source_point_id = {10, 20, 30, 40, 50};
  mesh.point_region = {1, 1, 2, 0, 0};
  mesh.point_data = {{"heat", 2, NumberType::float64, Doubles{0, 1, 10, 2, 20, 3, 30, 4, 40, 5}},
                     {"mark", 1, NumberType::int32, Whole{7, 8, 9, 10, 11}}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  mesh.tetrahedra.source_id = {9, 5};
  mesh.tetrahedra.region = {7, 8};
  mesh.tetrahedra.entity = {1, 2};
  mesh.tetrahedra.data = {{"mass", 1, NumberType::float64, Doubles{8, 16}},
                          {"density", 1, NumberType::float64, Doubles{3, 4}},
                          {"axis", 3, NumberType::float64, Doubles{1, 2, 3, 4, 5, 6}},
                          {"kind", 1, NumberType::int32, Whole{3, 4}}};
  mesh.triangles.corners = {{0, 1, 2}};
  mesh.triangles.source_id = {100};
  mesh.triangles.region = {5};
  mesh.edges.corners = {{0, 1}, {2, 3}};
  mesh.edges.region = {2, 3};
  return mesh;
}

VolumeMap map_of(const FileMesh& mesh) {
  FileMesh copy = mesh;
  return built(tet_mesh_of(std::move(copy)));
}

template <class Values>
const Values& column(const std::vector<DataColumn>& columns, const std::string& name) {
  const auto at = std::ranges::find(columns, name, &DataColumn::name);
  REQUIRE(at != columns.end());
  return std::get<Values>(at->values);
}

/// The edge of two points of the file.
CellEdge edge_on(const VolumeMap& map, std::uint32_t a, std::uint32_t b) {
  const EdgeRows rows = edge_rows(map);
  for (const CellEdge& edge : rows.first) {
    const auto corners = map.corners(edge.tetrahedron);
    const auto ends = edge_ends[static_cast<std::size_t>(edge.place)];
    const std::uint32_t p = map.point_of_vertex(corners[ends[0]]);
    const std::uint32_t q = map.point_of_vertex(corners[ends[1]]);
    if (std::minmax(p, q) == std::minmax(a, b)) return edge;
  }
  FAIL("no such edge");
  return {};
}

/// Twice the signed area, seen from above; of triangles in z = 0.
double area(const FileMesh& mesh, std::size_t row) {
  const auto& t = mesh.triangles.corners[row];
  const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace

TEST_CASE("a vertex in an edge of a file: every column by its rule", "[topology][cells]") {
  FileMesh mesh = small();
  VolumeMap map = map_of(mesh);
  const CellEdit edit = insert_vertex(map, edge_on(map, 0, 1), 0.25);
  const DividedFile report = divide_file(mesh, map, std::span(&edit, 1), {"mass"});

  CHECK(report.divided == std::array<std::size_t, 4>{0, 1, 1, 2});
  CHECK(report.numbers_added == 1 + 2 + 1);  // point, tetrahedra, triangle; edges have none
  REQUIRE(mesh.points.size() == 6);
  CHECK(mesh.points[5] == Point{0.25, 0, 0});
  CHECK(mesh.source_point_id == std::vector<std::int64_t>{10, 20, 30, 40, 50, 51});
  CHECK(mesh.point_region == std::vector<std::int32_t>{1, 1, 2, 0, 0, 1});
  const auto& heat = column<Doubles>(mesh.point_data, "heat");
  CHECK(heat[10] == 2.5);
  CHECK(heat[11] == 1.25);
  CHECK(column<Whole>(mesh.point_data, "mark").back() == 7);

  CHECK(mesh.tetrahedra.region == std::vector<std::int32_t>{7, 8, 7, 8});
  CHECK(mesh.tetrahedra.entity == std::vector<std::int32_t>{1, 2, 1, 2});
  CHECK(mesh.tetrahedra.source_id == std::vector<std::int64_t>{9, 5, 10, 11});
  CHECK(column<Doubles>(mesh.tetrahedra.data, "density") == Doubles{3, 4, 3, 4});
  CHECK(column<Doubles>(mesh.tetrahedra.data, "axis") ==
        Doubles{1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6});
  CHECK(column<Whole>(mesh.tetrahedra.data, "kind") == Whole{3, 4, 3, 4});
  const auto& mass = column<Doubles>(mesh.tetrahedra.data, "mass");
  CHECK(mass[0] + mass[2] == 8);
  CHECK(std::max(mass[0], mass[2]) == 6);  // three quarters of the edge
  CHECK(mass[1] + mass[3] == 16);
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(mesh.tetrahedra.corners[t][i] == map.point_of_vertex(map.corners(TetId{t})[i]));
    }
  }

  REQUIRE(mesh.triangles.corners.size() == 2);
  CHECK(area(mesh, 0) > 0);
  CHECK(area(mesh, 1) > 0);
  CHECK(area(mesh, 0) + area(mesh, 1) == 1);
  CHECK(mesh.triangles.region == std::vector<std::int32_t>{5, 5});
  CHECK(mesh.triangles.source_id == std::vector<std::int64_t>{100, 101});
  CHECK(mesh.edges.corners == std::vector<std::array<std::uint32_t, 2>>{{0, 5}, {2, 3}, {5, 1}});
  CHECK(mesh.edges.region == std::vector<std::int32_t>{2, 3, 2});
}

TEST_CASE("a point between two regions has none", "[topology][cells]") {
  FileMesh mesh = small();
  VolumeMap map = map_of(mesh);
  const CellEdit edit = insert_vertex(map, edge_on(map, 1, 2), 0.75);
  divide_file(mesh, map, std::span(&edit, 1));
  CHECK(mesh.point_region.back() == 0);
  CHECK(column<Whole>(mesh.point_data, "mark").back() == 9);  // nearer to point 2
}

TEST_CASE("columns of several numbers are shared by name, whole numbers never",
          "[topology][cells]") {
  FileMesh mesh = small();
  mesh.point_region.clear();
  VolumeMap map = map_of(mesh);
  const CellEdit edit = insert_vertex(map, edge_on(map, 1, 2), 0.5);
  divide_file(mesh, map, std::span(&edit, 1), {"mass", "axis", "kind"});
  CHECK(mesh.point_region.empty());
  CHECK(column<Doubles>(mesh.tetrahedra.data, "mass") == Doubles{4, 8, 4, 8});
  CHECK(column<Doubles>(mesh.tetrahedra.data, "axis") ==
        Doubles{0.5, 1, 1.5, 2, 2.5, 3, 0.5, 1, 1.5, 2, 2.5, 3});
  CHECK(column<Doubles>(mesh.tetrahedra.data, "density") == Doubles{3, 4, 3, 4});
  CHECK(column<Whole>(mesh.tetrahedra.data, "kind") == Whole{3, 4, 3, 4});
  CHECK(column<Doubles>(mesh.point_data, "heat") ==
        Doubles{0, 1, 10, 2, 20, 3, 30, 4, 40, 5, 15, 2.5});
  CHECK(column<Whole>(mesh.point_data, "mark").back() == 8);  // in the middle the first end's
}

TEST_CASE("the region of a point between a higher and a lower one is none", "[topology][cells]") {
  FileMesh mesh = small();
  VolumeMap map = map_of(mesh);
  for (const auto& [a, b] : {std::pair{2U, 3U}, std::pair{0U, 2U}}) {
    const CellEdit edit = insert_vertex(map, edge_on(map, a, b), 0.5);
    divide_file(mesh, map, std::span(&edit, 1));
    CHECK(mesh.point_region.back() == 0);
  }
}

TEST_CASE("two levels and a cut of a file: faces of triangles are faces of tetrahedra",
          "[topology][cells]") {
  FileMesh mesh = small();
  VolumeMap map = map_of(mesh);
  std::vector<CellEdit> edits;
  for (RefinedLevel& level :
       refine(map, 2, [](const VolumeMap&m, TetId t, TetId) {  // red, and green next to it
         return m.point(m.corners(t)[0])[2] + m.point(m.corners(t)[3])[2] > 0.7;
       })) {
    edits.push_back(std::move(level.edit));
  }
  auto cut = cut_cells(map, {{2, 1, 0.3}, 0.61});
  REQUIRE(cut);
  edits.push_back(std::move(cut->edit));
  divide_file(mesh, map, edits, {"mass"});
  REQUIRE(mesh.triangles.corners.size() > 8);
  double sum = 0;
  for (std::size_t row = 0; row < mesh.triangles.corners.size(); ++row) {
    CHECK(area(mesh, row) > 0);
    sum += area(mesh, row);
    const HalfFaceId face = face_on(map, mesh.triangles.corners[row]);
    REQUIRE_FALSE(face.is_none());
    CHECK_FALSE(map.neighbour(face).is_none());
  }
  CHECK(sum == Approx(1).epsilon(1e-14));
  const auto& mass = column<Doubles>(mesh.tetrahedra.data, "mass");
  CHECK(std::accumulate(mass.begin(), mass.end(), 0.0) == Approx(24).epsilon(1e-14));
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {  // both had a sixth of a cube
    double six = 0;
    std::array<Point, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.points[mesh.tetrahedra.corners[t][i]];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      six += (x[1][i] - x[0][i]) * ((x[2][j] - x[0][j]) * (x[3][k] - x[0][k]) -
                                    (x[2][k] - x[0][k]) * (x[3][j] - x[0][j]));
    }
    CHECK(mass[t] == Approx(mesh.tetrahedra.region[t] == 7 ? 8 * six : 16 * six).margin(1e-13));
  }
}

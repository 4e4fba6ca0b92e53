// SPDX-License-Identifier: MIT
// A file's contents as a mesh to compute with, and back; its counts and labels.
#include "topology/mesh/file_mesh.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

using Labels = std::vector<std::int32_t>;
using Numbers = std::vector<std::int64_t>;

FileMesh two_with_all() {
  FileMesh file = file_mesh_of(suite::two_tetrahedra());
  file.vertices.corners = {{3}};
  file.edges.corners = {{0, 1}, {1, 2}};
  file.triangles.corners = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
  file.region_name[1] = {{1, "an edge"}};
  file.region_name[2] = {{1, "one side"}, {2, "another"}};
  file.region_name[3] = {{7, "left"}, {8, "right"}, {9, "none"}};
  return file;
}

}  // namespace

TEST_CASE("cells and names of all dimensions are counted", "[mesh][file_mesh]") {
  CHECK(cell_count(two_with_all()) == 1 + 2 + 4 + 2);
  CHECK(name_count(two_with_all()) == 1 + 2 + 3);
  CHECK(cell_count(FileMesh{}) == 0);
  CHECK(name_count(FileMesh{}) == 0);
}

TEST_CASE("a label is the region, or the entity where there are several", "[mesh][file_mesh]") {
  CellList<4> cells;
  CHECK(label_of(cells).empty());
  cells.entity = {4, 4, 4};
  CHECK(label_of(cells).empty());
  for (const Labels& several : {Labels{4, 4, 5}, Labels{4, 3, 4}}) {
    cells.entity = several;
    CHECK(label_of(cells) == several);
  }
  cells.region = {1, 1, 1};
  CHECK(label_of(cells) == Labels{1, 1, 1});
}

TEST_CASE("a file's tetrahedra keep points, labels, names and numbers", "[mesh][file_mesh]") {
  FileMesh file = two_with_all();
  file.source_point_id = {5, 6, 7, 8, 9};
  file.tetrahedra.region = {7, 8};
  file.tetrahedra.source_id = {30, 20};
  const FileMesh before = file;
  const TetMesh mesh = tet_mesh_of(std::move(file));
  CHECK(mesh.points == before.points);
  CHECK(mesh.tetrahedra == before.tetrahedra.corners);
  CHECK(mesh.region == Labels{7, 8});
  CHECK(mesh.region_name == before.region_name[3]);
  CHECK(mesh.source_point_id == before.source_point_id);
  CHECK(mesh.source_tetrahedron_id == Numbers{30, 20});
  const FileMesh back = file_mesh_of(mesh);
  CHECK(back.points == before.points);
  CHECK(back.tetrahedra == before.tetrahedra);
  CHECK(back.source_point_id == before.source_point_id);
  CHECK(back.region_name[3] == before.region_name[3]);
  CHECK(back.triangles.corners.empty());
}

TEST_CASE("numbers of tetrahedra that count on from other cells stay the file's own",
          "[mesh][file_mesh]") {
  // Triangles 8 and 9 are dropped; without the numbers 10 and 11 nobody could find the tetrahedra
  // in the file.
  FileMesh file = file_mesh_of(suite::two_tetrahedra());
  file.triangles.corners = {{0, 1, 2}, {0, 1, 3}};
  file.triangles.source_id = {8, 9};
  file.tetrahedra.source_id = {10, 11};
  CHECK(tet_mesh_of(FileMesh(file)).source_tetrahedron_id == Numbers{10, 11});
  file.triangles.source_id = {1, 2};
  file.tetrahedra.source_id = {3, 4};
  CHECK(tet_mesh_of(std::move(file)).source_tetrahedron_id == Numbers{3, 4});
}

TEST_CASE("simplices are gone through by dimension, cells of a kind by their nodes",
          "[mesh][file_mesh]") {
  FileMesh mesh = two_with_all();
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 3>{4, 1, 2});
  append_cell(mesh, CellKind::quad4, std::array<std::uint32_t, 4>{3, 2, 1, 0});
  std::vector<std::array<std::size_t, 2>> met;
  for_each_cell_list(mesh, [&](const auto& cells, int dimension) {
    met.push_back({static_cast<std::size_t>(dimension), cells.corners.size()});
  });
  CHECK(met == std::vector<std::array<std::size_t, 2>>{{0, 1}, {1, 2}, {2, 4}, {3, 2}});
  CHECK(rows_of(mesh, CellKind::polygon).size() == 2);
  CHECK(rows_of(mesh, CellKind::quad4).size() == 1);
  CHECK(rows_of(mesh, CellKind::polygon)[1].size() == 3);
  CHECK(std::ranges::equal(nodes_of(mesh, CellKind::polygon),
                           std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 4, 1, 2}));
  CHECK(std::ranges::equal(nodes_of(mesh, CellKind::quad4),
                           std::array<std::uint32_t, 4>{3, 2, 1, 0}));
  CHECK(other_cells(mesh, CellKind::quad4).ends.empty());
  CHECK(CellRows{}.size() == 0);
  CHECK(CellRows{}.nodes == 0);
  CHECK(DataColumn{}.components == 1);
}

TEST_CASE(
    "a set of kinds has those that it was made of, and names the nearest that it has below one",
    "[mesh][file_mesh]") {
  const std::initializer_list<CellKind> some = {CellKind::tetrahedron, CellKind::hexahedron20,
                                                CellKind::triangle6, CellKind::vertex};
  KindSet set = kind_set(some);
  for (const CellKind kind : all_cell_kinds) {
    CHECK(contains(set, kind) == (std::ranges::find(some, kind) != some.end()));
  }
  CHECK(held_kind(set, CellKind::hexahedron27) == CellKind::hexahedron20);
  CHECK(held_kind(set, CellKind::hexahedron20) == CellKind::hexahedron20);
  CHECK(held_kind(set, CellKind::hexahedron8) == CellKind::hexahedron8);
  CHECK(held_kind(set, CellKind::tetrahedron10) == CellKind::tetrahedron);
  CHECK(held_kind(set, CellKind::triangle7) == CellKind::triangle6);
  CHECK(held_kind(set, CellKind::prism18) == CellKind::prism18);
}

TEST_CASE("labels that are all nought are dropped, others stay", "[mesh][file_mesh]") {
  CellColumns cells;
  cells.region = {-1, 0};
  cells.entity = {0, 0};
  cells.source_id = {0, 0};
  drop_filling(cells);
  CHECK(cells.region == Labels{-1, 0});
  CHECK(cells.entity.empty());
  CHECK(cells.source_id.empty());
}

TEST_CASE("rows of polygons tell where each ends, and no number of nodes", "[mesh][file_mesh]") {
  FileMesh mesh;
  CHECK(rows_of(mesh, CellKind::polygon).count == 0);
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 3>{7, 6, 5});
  const CellRows rows = rows_of(mesh, CellKind::polygon);
  CHECK(rows.nodes == 0);
  REQUIRE(rows.count == 2);
  CHECK(std::ranges::equal(rows[0], std::array<std::uint32_t, 5>{0, 1, 2, 3, 4}));
  CHECK(std::ranges::equal(rows[1], std::array<std::uint32_t, 3>{7, 6, 5}));
  CHECK(nodes_of(mesh, CellKind::polygon).size() == 8);
}

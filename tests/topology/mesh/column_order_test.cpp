// SPDX-License-Identifier: MIT
// The order of data columns over all kinds of cells.
#include "topology/mesh/kinds/column_order.hpp"

#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

std::vector<DataColumn> columns(const std::string& names) {
  std::vector<DataColumn> list;
  for (const char name : names) {
    list.push_back({std::string(1, name), 1, NumberType::float64, std::vector<double>{0.5}});
  }
  return list;
}

FileMesh mesh_of(const std::string& edges, const std::string& triangles,
                 const std::string& tetrahedra) {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.edges.corners = {{0, 1}};
  mesh.triangles.corners = {{0, 1, 2}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}};
  mesh.edges.data = columns(edges);
  mesh.triangles.data = columns(triangles);
  mesh.tetrahedra.data = columns(tetrahedra);
  return mesh;
}

std::string order_of(const FileMesh& mesh) {
  std::string names;
  for (const DataColumn* column : ordered_cell_columns(mesh)) names += column->name;
  return names;
}

}  // namespace

TEST_CASE("columns of all kinds stand in each kind's own order", "[mesh][columns]") {
  CHECK(order_of(mesh_of("", "", "")).empty());
  CHECK(order_of(mesh_of("ab", "ab", "adb")) == "adb");
  CHECK(order_of(mesh_of("ab", "c", "ac")) == "abc");
  CHECK(order_of(mesh_of("ab", "ca", "cb")) == "cab");
  CHECK(order_of(mesh_of("ad", "bd", "cbad")) == "cbad");
  // No order is that of all three: none is lost.
  CHECK(order_of(mesh_of("ab", "bc", "ca")) == "abc");
}

TEST_CASE("columns that only some kinds have come back in their order", "[io][columns]") {
  const FileMesh mesh = mesh_of("ab", "cab", "cadb");
  const Folder folder;
  for (const char* name : {"a.vtk", "a.vtu", "a.msh"}) {
    INFO(name);
    CHECK(write_file_mesh(folder.path() / name, mesh).empty());
    const auto back = read_file_mesh(folder.path() / name);
    REQUIRE(back);
    CHECK(back->edges.data == mesh.edges.data);
    CHECK(back->triangles.data == mesh.triangles.data);
    CHECK(back->tetrahedra.data == mesh.tetrahedra.data);
  }
}

// SPDX-License-Identifier: MIT
// MEDIT: files of Gmsh and meshio, sections in any order, comments.
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("Gmsh's and meshio's MEDIT files hold the two boxes", "[io][medit]") {
  const auto* const name = GENERATE("gmsh.mesh", "meshio.mesh");
  const Result<TetMesh> mesh = read_mesh(sample(name));
  INFO(name << ": " << summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 23);
  CHECK(mesh->tetrahedra.size() == 48);
  CHECK(volume(*mesh) == Approx(1.7).epsilon(1e-12));  // 48 sums of volumes near 0.04
}

TEST_CASE("references of tetrahedra become regions, unless all are 0", "[io][medit]") {
  const std::string head =
      "MeshVersionFormatted 2 # comment\nDimension 3\n# another\nTetrahedra 2\n1 2 3 4 ";
  const std::string tail = "\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\nEnd\n";
  const Result<TetMesh> plain = read_mesh(head + "0\n2 3 4 5 0" + tail, "a.mesh");
  REQUIRE(plain);
  CHECK(plain->region.empty());
  const Result<TetMesh> mesh = read_mesh(head + "0\n2 3 4 5 9" + tail, "a.mesh");
  REQUIRE(mesh);
  CHECK(mesh->region == std::vector<std::int32_t>{0, 9});
  CHECK(mesh->tetrahedra[1] == std::array<std::uint32_t, 4>{1, 2, 3, 4});
}

TEST_CASE("sections that are not used are passed over and reported", "[io][medit]") {
  const Result<TetMesh> mesh = read_mesh(
      "MeshVersionFormatted 1\nDimension\n3\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n"
      "Corners 2\n1 2\nNormals 1\n0 0 1\nTriangles 1\n1 2 3 4\nFancyThings 2\n1 2 3\n4.5 -6 7\n"
      "Tetrahedra 1\n1 2 3 4 1\n",
      "a.mesh");
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "note skipped_cells 0, note skipped_data 10");
  CHECK(mesh.findings[1].text == "sections are left out: Corners, Normals, FancyThings");
  CHECK(mesh.findings[1].count == 4);
}

TEST_CASE("MEDIT to MSH to memory keeps what MEDIT carries", "[io][medit][round_trip]") {
  const Result<TetMesh> mesh = read_mesh(sample("gmsh.mesh"));
  REQUIRE(mesh);
  const Folder folder;
  CHECK(write_mesh(folder.path() / "a.msh", *mesh).empty());
  CHECK(identical(*mesh, *read_mesh(folder.path() / "a.msh")));
  CHECK(write_mesh(folder.path() / "a.vtu", *mesh).empty());
  CHECK(identical(*mesh, *read_mesh(folder.path() / "a.vtu")));
  CHECK(write_mesh(folder.path() / "a.mesh", *mesh).empty());
  CHECK(identical(*mesh, *read_mesh(folder.path() / "a.mesh")));
}

TEST_CASE("a planar mesh lies at z = 0, in text and binary", "[io][medit]") {
  const std::string text =
      "MeshVersionFormatted 1\nDimension 2\nVertices\n3\n0 0 0\n1 0 5\n0.5 2 0\nNormals 1\n0 1\n"
      "Triangles\n1\n1 2 3 4\nEnd\n";
  std::string binary;
  const auto put = [&binary](auto... numbers) {
    (binary.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  };
  put(1, 2, 3, 20, 2);
  put(4, 92, 3, 0.0, 0.0, 0, 1.0, 0.0, 5, 0.5, 2.0, 0);
  put(6, 120, 1, 1, 2, 3, 4);
  put(54, 0);
  REQUIRE(binary.size() == 128);
  for (const std::string& file : {text, binary}) {
    const Result<FileMesh> mesh = read_file_mesh(file, "a.mesh");
    INFO(summary(mesh.findings));
    REQUIRE(mesh);
    CHECK(mesh->points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0.5, 2, 0}});
    CHECK(mesh->point_region == std::vector<std::int32_t>{0, 5, 0});
    CHECK(mesh->triangles.region == std::vector<std::int32_t>{4});
    CHECK(mesh.findings.size() == (file == text ? 1 : 0));
  }
}

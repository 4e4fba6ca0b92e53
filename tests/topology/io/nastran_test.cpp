// SPDX-License-Identifier: MIT
// Nastran's bulk data: files of gmsh and meshio, the kinds of fields, refused and kept contents.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

FileMesh read_whole(const std::string& text) { return test::read_whole(text, "a.bdf"); }

const std::string points =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";

/// The largest distance of a node of second order from the middle of its edge; corners, edges as
/// VTK numbers them.
double largest_bend(const FileMesh& mesh, CellKind kind,
                    const std::vector<std::array<std::size_t, 2>>& edges) {
  double largest = 0;
  const CellRows rows = rows_of(mesh, kind);
  const std::size_t corners = traits_of(kind).corners;
  for (std::size_t i = 0; i < rows.count; ++i) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = [&](std::size_t node) { return mesh.points[rows[i][node]][k]; };
        const double middle = (at(edges[e][0]) + at(edges[e][1])) / 2;
        largest = std::max(largest, std::abs(at(corners + e) - middle));
      }
    }
  }
  return largest;
}

const std::vector<std::array<std::size_t, 2>> tetrahedron_edges = {{0, 1}, {1, 2}, {2, 0},
                                                                   {0, 3}, {1, 3}, {2, 3}};
const std::vector<std::array<std::size_t, 2>> hexahedron_edges = {
    {0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
const std::vector<std::array<std::size_t, 2>> prism_edges = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                                             {5, 3}, {0, 3}, {1, 4}, {2, 5}};

}  // namespace

TEST_CASE("gmsh's and meshio's bulk data hold the mesh they were made from", "[io][nastran]") {
  const auto* const name = GENERATE("gmsh_free.bdf", "gmsh_small.bdf", "gmsh_large.bdf",
                                    "meshio_small.nas", "meshio_large.nas");
  const Result<FileMesh> mesh = read_file_mesh(sample(name));
  INFO(name << ": " << summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  const Result<FileMesh> source = read_file_mesh(sample("gmsh_41.msh"));
  REQUIRE(source);
  CHECK(mesh->points == source->points);
  CHECK(mesh->tetrahedra.corners == source->tetrahedra.corners);
  CHECK(mesh->triangles.corners == source->triangles.corners);
  if (!std::string(name).starts_with("gmsh")) return;
  CHECK(mesh->tetrahedra.region == source->tetrahedra.region);
  CHECK(mesh->triangles.region == source->triangles.region);
}

TEST_CASE("nodes of second order lie on their edges, whoever wrote them", "[io][nastran][unv]") {
  for (const char* name : {"gmsh_2nd.bdf", "gmsh_2nd.unv", "meshio_2nd.nas"}) {
    const Result<FileMesh> mesh = read_file_mesh(sample(name));
    INFO(name << ": " << summary(mesh.findings));
    REQUIRE(mesh);
    CHECK(rows_of(*mesh, CellKind::tetrahedron10).count == 48);
    CHECK(largest_bend(*mesh, CellKind::tetrahedron10, tetrahedron_edges) < 1e-6);
  }
  for (const char* ending : {".bdf", ".unv"}) {
    const Result<FileMesh> block = read_file_mesh(sample(std::string("gmsh_block_2") + ending));
    INFO(ending << ": " << summary(block.findings));
    REQUIRE(block);
    CHECK(rows_of(*block, CellKind::hexahedron20).count == 2);
    CHECK(largest_bend(*block, CellKind::hexahedron20, hexahedron_edges) < 1e-6);
    CHECK(rows_of(*block, CellKind::quad8).count == 1);
    CHECK(largest_bend(*block, CellKind::quad8, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}) < 1e-6);
    const Result<FileMesh> prisms = read_file_mesh(sample(std::string("gmsh_prisms_2") + ending));
    REQUIRE(prisms);
    CHECK(rows_of(*prisms, CellKind::prism15).count == 4);
    CHECK(largest_bend(*prisms, CellKind::prism15, prism_edges) < 1e-6);
  }
}

TEST_CASE("hexahedra, prisms, quadrilaterals and beams have their properties", "[io][nastran]") {
  const Result<FileMesh> block = read_file_mesh(sample("gmsh_block_1.bdf"));
  REQUIRE(block);
  CHECK(rows_of(*block, CellKind::hexahedron8).count == 2);
  CHECK(columns_of(*block, CellKind::hexahedron8).region == std::vector<std::int32_t>{5, 5});
  CHECK(columns_of(*block, CellKind::quad4).region == std::vector<std::int32_t>{6});
  CHECK(block->edges.region == std::vector<std::int32_t>{8, 8});
  const Result<FileMesh> prisms = read_file_mesh(sample("gmsh_prisms_1.bdf"));
  REQUIRE(prisms);
  CHECK(rows_of(*prisms, CellKind::prism6).count == 4);
}

TEST_CASE("a card may be written in any of Nastran's ways", "[io][nastran]") {
  const FileMesh expected = read_whole(points + "CTETRA,7,3,1,2,3,4\n");
  CHECK(expected.tetrahedra.region == std::vector<std::int32_t>{3});
  CHECK(expected.tetrahedra.source_id == std::vector<std::int64_t>{7});
  const std::string ways[] = {
      "ctetra,7,3,1,2,3,4\n",
      "CTETRA, 7 , 3 ,1,2,3,4 $ a comment\n",
      "CTETRA  7       3       1       2       3       4\n",
      "$ before\n\nCTETRA         7       3       1       2       3       4       \r\n",
      "CTETRA* 7               3               1               2\n*       3               4\n",
      "CTETRA* 7               3               1               2               *A\n"
      "*A      3               4\n",
      "CTETRA*,7,3,1,2\n*,3,4\n",
      "CTETRA,7,3,1,2,3,4,,,+1\n+1,,\n",
      "CTETRA4 7       3       1       2       3       4\n",
  };
  for (const std::string& way : ways) CHECK(read_whole(points + way) == expected);
  // Bulk data stand in any order, behind whatever comes before them, up to their end.
  CHECK(read_whole("CTETRA,7,3,1,2,3,4\n" + points) == expected);
  CHECK(read_whole("SOL 101\nCEND\nTITLE = GRID,9\nBEGIN BULK\n" + points +
                   "CTETRA,7,3,1,2,3,4\nENDDATA\nnothing,at,all\n") == expected);
}

TEST_CASE("reals are Nastran's", "[io][nastran]") {
  const std::string ways[] = {"1.5-3", "1.5E-3", "1.5D-3", ".15-2", "+1.5-3", "0.0015", "15.-4"};
  for (const std::string& way : ways) {
    const FileMesh mesh = read_whole("GRID,1,," + way + ",-2.5+2\nGRID,2\n");
    CHECK(mesh.points[0] == Point{0.0015, -250, 0});
  }
}

TEST_CASE("what Nastran's reader does not take is named", "[io][nastran]") {
  struct Defect {
    std::string text, code;
    std::size_t line;
    std::string says;
  };
  const Defect defects[] = {
      {"CTETRA,1,1,1,2,3,4\n", "missing_section", 2, "without points"},
      {points + "GRID,3,,1.,1.,1.\n", "duplicate_id", 5, "same number 3"},
      {points + "GRID,x\n", "bad_number", 5, "'x' stands in field 2 of a card 'GRID'"},
      {points + "GRID,5,,1.0e\n", "bad_number", 5, "'1.0e'"},
      {points + "GRID,5,,1.+999\n", "number_out_of_range", 5, "1.+999"},
      {points + "GRID,5,3,1.\n", "unsupported_keyword", 5, "coordinate system 3"},
      {points + "CTETRA,7,3,1,2,3\n", "wrong_count", 5, "3 of its 4 nodes"},
      {points + "CTETRA,7,3,1,2,3,9\n", "index_out_of_range", 5, "point 9"},
      {points + "CTETRA,7,3,1,2,3,3\n", "repeated_vertex", 5, "1 2 3 3"},
      {points + "CTETRA,7,-1,1,2,3,4\n", "number_out_of_range", 5, "property -1"},
      {points + "GRID,5,1,2,3,4,5,6,7,8,9,10\n", "wrong_count", 5, "field"},
      {points + "INCLUDE 'more.bdf'\n", "missing_file", 5, "'more.bdf'"},
      {points + "INCLUDE\n", "bad_keyword", 5, "names no file"},
  };
  for (const Defect& d : defects) {
    const Result<FileMesh> mesh = read_file_mesh(d.text, "a.bdf");
    INFO(d.text << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    INFO(mesh.findings[0].text);
    CHECK(mesh.findings[0].code == d.code);
    CHECK(mesh.findings[0].line == d.line);
    CHECK(mesh.findings[0].text.find(d.says) != std::string::npos);
  }
}

TEST_CASE("cards that hold no mesh are listed, elements of no kind of ours are left out",
          "[io][nastran]") {
  const Result<FileMesh> mesh =
      read_file_mesh("SOL 101\nCEND\nBEGIN BULK\nMAT1,1,2.1+11\nPSOLID,1,1\n" + points +
                         "CTETRA,7,3,1,2,3,4\nCELAS1,8,3,1,1\nRBE2,9,1,123,2,3\nCELAS1,10,3,1,1\n",
                     "a.dat");
  REQUIRE(mesh);
  std::string said;
  for (const Finding& f : mesh.findings) said += f.text + "\n";
  CHECK(said.find("cards are left out: MAT1, PSOLID") != std::string::npos);
  CHECK(said.find("lines before BEGIN BULK are left out: SOL") != std::string::npos);
  CHECK(said.find("2 elements CELAS1, 1 element RBE2 are left out") != std::string::npos);
}

TEST_CASE("a midpoint that is left blank leaves the corners, and that is told", "[io][nastran]") {
  std::string text = points;
  for (int i = 5; i <= 10; ++i) text += "GRID," + std::to_string(i) + ",,0.1,0.2,0.3\n";
  const FileMesh whole = read_whole(text + "CTETRA,1,1,1,2,3,4,5,6,+\n+,7,8,9,10\n");
  CHECK(rows_of(whole, CellKind::tetrahedron10).count == 1);
  const Result<FileMesh> part =
      read_file_mesh(text + "CTETRA,1,1,1,2,3,4,5,,+\n+,7,8,9,10\n", "a.bdf");
  REQUIRE(part);
  CHECK(part->tetrahedra.corners.size() == 1);
  REQUIRE(part.findings.size() == 1);
  CHECK(part.findings[0].text == "1 tetrahedron without some midpoints is read by its corners");
}

TEST_CASE("files are included in their folder, and once", "[io][nastran]") {
  const Folder folder;
  const auto put = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
  };
  put("main.bdf",
      "SOL 101\nCEND\nBEGIN BULK\nINCLUDE 'points.inc'\nCTETRA,7,3,1,2,3,4\n"
      "include \"more.inc\"\nENDDATA\n");
  put("points.inc", points);
  put("more.inc", "CTETRA,8,3,2,1,3,4\n");
  const Result<FileMesh> mesh = read_file_mesh(folder.path() / "main.bdf");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.corners.size() == 2);
  put("more.inc", "CTETRA,8,3,2,1,3\n");
  const Result<FileMesh> bad = read_file_mesh(folder.path() / "main.bdf");
  REQUIRE_FALSE(bad);
  CHECK(bad.findings[0].file == (folder.path() / "more.inc").string());
  CHECK(bad.findings[0].line == 1);
  put("more.inc", "INCLUDE 'main.bdf'\n");
  CHECK(read_file_mesh(folder.path() / "main.bdf").findings[0].code == "include_cycle");
  put("more.inc", "INCLUDE '../main.bdf'\n");
  CHECK(read_file_mesh(folder.path() / "main.bdf").findings[0].code == "outside_folder");
}

TEST_CASE("Nastran's coordinates have sixteen characters, and what they lose is told",
          "[io][nastran]") {
  const Folder folder;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  const auto path = folder.path() / "a.bdf";
  mesh.points[0] = {-1e-300, 1234567890123.5, -0.0};
  mesh.points[1] = {1. / 3, -2. / 3e7, 4e22 / 3};
  const std::vector<Finding> findings = write_file_mesh(path, mesh);
  const auto told = std::ranges::find(findings, "coordinates_rounded", &Finding::code);
  REQUIRE(told != findings.end());
  const Result<FileMesh> back = read_file_mesh(path);
  REQUIRE(back);
  CHECK(back->points[0] == mesh.points[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(back->points[1][k] == Approx(mesh.points[1][k]).epsilon(1e-9));
  }
  CHECK(back->tetrahedra == mesh.tetrahedra);
  CHECK(back->region_name == mesh.region_name);  // from the separate list
  // A second time nothing is lost.
  CHECK(std::ranges::none_of(write_file_mesh(path, *back),
                             [](const Finding& f) { return f.severity != Severity::note; }));
  CHECK(*read_file_mesh(path) == *back);
}

TEST_CASE("a mesh without regions comes back from Nastran without", "[io][nastran]") {
  const Folder folder;
  const auto path = folder.path() / "a.bdf";
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {1, 0, 2, 3}};
  for (const std::vector<std::int32_t>& region :
       {std::vector<std::int32_t>{}, {1, 1}, {0, 1}, {2, 0}}) {
    mesh.tetrahedra.region = region;
    REQUIRE(write_file_mesh(path, mesh).empty());
    CHECK(*read_file_mesh(path) == mesh);
    CHECK(bytes_of(path).find("CTETRA  1       0 ") == std::string::npos);
  }
  mesh.tetrahedra.region = {-1, 100'000'000};
  const std::vector<Finding> told = write_file_mesh(path, mesh);
  REQUIRE(told.size() == 1);
  CHECK(told[0].code == "regions_lost");
  CHECK(told[0].count == 2);
}

// SPDX-License-Identifier: MIT
// VTK's PolyData, legacy and XML: lists of cells, parts of strips and polylines with their data.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const std::string head =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\n";

std::string vtp(const std::string& counts, const std::string& lists) {
  return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"4\" " + counts +
         "><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">"
         "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>" +
         lists + "</Piece></PolyData></VTKFile>";
}

}  // namespace

TEST_CASE("VTK's own PolyData are read alike from every kind of file", "[io][vtk][vtp]") {
  const auto* const name =
      GENERATE("vtk_polydata_42.vtk", "vtk_polydata_42_binary.vtk", "vtk_polydata_51.vtk",
               "vtk_polydata_51_binary.vtk", "vtk_ascii.vtp", "vtk_base64.vtp", "vtk_raw.vtp");
  const Result<FileMesh> mesh = read_file_mesh(sample(name));
  INFO(name << ": " << summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->points.size() == 12);
  CHECK(mesh->points[5][1] == Approx(1. / 7));
  using Rows = std::vector<std::int32_t>;
  // A vertex, and two of a poly-vertex; an edge, and two of a polyline.
  CHECK(mesh->vertices.corners == decltype(mesh->vertices.corners){{0}, {3}, {7}});
  CHECK(mesh->vertices.region == Rows{10, 11, 11});
  CHECK(mesh->edges.corners == decltype(mesh->edges.corners){{0, 1}, {1, 2}, {2, 3}});
  CHECK(mesh->edges.region == Rows{12, 13, 13});
  // Two triangles, two of a strip with the second one turned, one of another.
  CHECK(mesh->triangles.corners == decltype(mesh->triangles.corners){
                                       {0, 1, 4}, {1, 5, 4}, {7, 6, 11}, {11, 6, 10}, {8, 4, 9}});
  CHECK(mesh->triangles.region == Rows{14, 15, 18, 18, 19});
  CHECK(columns_of(*mesh, CellKind::quad4).region == Rows{16});
  CHECK(columns_of(*mesh, CellKind::polygon).region == Rows{17});
  REQUIRE(mesh->triangles.data.size() == 1);
  CHECK(std::get<0>(mesh->triangles.data[0].values) ==
        std::vector<double>{12, 13, 14, 15, 16, 17, 24, 25, 26, 24, 25, 26, 27, 28, 29});
  REQUIRE(mesh->point_data.size() == 1);
  CHECK(mesh->point_data[0].name == "height");
}

TEST_CASE("lists of PolyData stand in any order, and may be missing", "[io][vtk][vtp]") {
  const auto read = [](const std::string& text, const std::string& name) {
    const Result<FileMesh> mesh = read_file_mesh(text, name);
    INFO(text << summary(mesh.findings));
    REQUIRE(mesh);
    return *mesh;
  };
  const FileMesh mesh =
      read(head +
               "POLYGONS 1 4\n3 0 1 2\nLINES 1 3\n2 0 3\nCELL_DATA 2\nSCALARS d double\n"
               "LOOKUP_TABLE default\n5 7\n",
           "a.vtk");
  CHECK(std::get<0>(mesh.edges.data[0].values) == std::vector<double>{5});
  CHECK(std::get<0>(mesh.triangles.data[0].values) == std::vector<double>{7});
  CHECK(read(head, "a.vtk").points.size() == 4);
  CHECK(read(vtp("", ""), "a.vtp").points.size() == 4);
}

TEST_CASE("defects of PolyData are named", "[io][vtk][vtp]") {
  struct Defect {
    std::string text, code, says;
  };
  std::string strip = "TRIANGLE_STRIPS 1 2001\n2000";
  for (int i = 0; i < 2000; ++i) strip += " " + std::to_string(i % 3);
  std::string columns = "TRIANGLE_STRIPS 1 1001\n1000";
  for (int i = 0; i < 1000; ++i) columns += " " + std::to_string(i % 3);
  columns += "\nCELL_DATA 1\nFIELD f 1\nd 40 1 double\n";
  for (int i = 0; i < 40; ++i) columns += "1 ";
  const Defect defects[] = {
      {head + "POLYGONS 1 4\n3 0 1 9\n", "index_out_of_range", "point 9"},
      {head + "POLYGONS 1 4\n4 0 1 2\n", "wrong_count", "begins at number 0"},
      {head + "POLYGONS 1 4\n3 0 1 2\nPOLYGONS 1 4\n3 0 1 2\n", "wrong_section_order", "a second"},
      {head + "POINT_DATA 4\nPOLYGONS 1 4\n3 0 1 2\n", "wrong_section_order", "behind data"},
      {head + "CELLS 1 4\n3 0 1 2\n", "unknown_section", "CELLS"},
      {head + "POLYGONS 1 4\n3 0 1 2\nCELL_DATA 2\nSCALARS d double\n", "wrong_count",
       "the file has 1"},
      {"# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "missing_section", "POINTS"},
      {head + strip + "\n", "count_too_big", "1997 parts on 4 points"},
      {head + columns + "\n", "count_too_big", "too many"},
      {vtp("NumberOfPolys=\"1\"", ""), "missing_array", "offsets"},
      {vtp("NumberOfPolys=\"1\"",
           "<Polys><DataArray type=\"Int32\" Name=\"connectivity\"></DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\">-3</DataArray></Polys>"),
       "bad_offsets", "must not fall"},
  };
  for (const Defect& d : defects) {
    const Result<FileMesh> mesh =
        read_file_mesh(d.text, d.text.starts_with('<') ? "a.vtp" : "a.vtk");
    INFO(d.text.substr(0, 400) << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    INFO(mesh.findings[0].text);
    CHECK(mesh.findings[0].code == d.code);
    CHECK(mesh.findings[0].text.find(d.says) != std::string::npos);
  }
}

TEST_CASE("a body's boundary goes to VTP and comes back", "[io][vtp]") {
  const Folder folder;
  const auto path = folder.path() / "a.vtp";
  const Result<FileMesh> body = read_file_mesh(sample("gmsh_block_1.unv"));
  REQUIRE(body);
  for (const WriteOptions& way :
       {WriteOptions{}, WriteOptions{.encoding = Encoding::text},
        WriteOptions{.encoding = Encoding::base64}, WriteOptions{.pack = true}}) {
    CHECK_FALSE(has_error(write_file_mesh(path, *body, way)));
    const Result<FileMesh> surface = read_file_mesh(path);
    INFO(summary(surface.findings));
    REQUIRE(surface);
    CHECK(rows_of(*surface, CellKind::quad4).count == 10);
    CHECK(surface->points.size() == 12);
  }
}

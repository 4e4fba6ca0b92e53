// SPDX-License-Identifier: MIT
// Every reader reports the data it leaves out, at their line; comments and repeated data it does
// not report.
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Text and line of the findings skipped_data.
std::string skipped(const std::string& text, const std::string& name) {
  const Result<FileMesh> mesh = read_file_mesh(text, name);
  INFO(text << summary(mesh.findings));
  for (const Finding& f : mesh.findings) UNSCOPED_INFO(f.text);
  REQUIRE(mesh);
  std::string said;
  for (const Finding& f : mesh.findings) {
    if (f.code != "skipped_data") continue;
    CHECK(f.severity == Severity::warning);
    said += std::to_string(f.line) + " " + f.text + "\n";
  }
  return said;
}

const std::string ply_points =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string vtk_head =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
const std::string medit_head =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
    "Triangles\n1\n1 2 3 0\n";
const std::string abaqus_head = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n*ELEMENT,TYPE=S3\n1,1,2,3\n";
const std::string nastran_head =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nCTRIA3,1,,1,2,3\n";
const std::string obj_head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace

TEST_CASE("content that no mesh holds is reported by every reader", "[io][skipped]") {
  struct Case {
    std::string name, text, said;
  };
  const Case cases[] = {
      {"a.ply",
       "ply\nformat ascii 1.0\n" + ply_points +
           "element camera 1\nproperty int k\n"
           "end_header\n0 0 0\n1 0 0\n0 1 0\n7\n",
       "7 elements are left out: camera\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nauthor me\nscale 2\n" + ply_points +
           "end_header\n0 0 0\n1 0 0\n0 1 0\n",
       "3 unknown lines of the header are left out: author, scale\n"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.5\n",
       "6 colours of faces are left out\n"},
      {"a.off", "NSTOFF\n3 1 0\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 0 0\n0 1 0 0 0 1 0 0\n3 0 1 2\n",
       "3 data of points are left out: normals, texture coordinates\n"},
      {"a.obj", obj_head + "mtllib a.mtl\ns 1\nvn 0 0 1\n",
       "5 lines are left out: mtllib, s, normals\n"},
      {"a.obj", obj_head + "g a\nusemtl red\no b\n",
       "6 names are left out: of materials (usemtl), of objects (o)\n"},
      {"a.obj", "v 0 0 0 1\nsomething else\n",
       "2 lines of an unknown kind are left out: something\n"
       "1 weights or colours of points are left out\n"},
      {"a.mesh", medit_head + "Corners\n2\n1\n2\nRidges\n0\nEnd\n",
       "11 sections are left out: Corners\n"},
      {"a.mesh", medit_head + "Wonders\n1\n1.5 7\nEnd\n", "11 sections are left out: Wonders\n"},
      {"a.inp", abaqus_head + "*MATERIAL, NAME=steel\n*ELASTIC\n2e11, 0.3\n",
       "7 keywords are left out: *material, *elastic\n"},
      {"a.bdf", nastran_head + "MAT1,1,2.1+11\nSPC1,1,3,1\n", "5 cards are left out: MAT1, SPC1\n"},
      {"a.bdf", nastran_head + "GRID,4,,0.,0.,1.,,123\n",
       "5 further fields of cards are left out: GRID\n"},
      {"a.bdf", nastran_head + "CBAR,2,,1,2,0.,1.,0.\n",
       "5 further fields of cards are left out: CBAR\n"},
      {"a.vtk", vtk_head + "FIELD f 1\nsteps 1 2 int\n1 2\n",
       "12 field data of the grid are left out: steps\n"},
      {"a.vtk", vtk_head + "POINT_DATA 4\nLOOKUP_TABLE t 1\n0 0 0 1\n",
       "12 tables of colours are left out: t\n"},
      {"a.vtk",
       vtk_head + "CELL_DATA 1\nFIELD f 1\nx 2 1 int\n1 2\nMETADATA\nCOMPONENT_NAMES\nu\nv\n\n",
       "16 names of components are left out\n"},
  };
  for (const Case& c : cases) CHECK(skipped(c.text, c.name) == c.said);
}

TEST_CASE("tags of VTK's XML that are not read are reported", "[io][skipped][vtu]") {
  const auto vtu = [](const std::string& of_grid, const std::string& of_points,
                      const std::string& of_piece) {
    return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n" +
           of_grid + "<Piece NumberOfPoints=\"1\" NumberOfCells=\"1\">\n<PointData>" + of_points +
           "</PointData>\n" + of_piece +
           "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 "
           "0</DataArray></Points>\n"
           "<Cells><DataArray type=\"Int32\" Name=\"connectivity\">0</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\">1</DataArray>"
           "<DataArray type=\"UInt8\" Name=\"types\">1</DataArray></Cells>\n"
           "</Piece></UnstructuredGrid></VTKFile>\n";
  };
  const std::string words = "<Array type=\"String\" Name=\"w\">65 0</Array>";
  const std::string key =
      "<DataArray type=\"Int8\" Name=\"k\">1<InformationKey name=\"u\">m"
      "<Value index=\"0\">2</Value></InformationKey></DataArray>";
  CHECK(skipped(vtu("", key, ""), "a.vtu").empty());
  CHECK(skipped(vtu("<FieldData>" + words + "</FieldData>", "", ""), "a.vtu") ==
        "3 field data of the grid are left out: w\n");
  CHECK(skipped(vtu("", words, ""), "a.vtu") ==
        "4 data that are no numbers are left out: w of type String\n");
  CHECK(skipped(vtu("", "", "<Extra>\n" + key + "</Extra>"), "a.vtu") ==
        "6 arrays outside of the grid are left out: k\n5 tags are left out: Extra\n");
  CHECK(
      skipped(vtu("", "<DataArray type=\"Int8\" Name=\"n\" ComponentName0=\"x\">1</DataArray>", ""),
              "a.vtu") == "4 names of components are left out: n\n");
}

TEST_CASE("comments, titles and repeated data of the mesh are not reported", "[io][skipped]") {
  CHECK(skipped("ply\nformat ascii 1.0\ncomment by hand\nobj_info 7\n" + ply_points +
                    "end_header\n0 0 0\n1 0 0\n0 1 0\n",
                "a.ply")
            .empty());
  CHECK(skipped("ply\nformat ascii 1.0\nCreated by Blender3D 2.47 - www.blender.org, source file: "
                "a b.blend\n" +
                    ply_points + "end_header\n0 0 0\n1 0 0\n0 1 0\n",
                "a.ply")
            .empty());
  CHECK(skipped(obj_head + "# words\ns off\ns 0\n", "a.obj").empty());
  CHECK(skipped("*HEADING\na title\n" + abaqus_head + "** words\n", "a.inp").empty());
  CHECK(skipped("$ words\nTITLE = a\nCEND\nBEGIN BULK\n" + nastran_head + "ENDDATA\n", "a.bdf")
            .empty());
  CHECK(skipped("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
                "a.stl")
            .empty());
  CHECK(skipped(vtk_head + "CELL_DATA 1\nFIELD f 1\nx 1 1 int\n1\nMETADATA\nINFORMATION 1\n"
                           "NAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 1 1\n\n",
                "a.vtk")
            .empty());
}

TEST_CASE("readers of simplices for computing give notes, conversions give warnings",
          "[io][skipped]") {
  const std::string text = abaqus_head + "*MATERIAL, NAME=steel\n";
  CHECK(summary(read_file_mesh(text, "a.inp").findings) == "warning skipped_data 7");
  CHECK(summary(read_file_mesh(text, "a.inp", {.simplices = true}).findings) ==
        "note skipped_data 7");
  CHECK(summary(only_simplices(read_file_mesh(text, "a.inp"), "a.inp").findings) ==
        "note skipped_data 7");
}

TEST_CASE("a thousand names are one finding of a few words, without control characters",
          "[io][skipped]") {
  std::string text = obj_head;
  for (int i = 0; i < 1000; ++i) text += "word\x1b" + std::to_string(i) + " 1\n";
  const Result<FileMesh> mesh = read_file_mesh(text, "a.obj");
  REQUIRE(mesh.findings.size() == 1);
  CHECK(mesh.findings[0].count == 1000);
  CHECK(mesh.findings[0].text.size() < 250);
  CHECK(mesh.findings[0].text.find('\x1b') == std::string::npos);
  CHECK(mesh.findings[0].text.ends_with(", ..."));
}

TEST_CASE("attribute bytes of a binary STL are reported where they are set", "[io][skipped][stl]") {
  std::string text(80, ' ');
  text += std::string("\1\0\0\0", 4) + std::string(48, '\0') + std::string("\0\0", 2);
  text[84 + 12] = text[84 + 13] = 1;  // three different corners are not needed
  CHECK(skipped(text, "a.stl").empty());
  text[84 + 48] = 7;
  CHECK(skipped(text, "a.stl") == "0 attribute bytes of facets are left out\n");
}

// SPDX-License-Identifier: MIT
// Nastran as people write it: tabs, replication, the lines before BEGIN BULK, superelements.
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"
#include "topology/io/format_traits.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Corners = std::array<std::uint32_t, 4>;

FileMesh read_whole(const std::string& text) { return test::read_whole(text, "a.bdf"); }

Finding refused(const std::string& text) {
  const Result<FileMesh> mesh = read_file_mesh(text, "a.bdf");
  INFO(text << summary(mesh.findings));
  REQUIRE_FALSE(mesh);
  INFO(mesh.findings[0].text);
  return mesh.findings[0];
}

const std::string points =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
const std::string body = points + "CTETRA,1,1,1,2,3,4\n";

}  // namespace

TEST_CASE("a tab goes to the next column of 8", "[io][nastran][tabs]") {
  const std::string rows[] = {
      "GRID\t5\t\t1.5\t-2.\t3.25\n",
      "GRID    5\t\t1.5     -2.\t3.25\n",
      "GRID    5       \t1.5\t-2.     3.25",
      "\t\n  GRID\t5       \t1.5\t-2.\t3.25\n",
      "GRID*\t5\t\t\t\t1.5\t\t-2.\n*\t3.25\n",
      "GRID,\t5,,\t1.5,-2.,3.25\n",
      "GRID*   5\t\t                1.5             -2.\t\t\n*       3.25\n"};
  for (const std::string& row : rows) {
    const FileMesh mesh = read_whole(points + row);
    REQUIRE(mesh.points.size() == 5);
    CHECK(mesh.points[4] == Point{1.5, -2, 3.25});
  }
}

TEST_CASE("a card of tabs goes on in the next line", "[io][nastran][tabs]") {
  const FileMesh mesh =
      read_whole(points +
                 "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\nGRID,8,,0.,0.,.5\n"
                 "GRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n"
                 "CTETRA\t1\t1\t1\t2\t3\t4\t5\t6\n\t7\t8\t9\t10\n");
  CHECK(rows_of(mesh, CellKind::tetrahedron10).count == 1);
}

TEST_CASE("cards repeat the one before them", "[io][nastran][replication]") {
  const std::string grid = "GRID,1,,0.,0.,0.\n";
  const auto xs = [](const std::string& text) {
    std::vector<double> found;
    for (const Point& p : read_whole(text).points) found.push_back(p[0]);
    return found;
  };
  CHECK(xs(grid + "=,*1,=,*0.5,==\n") == std::vector<double>{0, 0.5});
  CHECK(xs(grid + "=,*(1),=,*(0.5),==\n=(2)\n") == std::vector<double>{0, 0.5, 1, 1.5});
  CHECK(xs(grid + "=,*1,=,*.5,=,=\n=2\n") == std::vector<double>{0, 0.5, 1, 1.5});
  CHECK(xs(grid + "=(3),*1,=,*1.,==\n") == std::vector<double>{0, 1, 2, 3});
  CHECK(xs(grid + "=,*1,=,7.,==\n=,*1,=,*-1.,==$ words\n") == std::vector<double>{0, 7, 6});
  CHECK(xs(grid + "=       *(1)    =       *(2.)   ==\n=(1)\n") == std::vector<double>{0, 2, 4});
  CHECK(xs(grid + "=,*1,=,*1.5-1,==\n") == std::vector<double>{0, 0.15});
  // The next line is a card of its own again, and =(0) makes none.
  CHECK(xs(grid + "=,*1,=,*1.,==\n=(0)\nGRID,9,,5.,0.,0.\n=,*1,=,=,==\n") ==
        std::vector<double>{0, 1, 5, 5});
}

TEST_CASE("elements are repeated with the lines that they go on in", "[io][nastran][replication]") {
  std::string text;
  for (int i = 1; i <= 24; ++i) {
    text += "GRID," + std::to_string(i) + ",," + std::to_string((i - 1) / 4) + ".," +
            std::to_string(i % 4 / 2) + "." + "," + std::to_string(i % 2) + ".\n";
  }
  const FileMesh mesh =
      read_whole(text +
                 "CHEXA,1,3,1,2,4,3,5,6,\n+,8,7\n=,*1,=,*4,*4,*4,*4,*4,*4,\n+,*4,*4\n=(2)\n"
                 "CTETRA,9,3,1,2,3,5\n=,*1,4,==\n");
  CHECK(rows_of(mesh, CellKind::hexahedron8).count == 4);
  CHECK(rows_of(mesh, CellKind::hexahedron8)[3][7] == 18);
  CHECK(mesh.tetrahedra.region == std::vector<std::int32_t>{3, 4});
  CHECK(mesh.tetrahedra.corners == std::vector<Corners>{{0, 1, 2, 4}, {0, 1, 2, 4}});
}

TEST_CASE("replication that cannot be is refused at its line", "[io][nastran][replication]") {
  struct Defect {
    std::string text, code;
    std::size_t line;
  };
  const Defect defects[] = {
      {"BEGIN BULK\n=,*1\n" + points, "wrong_section_order", 2},
      {points + "=,*1,*1,==\n", "bad_number", 5},
      {points + "=,*x,==\n", "bad_number", 5},
      {points + "=(x),*1\n", "bad_number", 5},
      {points + "=(99999999),\n", "count_too_big", 5},
      {points + "=(99999999999999999999999)\n", "bad_number", 5},
      {points + "=,*9999999999999999999,==\n", "number_out_of_range", 5},
  };
  for (const Defect& d : defects) {
    const Finding f = refused(d.text);
    CHECK(f.code == d.code);
    CHECK(f.line == d.line);
  }
}

TEST_CASE("decks are known by their content, whatever stands first", "[io][nastran][decks]") {
  const std::string headers[] = {
      "$$ HyperMesh\n$$\nANALYSIS STATICS\nSUBCASE 1\n  LOAD = 2\nBEGIN BULK\n",
      "DISPLACEMENT(PLOT)=ALL\nBEGIN BULK\n",
      "SET 1 = 1, 2,\n 3 THRU 9\nSTRESS = 1\nBEGIN BULK\n",
      "$MODEL\n$\nUNHEARD OF WORDS\nBEGIN BULK\n",
      "nastran buffsize=1\nid a,b\nsol 101\ncend\nbegin bulk\n",
      "PARAM,POST,-1\nUNHEARD,1,2\n",
      "$Nodes\n",
      "$MeshFormatter 7\n",
      ""};
  for (const std::string& header : headers) {
    CHECK(read_whole(header + body + "ENDDATA\n").tetrahedra.corners.size() == 1);
  }
}

TEST_CASE("MSH files stay MSH files, and nobody else's text is a deck", "[io][nastran][decks]") {
  CHECK(format_of_content("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n") == MeshFormat::msh);
  CHECK(format_of_content("$NOD\n1\n1 0 0 0\n$ENDNOD\n") == MeshFormat::msh);
  CHECK(format_of_content("$Nodes\n1\n1 0 0 0\n$EndNodes\n") == MeshFormat::msh);
  CHECK(format_of_content("g BEGIN\nv 0 0 0\n") == MeshFormat::obj);
  CHECK(format_of_content("solid GRID\nendsolid GRID\n") == MeshFormat::stl);
  CHECK_FALSE(format_of_content("Dear reader,\nBEGINNING\n"));
  // A deck that is not known is at least no MSH file without its first section.
  const Finding f = refused("$ words\n1,2,3\n");
  CHECK(f.code == "unknown_format");
  CHECK(f.remedy.find("$MeshFormat") == std::string::npos);
}

TEST_CASE("superelements are refused with words of their own", "[io][nastran][decks]") {
  for (const std::string begin : {"BEGIN SUPER=1\n", "BEGIN BULK SUPER = 2\n", "begin super=3\n"}) {
    const Finding f = refused("SOL 101\nCEND\nBEGIN BULK\n" + body + begin + body);
    CHECK(f.code == "unsupported_keyword");
    CHECK(f.line == 9);
    CHECK(f.text.find("superelement") != std::string::npos);
    CHECK(refused(begin + body).line == 1);
  }
}

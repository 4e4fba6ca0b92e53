// SPDX-License-Identifier: MIT
// A row with a number too many or too few gets the blame, and not the line where the numbers that
// it shifts do not fit any more.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Lines of a file, to change one of them.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

struct Rows {
  std::string name, text;
  /// Lines of rows, counted from 1.
  std::size_t first, last;
};

const Rows files[] = {
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
     "z\n"
     "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 "
     "1\n"
     "3 0 1 2\n3 0 1 3\n",
     10, 15},
    {"a.msh",
     "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 "
     "1\n$EndNodes\n"
     "$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 2 2 1 1 1 2 3\n$EndElements\n",
     6, 9},
    {"a.mesh",
     "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
     "Triangles\n2\n1 2 3 0\n1 2 4 0\nEnd\n",
     5, 8},
    {"a.ovm",
     "OVM ASCII\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\nEdges\n3\n0 1\n1 2\n2 0\nFaces\n1\n3 0 2 4\n"
     "Polyhedra\n0\n",
     4, 6},
    {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n", 3, 6},
};

}  // namespace

TEST_CASE("the row that is too long or too short is at fault", "[io][line_at_fault]") {
  for (const Rows& file : files) {
    REQUIRE(read_file_mesh(file.text, file.name));
    for (std::size_t line = file.first; line <= file.last; ++line) {
      for (const bool is_short : {false, true}) {
        std::vector<std::string> lines = lines_of(file.text);
        std::string& row = lines[line - 1];
        row = is_short ? row.substr(0, row.rfind(' ')) : row + " 0.5";
        const Result<FileMesh> mesh = read_file_mesh(joined(lines), file.name);
        INFO(joined(lines) << summary(mesh.findings));
        REQUIRE_FALSE(mesh);
        INFO(mesh.findings[0].text);
        CHECK(mesh.findings[0].line == line);
      }
    }
  }
}

TEST_CASE("rows that fill their lines in another way are read, and not blamed",
          "[io][line_at_fault]") {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n";
  const std::string two_a_line = head + "0 0 0 0 1 0 0 0\n0 1 0 0 0 0 1 0\n";
  const std::string two_lines_a_row = head + "0 0\n0 0\n1 0\n0 0\n0 1\n0 0\n0 0\n1 0\n";
  for (const std::string& text : {two_a_line, two_lines_a_row}) {
    CHECK(read_file_mesh(text + "Triangles\n1\n1 2 3 0\nEnd\n", "a.mesh"));
    const Result<FileMesh> bad = read_file_mesh(text + "Triangles\n1\n1 2 x 0\nEnd\n", "a.mesh");
    REQUIRE_FALSE(bad);
    CHECK(bad.findings[0].code == "bad_number");
    CHECK(bad.findings[0].text.find("'x'") == 0);
  }
}

TEST_CASE("a corner of an STL that lacks a number is at fault", "[io][line_at_fault][stl]") {
  const Result<FileMesh> mesh = read_file_mesh(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid a\n",
      "a.stl");
  REQUIRE_FALSE(mesh);
  CHECK(mesh.findings[0].line == 5);
}

TEST_CASE("the second of two nodes of one number is at fault", "[io][line_at_fault]") {
  const auto line = [](const std::string& text, const std::string& name) {
    const Result<FileMesh> mesh = read_file_mesh(text, name);
    INFO(text << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    CHECK(mesh.findings[0].code == "duplicate_id");
    return mesh.findings[0].line;
  };
  const std::string behind = "$EndNodes\n$Elements\n0\n$EndElements\n";
  CHECK(
      line("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n1 0 1 0\n" + behind,
           "a.msh") == 8);
  CHECK(line("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 2\n3 1 0 3\n1\n2\n2\n0 0 0\n"
             "1 0 0\n0 1 0\n" +
                 behind,
             "a.msh") == 9);
  CHECK(line("    -1\n  2411\n1 1 1 11\n0. 0. 0.\n2 1 1 11\n1. 0. 0.\n1 1 1 11\n0. 1. 0.\n    -1\n",
             "a.unv") == 7);
  CHECK(line("    -1\n    15\n1 1 1 11 0. 0. 0.\n\n1 1 1 11 1. 0. 0.\n    -1\n", "a.unv") == 5);
}

// SPDX-License-Identifier: MIT
// Files as people write them: features that no format description requires and every reader meets.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const std::string abaqus_nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";

/// A text PLY of one triangle, with `more` lines put before the line that begins with `before`.
std::string ply_with(const std::string& before, const std::string& more) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::size_t at = text.find("\n" + before);
  REQUIRE(at != std::string::npos);
  return text.insert(at + 1, more);
}

}  // namespace

TEST_CASE("elements of types that Abaqus' reader does not know are listed and left out",
          "[io][quirks][abaqus]") {
  const std::string text = abaqus_nodes +
                           "*ELEMENT,TYPE=U17\n7,1,2,\n3,4\n8,1,2,3,4\n"
                           "*ELEMENT,TYPE=C3D4,ELSET=body\n1,1,2,3,4\n"
                           "*ELEMENT,TYPE=WEIRD\n9,1\n*ELSET,ELSET=all\n1,7,8,9\n";
  const Result<FileMesh> mesh = read_file_mesh(text, "a.inp");
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.corners.size() == 1);
  REQUIRE(mesh.findings.size() == 1);  // the set's members are no surprise then
  const Finding& f = mesh.findings[0];
  CHECK(f.code == "unknown_cells");
  CHECK(f.severity == Severity::warning);
  CHECK(f.count == 3);
  CHECK(f.line == 7);
  CHECK(f.text == "elements of unknown types are left out: 2 of type 'U17', 1 of type 'WEIRD'");
}

TEST_CASE("a hundred unknown types of elements are one warning of a few words",
          "[io][quirks][abaqus]") {
  std::string text = abaqus_nodes;
  for (int i = 0; i < 100; ++i) text += "*ELEMENT,TYPE=U" + std::to_string(i) + "\n1,1,2\n";
  const Result<FileMesh> mesh = read_file_mesh(text, "a.inp");
  REQUIRE(mesh);
  REQUIRE(mesh.findings.size() == 1);
  CHECK(mesh.findings[0].count == 100);
  CHECK(mesh.findings[0].text.find("88 of other types") != std::string::npos);
  CHECK(mesh.findings[0].text.size() < 400);
}

TEST_CASE("Abaqus' lines go on behind a comma, blanks and carriage returns after it",
          "[io][quirks][abaqus]") {
  const std::string plain = abaqus_nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,\n3,4\n2,2,1,3,4\n";
  const FileMesh expected = read_whole(plain, "a.inp");
  CHECK(expected.tetrahedra.corners.size() == 2);
  for (const std::string end : {", \n", ",\t \n", ",\r\n", " , \r\n"}) {
    std::string text = plain;
    text.replace(text.find("2,\n3") + 1, 2, end);
    CHECK(read_whole(text, "a.inp") == expected);
  }
}

TEST_CASE("STL's solids end as programs write it, without facets too", "[io][quirks][surface]") {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const std::string plain = "solid a\n" + facet + "endloop\nendfacet\nendsolid a\n";
  const FileMesh expected = read_whole(plain, "a.stl");
  REQUIRE(expected.triangles.corners.size() == 1);
  const std::string variants[] = {
      "solid a\n" + facet + "endloop\nendfacet\nend solid a\n",
      "solid a\n" + facet + "end loop\nend facet\nend solid\n",
      "SOLID a\n" + facet + "ENDLOOP\nENDFACET\nEND SOLID a\n",
      "solid none\nend solid none\n" + plain + "solid\nendsolid\n",
      "solid none\nendsolid\n" + plain,
  };
  for (const std::string& text : variants) CHECK(read_whole(text, "a.stl") == expected);
  for (const std::string text :
       {"solid\nendsolid", "solid a\nend solid a\n", "solid a\nendsolid"}) {
    CHECK(read_whole(text, "a.stl").triangles.corners.empty());
  }
  const Result<FileMesh> cut = read_file_mesh("solid a\n" + facet + "endloop\n", "a.stl");
  REQUIRE_FALSE(cut);
  CHECK(cut.findings[0].code == "truncated_file");
  const Result<FileMesh> wrong = read_file_mesh("solid a\n" + facet + "end facet\n", "a.stl");
  REQUIRE_FALSE(wrong);
  CHECK(wrong.findings[0].text == "'end' stands where the word endloop was expected");
}

TEST_CASE("PLY's comments stand anywhere", "[io][quirks][surface]") {
  const FileMesh expected = read_whole(ply_with("format", ""), "a.ply");
  CHECK(expected.triangles.corners.size() == 1);
  const std::string comments[] = {"comment\n", "comment made by hand\n", "obj_info\n",
                                  "obj_info num_cols 3\n",
                                  "comment \t\r\ncomment element vertex 9\n"};
  for (const std::string& comment : comments) {
    for (const std::string before :
         {"format", "element vertex", "property float x", "property float z", "element face",
          "property list", "end_header", "0 0 0", "1 0 0", "3 0 1"}) {
      INFO(comment << " before " << before);
      CHECK(read_whole(ply_with(before, comment), "a.ply") == expected);
    }
  }
  CHECK(read_whole("ply " + ply_with("format", "").substr(3), "a.ply") == expected);
}

TEST_CASE("unknown lines of PLY's header change no row before the first element, later they may",
          "[io][quirks][surface]") {
  const FileMesh expected = read_whole(ply_with("format", ""), "a.ply");
  const std::string line =
      "Created by Blender3D 2.47 - www.blender.org, source file: element.blend\n";
  for (const std::string before : {"format", "element vertex"}) {
    CHECK(read_whole(ply_with(before, line), "a.ply") == expected);
    const Result<FileMesh> other = read_file_mesh(ply_with(before, "Property of me\n"), "a.ply");
    REQUIRE(other);
    CHECK(*other == expected);
    CHECK(summary(other.findings) ==
          (before == "format" ? "warning skipped_data 2" : "warning skipped_data 3"));
  }
  for (const std::string before : {"property float x", "element face", "end_header"}) {
    const Result<FileMesh> refused = read_file_mesh(ply_with(before, line), "a.ply");
    REQUIRE_FALSE(refused);
    CHECK(refused.findings[0].code == "unknown_section");
  }
}

TEST_CASE("faces of PLY keep their data in a file with triangle strips", "[io][quirks][ply]") {
  const std::string points =
      "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces =
      "element face 1\nproperty list uchar int vertex_indices\nproperty int region\n"
      "property float heat\n";
  const std::string strips =
      "element tristrips 2\nproperty list int int vertex_indices\nend_header\n";
  const FileMesh mesh = read_whole(
      "ply\nformat ascii 1.0\n" + points + faces + strips +
          "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n3 0 1 2 7 0.5\n9 0 0 1 2 3 3 -1 1 3\n3 4 3 2\n",
      "a.ply");
  using Corners = std::array<std::uint32_t, 3>;
  CHECK(mesh.triangles.corners == std::vector<Corners>{{0, 1, 2}, {1, 0, 2}, {1, 2, 3}, {4, 3, 2}});
  CHECK(mesh.triangles.region == std::vector<std::int32_t>{7, 0, 0, 0});
  CHECK(std::get<0>(mesh.triangles.data.at(0).values).size() == 4);
}

TEST_CASE("text STL is read with short normals, and without", "[io][quirks][stl]") {
  for (const std::string normal :
       {"facet\n", "facet normal\n", "FACET NORMAL 0 0\n", "facet normal nan nan nan\n"}) {
    const FileMesh mesh = read_whole("solid\n" + normal +
                                         "outer loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                         "vertex 0 1 0\nendloop\nendfacet\nendsolid\n",
                                     "a.stl");
    CHECK(mesh.triangles.corners.size() == 1);
  }
}

TEST_CASE("headers of OFF have their letters in any order", "[io][quirks][off]") {
  for (const std::string letters : {"CNST", "STNC", "NC", "NSTC", "CST", "CN"}) {
    const bool has_texture = letters.find("ST") != std::string::npos;
    const std::size_t more = (letters.find('C') != std::string::npos ? 4 : 0) +
                             (letters.find('N') != std::string::npos ? 3 : 0) +
                             (has_texture ? 2 : 0);
    std::string text = letters + "OFF\n3 1 0\n";
    for (const std::string point : {"0 0 0", "1 0 0", "0 1 0"}) {
      text += point;
      for (std::size_t i = 0; i < more; ++i) text += " 1";
      text += "\n";
    }
    CHECK(read_whole(text + "3 0 1 2\n", "a.off").triangles.corners.size() == 1);
  }
}

// SPDX-License-Identifier: MIT
// Defective Abaqus files, one defect each: the code, the file, the line and the words.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

struct Defect {
  std::string what;
  std::string text;
  std::string code;
  std::size_t line;
  /// Stands in the text of the finding.
  std::string says;
};

const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
const std::string body = nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";

void check_finding(const Defect& defect, const Result<FileMesh>& mesh, const std::string& file) {
  INFO(defect.what << ": " << summary(mesh.findings));
  REQUIRE_FALSE(mesh);
  CHECK(std::ranges::count(mesh.findings, Severity::error, &Finding::severity) == 1);
  const Finding& f = mesh.findings.at(0);
  INFO(f.text << "; " << f.remedy);
  CHECK(f.code == defect.code);
  CHECK(f.line == defect.line);
  CHECK(f.file == file);
  CHECK(f.text.find(defect.says) != std::string::npos);
  CHECK(f.remedy.size() > 5);
}

}  // namespace

TEST_CASE("defects of Abaqus' files are named", "[io][defects][abaqus]") {
  REQUIRE(read_file_mesh(body, "bad file"));
  const Defect defects[] = {
      {"no nodes", "*HEADING\nnothing\n", "missing_section", 3, "without nodes"},
      {"a word for a coordinate", "*NODE\n1,0,0,0\n2,x,0,0\n", "bad_number", 3, "'x'"},
      {"no number of a node", "*NODE\n1,0,0,0\n,1,0,0\n", "bad_number", 3, "a node number"},
      {"a coordinate that is no number", "*NODE\n1,0,0,0\n2,nan,0,0\n", "nan_coordinate", 3, "nan"},
      {"a node's number twice", nodes + "3,1,1,1\n", "duplicate_id", 6, "same number 3"},
      {"a huge number of a node", "*NODE\n9999999999999999999999,0,0,0\n", "number_out_of_range", 2,
       "9999"},
      {"cylindrical coordinates", "*NODE, SYSTEM=C\n1,0,0,0\n", "unsupported_keyword", 1,
       "SYSTEM='c'"},
      {"an element without type", nodes + "*ELEMENT\n1,1,2,3,4\n", "bad_keyword", 6, "type="},
      {"a hexahedron", body + "*ELEMENT,TYPE=C3D8R\n2,1,2,3,4,\n1,2,3,4\n", "unsupported_cells", 9,
       "1 hexahedron"},
      {"a node that is not there", body + "2,1,2,3,7\n", "index_out_of_range", 8, "point 7"},
      {"a repeated node", body + "2,1,2,3,3\n", "repeated_vertex", 8, "1 2 3 3"},
      {"an element's number twice", body + "2,1,2,4,3\n1,2,3,4,1\n", "duplicate_id", 9, "number 1"},
      {"too few nodes", body + "2,1,2,3\n", "wrong_count", 8, "3 of its 4"},
      {"too few nodes at the end", body + "2,1,2,3,\n", "wrong_count", 8, "3 of its 4"},
      {"too many nodes", body + "2,1,2,3,4,1\n", "wrong_count", 8, "'1' follows the 4 nodes"},
      {"a set without a name", body + "*ELSET\n1\n", "bad_keyword", 8, "elset="},
      {"a set that is not there", body + "*ELSET, ELSET=a\nbody\n", "unknown_set", 9, "'body'"},
      {"a step of 0", body + "*ELSET, ELSET=a, GENERATE\n1,5,0\n", "bad_number", 9,
       "0 is the step"},
      {"a second part", "*PART,NAME=A\n" + body + "*END PART\n*PART,NAME=B\n", "several_parts", 10,
       "'B'"},
      {"a part that is moved",
       "*PART,NAME=A\n" + body + "*END PART\n*INSTANCE,NAME=I,PART=A\n1,0,0\n", "several_parts", 11,
       "moved"},
      {"nodes to be made", nodes + "*NGEN\n1,2,1\n", "unsupported_keyword", 6, "*ngen"},
      {"a file that is not there", body + "*INCLUDE, INPUT=more.inp\n", "missing_file", 8,
       "'more.inp'"},
  };
  for (const Defect& defect : defects) {
    check_finding(defect, read_file_mesh(defect.text, "bad file", {.simplices = true}), "bad file");
  }
}

TEST_CASE("included files are read in their folder only, and once", "[io][defects][abaqus]") {
  const Folder folder;
  const auto main = folder.path() / "main.inp";
  std::filesystem::create_directory(folder.path() / "parts");
  const auto put = [](const std::filesystem::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary) << text;
  };
  const auto part = folder.path() / "parts" / "nodes.inp";
  put(main, "*NODE, INPUT=parts/nodes.inp\n*INCLUDE, INPUT=cells.inp\n");
  put(part, "1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n");
  put(folder.path() / "cells.inp", "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n");
  const Result<FileMesh> mesh = read_file_mesh(main);
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.corners.size() == 1);

  put(part, "1,0,0,0\n2,1,q,0\n");
  check_finding({"in an included file", "", "bad_number", 2, "'q'"}, read_file_mesh(main),
                part.string());
  put(main, "*INCLUDE, INPUT=../main.inp\n");
  check_finding({"outside", "", "outside_folder", 0, "not in the folder"}, read_file_mesh(main),
                (folder.path() / "../main.inp").string());
  put(main, "*INCLUDE, INPUT=./main.inp\n");
  check_finding({"itself", "", "include_cycle", 1, "a second time"}, read_file_mesh(main),
                main.string());
  put(main, "** first\n*INCLUDE, INPUT=a.inp\n");
  put(folder.path() / "a.inp", "*INCLUDE, INPUT=parts/../a.inp\n");
  check_finding({"a cycle", "", "include_cycle", 1, "a second time"}, read_file_mesh(main),
                (folder.path() / "a.inp").string());
}

TEST_CASE("sets of sets and ranges cannot blow up", "[io][defects][abaqus]") {
  std::string text = nodes + "*ELEMENT,TYPE=C3D4\n";
  for (int i = 1; i <= 1000; ++i) text += std::to_string(i) + ",1,2,3,4\n";
  SECTION("doubling sets") {
    text += "*ELSET,ELSET=s0,GENERATE\n1,1000\n";
    for (int i = 1; i < 30; ++i) {
      const std::string before = std::to_string(i - 1);
      text += "*ELSET,ELSET=s" + std::to_string(i) + "\ns" + before + ",s" + before + "\n";
    }
  }
  SECTION("many ranges") {
    for (int i = 0; i < 5000; ++i) {
      text += "*ELSET,ELSET=s" + std::to_string(i) + ",GENERATE\n1,1000\n";
    }
  }
  SECTION("a set of itself, over and over") {
    text += "*ELSET,ELSET=s,GENERATE\n1,1000\n";
    for (int i = 1; i < 2000; ++i) text += "*ELSET,ELSET=s\ns,s\n";
  }
  SECTION("deep sets") {
    text += "*ELSET,ELSET=s0\n1\n";
    for (int i = 1; i < 100; ++i) {
      text += "*ELSET,ELSET=s" + std::to_string(i) + "\ns" + std::to_string(i - 1) + "\n";
    }
  }
  const Result<FileMesh> mesh = read_file_mesh(text, "a.inp");
  INFO(summary(mesh.findings));
  REQUIRE_FALSE(mesh);
  CHECK(mesh.findings[0].code == "count_too_big");
}

TEST_CASE("Abaqus' files cut or changed at random are answered", "[io][damage][abaqus]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::string samples[] = {
      bytes_of(sample("gmsh.inp")), bytes_of(sample("meshio.inp")),
      bytes_of(sample("gmsh_2nd.inp")),
      body + "*ELSET,ELSET=a,GENERATE\n1,9,2\n*ELSET,ELSET=b\na,1\n*NSET,NSET=c\n1,2,3\n"};
  constexpr const char* pieces[] = {
      "99999999999", "-1", "nan", "*", "**", ",", "", "\n", ".5", "=", "\"", "*ELSET,ELSET=a\na\n"};
  for (int round = 0; round < 3000; ++round) {
    std::string text = samples[random() % std::size(samples)];
    if (round % 3 == 0) {
      text.resize(random() % text.size());
    } else {
      text.replace(random() % text.size(), random() % 4, pieces[random() % std::size(pieces)]);
    }
    const Result<FileMesh> mesh = read_file_mesh(text, "damaged");
    REQUIRE(mesh.value.has_value() != has_error(mesh.findings));
    for (const Finding& f : mesh.findings) {
      CHECK_FALSE(f.text.empty());
      CHECK_FALSE(f.remedy.empty());
    }
    if (!mesh) continue;
    for (const auto& t : mesh->tetrahedra.corners) {
      for (const auto p : t) REQUIRE(p < mesh->points.size());
    }
  }
}

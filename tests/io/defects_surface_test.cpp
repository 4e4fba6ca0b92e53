// SPDX-License-Identifier: MIT
// Defective surface files, one defect each: the code, the line and the words that name the value.
#include <algorithm>
#include <catch2/catch.hpp>

#include "io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const std::string good_off = R"(OFF
4 2 0
0 0 0
1 0 0
0 1 0
0 0 1
3 0 1 2
3 1 2 3
)";

const std::string good_stl = R"(solid part
facet normal 0 0 1
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 0 1 0
 endloop
endfacet
endsolid part
)";

/// `text` with the first `from` made `to`.
std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct Defect {
  std::string what;
  std::string bytes;
  std::string code;
  std::size_t line;
  /// Stands in the text of the finding.
  std::string says;
};

void check_defects(const std::vector<Defect>& defects) {
  for (const Defect& defect : defects) {
    const Result<FileMesh> mesh = read_file_mesh(defect.bytes, "bad file");
    INFO(defect.what << ": " << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    const Finding& f = mesh.findings.at(0);
    CHECK(std::ranges::count(mesh.findings, Severity::error, &Finding::severity) == 1);
    INFO(f.text << "; " << f.remedy);
    CHECK(f.code == defect.code);
    CHECK(f.line == defect.line);
    CHECK(f.file == "bad file");
    CHECK(f.text.find(defect.says) != std::string::npos);
    CHECK(f.remedy.size() > 5);
  }
}

std::string binary_stl() {
  const TemporaryFolder folder;
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.corners = {{0, 1, 2}};
  REQUIRE(write_file_mesh(folder.path() / "a.stl", mesh).empty());
  return bytes_of(folder.path() / "a.stl");
}

}  // namespace

TEST_CASE("the good surfaces that the defects start from are read", "[io][defects]") {
  for (const std::string& good : {good_off, good_stl, binary_stl()}) {
    const Result<FileMesh> mesh = read_file_mesh(good, "good");
    INFO(summary(mesh.findings));
    CHECK(mesh);
    CHECK(mesh.findings.empty());
  }
}

TEST_CASE("defects of OFF", "[io][defects][off]") {
  check_defects({
      {"four dimensions", changed(good_off, "OFF", "4OFF"), "unsupported_cells", 1, "4OFF"},
      {"too many points", changed(good_off, "4 2", "4000000000 2"), "count_too_big", 2,
       "4000000000"},
      {"a negative count", changed(good_off, "4 2", "4 -2"), "bad_number", 2, "-2"},
      {"a letter for a digit", changed(good_off, "0 1 0", "0 l 0"), "bad_number", 5, "'l'"},
      {"colours without COFF", changed(good_off, "1 0 0\n", "1 0 0 255 0 0\n"), "bad_number", 4,
       "255 0 0"},
      {"infinite", changed(good_off, "1 0 0\n", "1 inf 0\n"), "nan_coordinate", 4, "inf"},
      {"beyond the doubles", changed(good_off, "1 0 0\n", "1 1e999 0\n"), "number_out_of_range", 4,
       "1e999"},
      {"a point that is not there", changed(good_off, "1 2 3\n", "1 2 4\n"), "index_out_of_range",
       8, "4"},
      {"a huge face", changed(good_off, "3 1 2 3", "99999999 1 2 3"), "count_too_big", 8,
       "99999999"},
      {"a face more", good_off + "3 0 1 3\n", "wrong_count", 9, "last face"},
      {"a face less", changed(good_off, "3 1 2 3\n", ""), "truncated_file", 8, "corners"},
      {"binary, cut", std::string("OFF BINARY\n\0\0\0", 14), "truncated_file", 0, "points"},
  });
}

TEST_CASE("defects of STL", "[io][defects][stl]") {
  std::string many = binary_stl();
  many[80] = 2;
  std::string infinite = binary_stl();
  infinite.replace(84 + 12, 4, std::string("\0\0\x80\x7f", 4));
  check_defects({
      {"four corners", changed(good_stl, " endloop", "  vertex 1 1 1\n endloop"), "wrong_count", 7,
       "fourth"},
      {"two corners", changed(good_stl, "  vertex 0 1 0\n", ""), "bad_number", 6, "endloop"},
      {"a letter for a digit", changed(good_stl, "vertex 1 0 0", "vertex 1 O 0"), "bad_number", 5,
       "'O'"},
      {"not a number", changed(good_stl, "vertex 1 0 0", "vertex 1 nan 0"), "nan_coordinate", 2,
       "nan"},
      {"cut", good_stl.substr(0, 70), "truncated_file", 5, "70 bytes"},
      {"no end", changed(good_stl, "endsolid part\n", ""), "truncated_file", 9, "facet"},
      {"binary, infinite", infinite, "nan_coordinate", 0, "inf"},
  });
  CHECK(read_file_mesh(many, "many.stl").findings.at(0).code == "count_too_big");
}

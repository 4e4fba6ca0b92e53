// SPDX-License-Identifier: MIT
// Defective surface files, one defect each: the code, the line and the words that name the value.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

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

const std::string good_ply = R"(ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
element face 1
property list uchar int vertex_indices
end_header
0 0 0 1
1 0 0 2
0 1 0 3
3 0 1 2
)";

const std::string good_obj = R"(o part
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
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
  const Folder folder;
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.corners = {{0, 1, 2}};
  REQUIRE(write_file_mesh(folder.path() / "a.stl", mesh).empty());
  return bytes_of(folder.path() / "a.stl");
}

}  // namespace

TEST_CASE("the good surfaces that the defects start from are read", "[io][defects]") {
  for (const std::string& good : {good_off, good_stl, good_ply, good_obj, binary_stl()}) {
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

TEST_CASE("defects of PLY", "[io][defects][ply]") {
  const std::string binary =
      changed(good_ply.substr(0, good_ply.find("0 0 0 1")), "ascii", "binary_little_endian");
  const std::string lists =
      changed(changed(binary, "uchar int", "uint int"), "vertex 3", "vertex 0");
  check_defects({
      {"another version", changed(good_ply, "1.0", "2.0"), "unknown_version", 2, "2.0"},
      {"no format", changed(good_ply, "format ascii 1.0\n", ""), "unknown_version", 1, "format"},
      {"an unknown type", changed(good_ply, "float z", "real z"), "bad_attribute", 6, "real"},
      {"an unknown line", changed(good_ply, "element face", "elements face"), "unknown_section", 8,
       "elements"},
      {"no z", changed(good_ply, "float z", "float w"), "missing_array", 3, "'z'"},
      {"no corners", changed(good_ply, "vertex_indices", "corners"), "missing_array", 8,
       "vertex_indices"},
      {"faces first",
       changed(changed(good_ply, "element vertex 3", "element other 3"), "element face",
               "element vertex 0\nproperty int x\nproperty int y\n"
               "property int z\nelement vertex"),
       "wrong_section_order", 12, "vertex"},
      {"a property of nothing", changed(good_ply, "element vertex 3\n", ""), "wrong_section_order",
       3, "before"},
      {"too many", changed(good_ply, "vertex 3", "vertex 9999999999"), "count_too_big", 3,
       "9999999999"},
      {"no end of the header", changed(good_ply, "end_header", "comment"), "unknown_section", 11,
       "'0'"},
      {"beyond its type", changed(good_ply, "0 1 0 3", "0 1 0 256"), "number_out_of_range", 13,
       "256"},
      {"a huge list", changed(good_ply, "3 0 1 2", "255 0 1 2"), "count_too_big", 14, "255"},
      {"a point that is not there", changed(good_ply, "3 0 1 2", "3 0 1 3"), "index_out_of_range",
       14, "3"},
      {"a row more", good_ply + "3 0 1 2\n", "wrong_count", 15, "last row"},
      {"a row less", changed(good_ply, "3 0 1 2\n", ""), "truncated_file", 14, "length of a list"},
      {"binary, a list of a thousand million",
       lists + std::string("\0\xca\x9a\x3b\0\0\0\0\0\0\0\0", 12), "count_too_big", 0, "1000000000"},
      {"binary, cut", binary + std::string(38, '\0'), "count_too_big", 0, "3 rows"},
  });
}

TEST_CASE("defects of OBJ", "[io][defects][obj]") {
  std::string groups = "v 0 0 0\n";
  for (int i = 0; i < 3000; ++i) groups += "g n" + std::to_string(i) + "\np 1\n";
  check_defects({
      {"two coordinates", changed(good_obj, "v 1 0 0", "v 1 0"), "bad_number", 3, "fewer"},
      {"a letter for a digit", changed(good_obj, "v 1 0 0", "v 1 O 0"), "bad_number", 3, "'O'"},
      {"infinite", changed(good_obj, "v 1 0 0", "v 1 inf 0"), "nan_coordinate", 3, "inf"},
      {"a point that is not there", changed(good_obj, "f 1 2 3", "f 1 2 4"), "index_out_of_range",
       5, "4"},
      {"point 0", changed(good_obj, "f 1 2 3", "f 0 1 2"), "index_out_of_range", 5, "point 0"},
      {"too far back", changed(good_obj, "f 1 2 3", "f -4 -2 -1"), "index_out_of_range", 5, "-4"},
      {"no number", changed(good_obj, "f 1 2 3", "f 1 /2 3"), "bad_number", 5, "'/2'"},
      {"a huge number", changed(good_obj, "f 1 2 3", "f 1 2 99999999999999999999"),
       "number_out_of_range", 5, "99999999999999999999"},
      {"more groups than bodies can have", groups, "count_too_big", 2547, "groups"},
  });
}

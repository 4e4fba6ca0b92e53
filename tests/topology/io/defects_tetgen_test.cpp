// SPDX-License-Identifier: MIT
// Defective files of TetGen, one defect each: the code, the file, the line and the words.
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
  /// Of the files a.node and a.ele, and of a.face where there is one.
  std::string node, ele, face;
  std::string code;
  /// The ending of the file that is to blame.
  std::string in;
  std::size_t line;
  /// Stands in the text of the finding.
  std::string says;
};

const std::string node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const std::string ele = "1 4 1\n1 1 2 3 4 7\n";
const std::string face = "1 1\n1 1 2 3 5\n";

Result<FileMesh> read(const Folder& folder, const Defect& d) {
  const auto put = [&](const char* name, const std::string& text) {
    std::filesystem::remove(folder.path() / name);
    if (!text.empty()) std::ofstream(folder.path() / name, std::ios::binary) << text;
  };
  put("a.node", d.node);
  put("a.ele", d.ele);
  put("a.face", d.face);
  return read_file_mesh(folder.path() / (d.node.empty() ? "a.ele" : "a.node"));
}

}  // namespace

TEST_CASE("defects of TetGen's files are named", "[io][defects][tetgen]") {
  const Folder folder;
  REQUIRE(read(folder, {"good", node, ele, face, "", "", 0, ""}));
  const Defect defects[] = {
      {"no points", "", ele, face, "missing_file", "ele", 0, "a.node"},
      {"a plane", "1 2 0 0\n1 0 0\n", "", "", "unsupported_cells", "node", 1, "2 coordinates"},
      {"a triangulation", node, "1 3 0\n1 1 2 3\n", "", "unsupported_cells", "ele", 1, "3 points"},
      {"a count that no file can hold", "999999999 3\n1 0 0 0\n", ele, "", "count_too_big", "node",
       1, "999999999"},
      {"a huge number of attributes", "4 3 99999999\n1 0 0 0\n", ele, "", "count_too_big", "node",
       1, "99999999"},
      {"a count below 0", "-4 3\n1 0 0 0\n", ele, "", "bad_number", "node", 1, "-4"},
      {"points cut short", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1.000000000\n", ele, "", "wrong_count",
       "node", 4, "a coordinate"},
      {"too few points", "4 3 0 0\n1 0.000 0.00 0.00\n2 1.00 0.00 0.00\n3 0 1 0\n", ele, "",
       "truncated_file", "node", 5, "3 of 4"},
      {"too many points", node + "5 1 1 1\n", ele, "", "wrong_count", "node", 6, "4 points"},
      {"a gap in the numbers", "4 3 0 0\n1 0 0 0\n2 1 0 0\n4 0 1 0\n5 0 0 1\n", ele, "",
       "wrong_number", "node", 4, "point 4"},
      {"a word for a coordinate", "4 3 0 0\n1 0 0 0\n2 x 0 0\n3 0 1 0\n4 0 0 1\n", ele, "",
       "bad_number", "node", 3, "'x'"},
      {"a coordinate that is no number", "4 3 0 0\n1 0 0 0\n2 nan 0 0\n3 0 1 0\n4 0 0 1\n", ele, "",
       "nan_coordinate", "node", 3, "nan"},
      {"a marker flag of 2", "4 3 0 2\n1 0 0 0\n", ele, "", "count_too_big", "node", 1, "0 or 1"},
      {"a point that is not there", node, "1 4 1\n1 1 2 3 5 7\n", "", "index_out_of_range", "ele",
       2, "names point 5"},
      {"point 0 where they count from 1", node, "1 4 1\n1 0 1 2 3 7\n", "", "index_out_of_range",
       "ele", 2, "names point 0"},
      {"a repeated point", node, "1 4 1\n\n1 1 2 2 4 7\n", "", "repeated_vertex", "ele", 3,
       "1 2 2 4"},
      {"a missing attribute", node, "1 4 1\n1 1 2 3       4\n", "", "wrong_count", "ele", 2,
       "an attribute"},
      {"an empty file of cells", node, "# nothing\n", "", "truncated_file", "ele", 2,
       "number of tetrahedra"},
      {"a marker that is no integer", node, ele, "1 1\n1 1 2 3 0.5\n", "bad_number", "face", 2,
       "0.5"},
      {"a triangle too many", node, ele, face + "2 1 2 4 5\n", "wrong_count", "face", 3,
       "1 triangles"},
      {"a triangle of points that are not there", node, ele, "1 1\n1 1 2 9 5\n",
       "index_out_of_range", "face", 2, "point 9"},
  };
  for (const Defect& defect : defects) {
    const Result<FileMesh> mesh = read(folder, defect);
    INFO(defect.what << ": " << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    CHECK(std::ranges::count(mesh.findings, Severity::error, &Finding::severity) == 1);
    const Finding& f = mesh.findings.at(0);
    INFO(f.text << "; " << f.remedy);
    CHECK(f.code == defect.code);
    CHECK(f.line == defect.line);
    CHECK(f.file == (folder.path() / ("a." + defect.in)).string());
    CHECK(f.text.find(defect.says) != std::string::npos);
    CHECK(f.remedy.size() > 5);
  }
}

TEST_CASE("TetGen's files cut or changed at random are answered", "[io][damage][tetgen]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const Folder folder;
  const std::string names[] = {"tetgen.1.node", "tetgen.1.ele", "tetgen.1.face", "tetgen.1.edge"};
  constexpr const char* pieces[] = {"99999999999", "-1", "nan", "#", "", "4294967295", "\n", ".5"};
  for (int round = 0; round < 1500; ++round) {
    const std::size_t damaged = random() % std::size(names);
    for (std::size_t i = 0; i < std::size(names); ++i) {
      std::string text = bytes_of(sample(names[i]));
      if (i == damaged && round % 3 == 0) text.resize(random() % text.size());
      if (i == damaged && round % 3 != 0) {
        text.replace(random() % text.size(), random() % 4, pieces[random() % std::size(pieces)]);
      }
      std::ofstream(folder.path() / names[i], std::ios::binary) << text;
    }
    const Result<FileMesh> mesh = read_file_mesh(folder.path() / names[round % 4]);
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

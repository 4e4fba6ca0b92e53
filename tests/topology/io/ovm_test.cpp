// SPDX-License-Identifier: MIT
// OpenVolumeMesh's text: its half-edges and half-faces, properties, omitted contents; defects.
#include <algorithm>
#include <catch2/catch.hpp>
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

const std::string good = R"(OVM ASCII
Vertices
4
0 0 0
1 0 0
0 1 0
0 0 1
Edges
6
0 1
1 2
2 0
0 3
1 3
2 3
Faces
4
3 0 2 4
3 0 8 7
3 2 10 9
3 4 6 11
Polyhedra
1
4 0 3 5 7
)";

/// `good` with the first `from` made `to`.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("an OpenVolumeMesh file is read", "[io][ovm]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("by_hand.ovm"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "warning skipped_data 58");
  CHECK(mesh.findings[0].count == 2);
  CHECK(mesh->points.size() == 8);
  REQUIRE(mesh->tetrahedra.corners.size() == 2);
  CHECK(mesh->tetrahedra.corners[0] == std::array<std::uint32_t, 4>{0, 1, 2, 4});
  CHECK(mesh->triangles.corners == std::vector<std::array<std::uint32_t, 3>>{{5, 6, 7}});
  CHECK(mesh->triangles.region == std::vector<std::int32_t>{5});
  CHECK(mesh->edges.corners == std::vector<std::array<std::uint32_t, 2>>{{5, 0}});
  REQUIRE(mesh->tetrahedra.data.size() == 1);
  CHECK(mesh->tetrahedra.data[0].name == "stress");
  CHECK(std::get<0>(mesh->tetrahedra.data[0].values) == std::vector<double>{0.5, -1e-3});
  // Half-faces look inward, so that the volume is positive.
  const auto& [a, b, c, d] = mesh->tetrahedra.corners[0];
  const auto& p = mesh->points;
  double e[3][3];
  for (std::size_t k = 0; k < 3; ++k) {
    e[0][k] = p[b][k] - p[a][k];
    e[1][k] = p[c][k] - p[a][k];
    e[2][k] = p[d][k] - p[a][k];
  }
  CHECK(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]) >
        0);
}

TEST_CASE("sections are read in any case, among comments", "[io][ovm]") {
  std::string text =
      "# first\novm ascii\n" + changed("Vertices\n", "VERTICES # all\n#none\n").substr(10);
  text.replace(text.find(" # all"), 6, "");
  const Result<FileMesh> mesh = read_file_mesh(text, "a.ovm");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->tetrahedra.corners[0] == std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK(mesh->triangles.corners.empty());
  CHECK(mesh->edges.corners.empty());
}

TEST_CASE("tetrahedra of any turn and any neighbour come back as they were", "[io][ovm]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const Folder folder;
  for (int round = 0; round < 60; ++round) {
    FileMesh mesh;
    const std::size_t points = 4 + random() % 5;
    for (std::size_t i = 0; i < points; ++i) mesh.points.push_back({double(i), 0.5, -1e-9});
    const auto fill = [&](auto& cells, std::size_t n) {
      for (std::size_t i = 0; i < n; ++i) {
        std::vector<std::uint32_t> all(points);
        for (std::size_t k = 0; k < points; ++k) all[k] = static_cast<std::uint32_t>(k);
        std::shuffle(all.begin(), all.end(), random);
        auto& corners = cells.corners.emplace_back();
        std::copy_n(all.begin(), corners.size(), corners.begin());
        cells.region.push_back(static_cast<std::int32_t>(random() % 3));
        cells.source_id.push_back(static_cast<std::int64_t>(1000 * round) +
                                  7 * std::ssize(cells.corners));
      }
    };
    fill(mesh.edges, random() % 4);
    fill(mesh.triangles, random() % 6);
    fill(mesh.tetrahedra, 1 + random() % 8);
    REQUIRE_FALSE(has_error(write_file_mesh(folder.path() / "m.ovm", mesh)));
    const Result<FileMesh> back = read_file_mesh(folder.path() / "m.ovm");
    INFO(summary(back.findings));
    REQUIRE(back);
    CHECK(*back == mesh);
  }
}

TEST_CASE("data of any name and number of components come back", "[io][ovm]") {
  const Folder folder;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.region_name = {};
  for (const char* name : {"region", "", "a \"b\"", "100%", "x[0/1]", "source_cell_id"}) {
    for (const std::size_t n : {1, 2, 3, 4, 5, 9}) {
      std::vector<double> values(2 * n, 0.25);
      mesh.tetrahedra.data.push_back({name, n, NumberType::float64, std::move(values)});
    }
  }
  REQUIRE_FALSE(has_error(write_file_mesh(folder.path() / "m.ovm", mesh)));
  const Result<FileMesh> back = read_file_mesh(folder.path() / "m.ovm");
  INFO(summary(back.findings));
  REQUIRE(back);
  CHECK(back->tetrahedra == mesh.tetrahedra);
}

TEST_CASE("defects of OpenVolumeMesh's files are named", "[io][defects][ovm]") {
  REQUIRE(read_file_mesh(good, "bad file"));
  const Defect defects[] = {
      {"binary", changed("ASCII", "BINARY"), "unknown_version", 1, "'BINARY'"},
      {"no edges", changed("Edges", "Faces"), "wrong_count", 8, "'Faces'"},
      {"a huge count", changed("6\n0 1", "99999999\n0 1"), "count_too_big", 9, "99999999 edges"},
      {"a word for a coordinate", changed("1 0 0", "1 x 0"), "bad_number", 5, "'x'"},
      {"a coordinate that is no number", changed("1 0 0", "1 nan 0"), "nan_coordinate", 5, "nan"},
      {"a vertex that is not there", changed("2 3\n", "2 4\n"), "index_out_of_range", 15,
       "4 stands"},
      {"a half-edge that is not there", changed("6 11", "6 12"), "index_out_of_range", 21,
       "12 stands"},
      {"a half-edge the other way round", changed("3 0 2 4", "3 0 3 4"), "broken_face", 18,
       "face 0"},
      {"a half-face below 0", changed("4 0 3 5 7", "4 0 3 5 -7"), "index_out_of_range", 24, "-7"},
      {"a face twice", changed("4 0 3 5 7", "4 0 3 5 5"), "wrong_polyhedron", 24, "polyhedron 0"},
      {"a face less", changed("4 0 3 5 7", "3 0 3 5"), "unsupported_cells", 24, "1 polyhedra"},
      {"too many faces", changed("Polyhedra", "3 0 2 4\nPolyhedra"), "wrong_count", 22, "'3'"},
      {"cut short", good.substr(0, good.find("Polyhedra")), "truncated_file", 22, "Polyhedra"},
      {"a property without name", good + "CProp int region\n7\n", "bad_name", 25, "CProp"},
      {"a word for a value", good + "CProp int \"region\"\nseven\n", "bad_number", 26, "'seven'"},
      {"values that are not there", good + "VProp vec3d \"u\"\n1 2 3\n", "count_too_big", 26,
       "4 values"},
  };
  for (const Defect& defect : defects) {
    const Result<FileMesh> mesh = read_file_mesh(defect.text, "bad file", {.simplices = true});
    INFO(defect.what << ": " << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    CHECK(std::ranges::count(mesh.findings, Severity::error, &Finding::severity) == 1);
    const Finding& f = mesh.findings.at(0);
    INFO(f.text << "; " << f.remedy);
    CHECK(f.code == defect.code);
    CHECK(f.line == defect.line);
    CHECK(f.file == "bad file");
    CHECK(f.text.find(defect.says) != std::string::npos);
    CHECK(f.remedy.size() > 5);
  }
}

TEST_CASE("OpenVolumeMesh's files cut or changed at random are answered", "[io][damage][ovm]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::string samples[] = {good, bytes_of(sample("by_hand.ovm"))};
  constexpr const char* pieces[] = {"99999999999",      "-1", "nan", "#", "", "4", "\n",
                                    "CProp int \"a\"\n"};
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

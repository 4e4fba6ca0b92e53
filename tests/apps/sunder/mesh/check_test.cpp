// SPDX-License-Identifier: MIT
// `sunder check`: counts of known bodies, and defective inputs with one defect each.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

std::string io_sample(const std::string& name) {
  std::ifstream in(std::filesystem::path(SUNDER_IO_DATA) / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// MSH 4.1 with one change.
std::string msh_with(const std::string& from, const std::string& to) {
  return changed(io_sample("gmsh_41.msh"), from, to);
}

struct Defect {
  std::string what;
  std::string name;
  std::string bytes;
  std::string code;
  std::size_t line;
};

/// Files of which no mesh can be had.
std::vector<Defect> unreadable_files() {
  const std::string good = io_sample("gmsh_22.msh");
  const std::string medit = io_sample("gmsh.mesh");
  const std::string zlib = io_sample("meshio_zlib.vtu");
  return {
      {"empty", "a.msh", "", "empty_file", 0},
      {"garbage", "a.msh", "\x7f\x45\x4c\x46 and so on", "unknown_format", 0},
      {"version", "a.msh", msh_with("4.1 0 8", "5.0 0 8"), "unknown_version", 2},
      {"binary, cut", "a.msh", io_sample("gmsh_41_binary.msh").substr(0, 999), "truncated_file", 0},
      {"cut", "a.msh", good.substr(0, good.size() - 20), "truncated_file", 89},
      {"count too big", "a.msh", changed(good, "$Nodes\n23", "$Nodes\n230000"), "count_too_big",
       11},
      {"count wrong", "a.msh", changed(good, "$Nodes\n23", "$Nodes\n22"), "wrong_count", 34},
      {"no number", "a.msh", changed(good, "1 0 0 1", "1 O 0 1"), "bad_number", 12},
      {"number too big", "a.msh", changed(good, "1 0 0 1", "1 1e400 0 1"), "number_out_of_range",
       12},
      {"nan", "a.msh", changed(good, "1 0 0 1", "1 nan 0 1"), "nan_coordinate", 12},
      {"no such point", "a.msh", changed(good, "16 13 17 14", "16 13 17 99"), "index_out_of_range",
       42},
      {"repeated point", "a.msh", changed(good, "16 13 17 14", "16 13 17 13"), "repeated_vertex",
       42},
      {"section order", "a.msh", changed(good, "$Nodes", "$Elements\n0\n$EndElements\n$Nodes"),
       "wrong_section_order", 10},
      {"hexahedra", "a.msh", changed(good, "4 2 7 1 16 13 17 14", "5 2 7 1 16 13 17 14 1 2 3 4"),
       "unsupported_cells", 0},
      {"no tetrahedra", "a.mesh",
       changed(changed(medit, "Tetrahedra", "Tetraheda"), "Triangles", "Triangels"),
       "no_tetrahedron", 0},
      {"base64", "a.vtu", changed(zlib, "==eJx", "==e!x"), "bad_base64", 7},
      {"zlib", "a.vtu", changed(zlib, "==eJxj", "==eJyj"), "bad_zlib", 7},
      {"compressor", "a.vtu", io_sample("meshio_lzma.vtu"), "unsupported_compressor", 2},
      {"XML", "a.vtu", changed(zlib, "</Points>", "</Point>"), "bad_xml", 10},
  };
}

}  // namespace

TEST_CASE("check tells the counts of the sample meshes as JSON", "[apps][check]") {
  const Workplace here;
  const Outcome ring = here.run({"check", sample_mesh("ring.msh"), "--json"});
  CHECK(ring.exit_code == 0);
  CHECK(ring.err.empty());
  const auto json = ring.json();
  CHECK(json["counts"] == nlohmann::json::parse(R"({"file_vertices": 32, "vertices": 32,
      "edges": 112, "faces": 128, "tetrahedra": 48, "components": 1, "boundary_faces": 64,
      "boundary_sheets": 1})"));
  CHECK(json["euler_characteristic"] == 0);
  CHECK(json["betti"] == nlohmann::json::array({1, 1, 0}));
  CHECK(json["volume"].get<double>() == Approx(8).epsilon(1e-12));  // sum of 48 sixths
  CHECK(json["findings"].empty());
  CHECK(json["valid"] == true);
  CHECK(json["box"]["low"].size() == 3);
  CHECK(json["centre"].size() == 3);
  CHECK(json.size() == 10);
}

TEST_CASE("check tells box, centre and mass of a body, and what a surface is like",
          "[apps][check]") {
  const Workplace here;
  const auto body =
      here.run({"check", sample_mesh("cube.msh"), "--json", "--density", "1000"}).json();
  CHECK(body["mass"].get<double>() == Approx(1000 * body["volume"].get<double>()).epsilon(1e-14));
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(body["centre"][k].get<double>() ==
          Approx((body["box"]["low"][k].get<double>() + body["box"]["high"][k].get<double>()) / 2)
              .margin(1e-12));
  }
  REQUIRE(here.run({"convert", sample_mesh("cube.msh"), here.path("skin.ply")}).exit_code == 0);
  const Outcome told = here.run({"check", here.path("skin.ply"), "--json", "--density", "1000"});
  CHECK(told.exit_code == 0);
  const auto skin = told.json();
  CHECK(skin["closed"] == true);
  CHECK(skin["manifold"] == true);
  CHECK(skin["oriented"] == true);
  CHECK(skin["self_intersecting"] == false);
  CHECK(skin["volume"].get<double>() == Approx(body["volume"].get<double>()).epsilon(1e-12));
  CHECK(skin["mass"].get<double>() == Approx(body["mass"].get<double>()).epsilon(1e-12));
  CHECK(skin["box"] == body["box"]);
}

TEST_CASE("check refuses hexahedra with the remedy, and takes what --split makes of them",
          "[apps][check][convert]") {
  const Workplace here;
  std::ofstream(here.path("block.mesh"))
      << "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n"
         "0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\nHexahedra\n1\n1 2 3 4 5 6 7 8 7\nEnd\n";
  const Outcome refused = here.run({"check", here.path("block.mesh"), "--json"});
  CHECK(refused.exit_code == 3);
  CHECK(refused.json()["findings"][0]["code"] == "unsupported_cells");
  CHECK(refused.out.find("--split") != std::string::npos);
  const Outcome lost =
      here.run({"convert", here.path("block.mesh"), here.path("block.node"), "--strict"});
  CHECK(lost.exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(here.path("block.node")));
  REQUIRE(here.run({"convert", here.path("block.mesh"), here.path("block.vtu"), "--strict"})
              .exit_code == 0);
  REQUIRE(
      here.run({"convert", here.path("block.vtu"), here.path("split.msh"), "--split"}).exit_code ==
      0);
  const Outcome split = here.run({"check", here.path("split.msh"), "--json"});
  CHECK(split.exit_code == 0);
  CHECK(split.json()["volume"].get<double>() == Approx(1).epsilon(1e-14));
  CHECK(split.json()["counts"]["tetrahedra"] == 6);
}

TEST_CASE("check prints a table without --json", "[apps][check]") {
  const Workplace here;
  const Outcome cube = here.run({"check", sample_mesh("cube.msh")});
  CHECK(cube.exit_code == 0);
  CHECK(cube.out.find("tetrahedra                  48\n") != std::string::npos);
  CHECK(cube.out.find("Betti numbers            1 0 0\n") != std::string::npos);
  CHECK(cube.out.find("\nvalid\n") != std::string::npos);
}

TEST_CASE("a file without a readable mesh ends with 3 and one finding at its place",
          "[apps][check][defects]") {
  for (const Defect& defect : unreadable_files()) {
    const Workplace here;
    INFO(defect.what);
    const std::string path = here.write(defect.name, defect.bytes);
    const Outcome outcome = here.run({"check", path, "--json"});
    CHECK(outcome.exit_code == 3);
    const auto json = outcome.json();
    INFO(json.dump(1));
    REQUIRE(json["findings"].size() >= 1);
    const auto finding = json["findings"][0];
    CHECK(finding["code"] == defect.code);
    CHECK(finding["severity"] == "error");
    CHECK(finding["file"] == path);
    if (defect.line != 0) CHECK(finding["line"] == defect.line);
    CHECK(finding["remedy"].get<std::string>().size() > 5);
    CHECK(json["valid"] == false);
    CHECK(json["counts"]["vertices"].is_null());
    // Nothing is written from it either.
    const Outcome split =
        here.run({"split", path, "--plane", "1,0,0,0.5", "-o", here.path("o.msh")});
    CHECK(split.exit_code == 3);
    CHECK(split.err.find(defect.code) != std::string::npos);
    CHECK(here.names() == std::vector<std::string>{defect.name});
  }
}

TEST_CASE("a mesh with wrong cells ends with 1 and one error of that name",
          "[apps][check][defects]") {
  struct Case {
    std::string code;
    TetMesh mesh;
  };
  const TetMesh one = one_tetrahedron();
  TetMesh flat = two_tetrahedra(), twice = one, mirrored = one, overfull = two_tetrahedra();
  flat.points[4] = {0.25, 0.25, 0};
  twice.tetrahedra.push_back(one.tetrahedra[0]);
  mirrored.tetrahedra.push_back({1, 0, 2, 3});
  overfull.points.push_back({-1, -1, 2});
  overfull.tetrahedra.push_back({0, 1, 2, 5});
  for (const auto& [code, mesh] :
       {Case{"flat_tetrahedron", flat}, Case{"duplicate_tetrahedron", twice},
        Case{"mirrored_tetrahedron", mirrored}, Case{"overfull_face", overfull},
        Case{"non_orientable", joined_ring(4, true)}}) {
    const Workplace here;
    const Outcome outcome = here.run({"check", here.write("a.msh", mesh), "--json"});
    const auto json = outcome.json();
    INFO(json.dump(1));
    CHECK(outcome.exit_code == 1);
    std::vector<std::string> errors;
    for (const auto& f : json["findings"]) {
      if (f["severity"] == "error") errors.push_back(f["code"]);
    }
    REQUIRE_FALSE(errors.empty());
    CHECK(errors.front() == code);
    // Volumes at the seam of the twisted ring mean nothing, and one is flat.
    CHECK((errors.size() == 1 || code == "non_orientable"));
    CHECK(json["valid"] == false);
    CHECK(json["counts"]["tetrahedra"] == mesh.tetrahedra.size());
    CHECK(json["counts"]["file_vertices"] == mesh.points.size());
  }
}

TEST_CASE("what is odd but sound ends with 0 and is told", "[apps][check][defects]") {
  TetMesh inverted = two_tetrahedra(), unused = inverted, coincident = inverted;
  std::swap(inverted.tetrahedra[1][0], inverted.tetrahedra[1][1]);
  unused.points.push_back({5, 5, 5});
  coincident.points.push_back(coincident.points[0]);
  coincident.tetrahedra[1] = {1, 5, 2, 4};
  struct Case {
    std::string code;
    std::string severity;
    TetMesh mesh;
  };
  for (const auto& [code, severity, mesh] :
       {Case{"inverted_tetrahedron", "warning", inverted}, Case{"unused_point", "note", unused},
        Case{"coincident_points", "note", coincident},
        Case{"pinched_edge", "note", two_tetrahedra_sharing_an_edge()},
        Case{"pinched_vertex", "note", two_tetrahedra_sharing_a_vertex()}}) {
    const Workplace here;
    const Outcome outcome = here.run({"check", here.write("a.msh", mesh), "--json"});
    const auto json = outcome.json();
    INFO(code << ": " << json.dump(1));
    CHECK(outcome.exit_code == 0);
    bool found = false;
    for (const auto& f : json["findings"]) {
      found = found || (f["code"] == code && f["severity"] == severity && f["count"] >= 1);
    }
    CHECK(found);
    CHECK(json["valid"] == true);
  }
}

TEST_CASE("fixtures 3 and 4: touching bodies have more vertices than the file", "[apps][check]") {
  const Workplace here;
  const auto edge =
      here.run({"check", here.write("e.msh", two_tetrahedra_sharing_an_edge()), "--json"}).json();
  CHECK(edge["counts"]["file_vertices"] == 6);
  CHECK(edge["counts"]["vertices"] == 8);
  CHECK(edge["counts"]["edges"] == 12);
  CHECK(edge["counts"]["components"] == 2);
  const auto vertex =
      here.run({"check", here.write("v.msh", two_tetrahedra_sharing_a_vertex()), "--json"}).json();
  CHECK(vertex["counts"]["file_vertices"] == 7);
  CHECK(vertex["counts"]["vertices"] == 8);
  CHECK(vertex["euler_characteristic"] == 2);
}

TEST_CASE("a body without boundary has its homology told, with torsion", "[apps][check]") {
  const Workplace here;
  const auto sphere =
      here.run({"check", here.write("s.msh", closed_simplex_boundary()), "--json"}).json();
  INFO(sphere.dump(1));
  CHECK(sphere["betti"] == nlohmann::json::array({1, 0, 0}));
  CHECK(sphere["homology"]["betti"] == nlohmann::json::array({1, 0, 0, 1}));
  CHECK(sphere["homology"]["torsion"] == nlohmann::json::parse("[[], [], [], []]"));
}

TEST_CASE("a body that cannot lie in space has the Betti numbers of its homology",
          "[apps][check]") {
  const Workplace here;
  // A lens space less a ball, as the topology suite has it: one sheet, H1 = Z/3.
  const auto fixtures = sunder::suite::read_fixtures(SUNDER_MESHES "/suite/30-lens-spaces.json");
  REQUIRE(fixtures);
  const auto lens = std::find_if(fixtures->begin(), fixtures->end(), [](const auto& f) {
    return f.name.find("lens-3-1-less-a-ball") != std::string::npos;
  });
  REQUIRE(lens != fixtures->end());
  const auto json = here.run({"check", here.write("l.msh", lens->body), "--json"}).json();
  CHECK(json["betti"] == nlohmann::json::array({1, 0, 0}));
  CHECK(json["homology"]["torsion"] == nlohmann::json::parse("[[], [3], [], []]"));
  const auto ring =
      here.run({"check", here.write("r.msh", sunder::suite::ring({3, 3, 1})), "--json"});
  CHECK_FALSE(ring.json().contains("homology"));
}

namespace {

/// A hollow cube with a bar from the inside of its wall through the opposite wall and round to the
/// outside: its cells lie over those of that wall, of which they share nothing.
TetMesh bar_through_a_wall() {
  TetMesh mesh;
  std::map<std::array<int, 4>, std::uint32_t> rows;  // grid point; whether it is the bar's own
  const auto add_cube = [&](int x, int y, int z, bool is_bar) {
    const auto point = [&](std::array<int, 3> c) {
      const bool own = is_bar && c[0] >= 2 && c[2] < 3;
      const auto [at, is_new] =
          rows.try_emplace({c[0], c[1], c[2], own}, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back({c[0] + (own ? 0.2 : 0.0), double(c[1]), double(c[2])});
      return at->second;
    };
    std::array<int, 3> order = {0, 1, 2};
    do {
      std::array<int, 3> c = {x, y, z};
      std::array<std::uint32_t, 4> tet = {point(c), 0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        ++c[std::size_t(order[k])];
        tet[k + 1] = point(c);
      }
      const bool is_odd = (order[0] > order[1]) ^ (order[1] > order[2]) ^ (order[0] > order[2]);
      if (is_odd) std::swap(tet[2], tet[3]);
      mesh.tetrahedra.push_back(tet);
    } while (std::next_permutation(order.begin(), order.end()));
  };
  for (int k = 0; k < 27; ++k) {
    if (k != 13) add_cube(k % 3, k / 3 % 3, k / 9, false);
  }
  for (const auto& [x, z] : {std::pair{1, 1}, {2, 1}, {3, 1}, {3, 2}, {3, 3}, {2, 3}})
    add_cube(x, 1, z, true);
  return mesh;
}

}  // namespace

TEST_CASE("a body that overlaps itself is not valid, and its Betti numbers are its own",
          "[apps][check]") {
  const Workplace here;
  const auto said = here.run({"check", here.write("bar.msh", bar_through_a_wall()), "--json"});
  INFO(said.text());
  CHECK(said.exit_code == 1);
  const auto json = said.json();
  CHECK(json["betti"] == nlohmann::json::array({1, 1, 1}));
  CHECK(json["valid"] == false);
  CHECK(std::ranges::any_of(json["findings"],
                            [](const auto& f) { return f["code"] == "overlapping_body"; }));
  // Without the bar the sheets give them.
  const auto shell = here.run({"check", here.write("s.msh", suite::shell({3, 3, 3})), "--json"});
  CHECK(shell.exit_code == 0);
  CHECK(shell.json()["betti"] == nlohmann::json::array({1, 0, 1}));
  const auto asked = here.run({"check", here.path("s.msh"), "--json", "--homology"});
  CHECK(asked.json()["homology"]["betti"] == nlohmann::json::array({1, 0, 1, 0}));
}

TEST_CASE("check measures the tetrahedra", "[apps][check]") {
  const Workplace here;
  const auto quality = here.run({"check", sample_mesh("ring.msh"), "--json"}).json()["quality"];
  CHECK(quality["dihedral_angle"]["smallest"] == nlohmann::json{{"value", 45}, {"tetrahedron", 0}});
  CHECK(quality["dihedral_angle"]["largest"]["value"] == 90);
  CHECK(quality["volume"]["ratio"] == 1);
  CHECK(quality["edge"]["shortest"]["value"] == 1);
  CHECK(quality["radius_ratio"]["mean"].get<double>() == Approx(0.7174).epsilon(1e-4));
}

TEST_CASE("check holds a file's triangles against its tetrahedra", "[apps][check]") {
  const Workplace here;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.triangles.corners = {{0, 1, 2}, {0, 3, 4}, {0, 1, 3}};
  REQUIRE(write_file_mesh(here.path("a.msh"), mesh).empty());
  const Outcome outcome = here.run({"check", here.path("a.msh"), "--json"});
  const auto findings = outcome.json()["findings"];
  CHECK(outcome.exit_code == 0);
  REQUIRE(findings.size() == 2);
  CHECK(findings[0]["code"] == "stray_triangle");
  CHECK(findings[0]["ids"] == nlohmann::json::array({1}));
  CHECK(findings[0]["file"] == here.path("a.msh"));
  CHECK(findings[1]["code"] == "interface_triangle");
}

TEST_CASE("check writes the cells that findings name, all of them, in any format",
          "[apps][check][findings]") {
  TetMesh mesh = kuhn_box({3, 3, 3});
  for (std::size_t t = 0; t < 40; ++t) std::swap(mesh.tetrahedra[t][0], mesh.tetrahedra[t][1]);
  mesh.points.push_back({5, 5, 5});
  for (const char* name : {"look.vtu", "look.msh", "look.mesh", "look.vtk"}) {
    INFO(name);
    const Workplace here;
    const std::string path = here.write("a.msh", mesh);
    const Outcome outcome =
        here.run({"check", path, "--json", "--write-findings", here.path(name)});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.json()["findings_file"]["cells"] == 41);
    CHECK(outcome.json()["findings_file"]["path"] == here.path(name));
    const auto cells = read_file_mesh(here.path(name));
    REQUIRE(cells);
    CHECK(cells->tetrahedra.corners.size() == 40);
    CHECK(cells->tetrahedra.region == std::vector<std::int32_t>(40, 1));
    CHECK(cells->region_name[3].at(1) == "inverted_tetrahedron");
    if (std::string(name) != "look.vtu") continue;
    CHECK(cells->vertices.corners.size() == 1);
    CHECK(cells->region_name[0].at(2) == "unused_point");
    const auto& rows = std::get<std::vector<std::int64_t>>(cells->tetrahedra.data.at(1).values);
    CHECK(cells->tetrahedra.data.at(1).name == "row");
    for (std::int64_t t = 0; t < 40; ++t) CHECK(rows[static_cast<std::size_t>(t)] == t);
  }
}

TEST_CASE("check writes no mesh of findings where none names a cell", "[apps][check][findings]") {
  const Workplace here;
  const Outcome fine =
      here.run({"check", sample_mesh("cube.msh"), "--write-findings", here.path("look.vtu")});
  CHECK(fine.exit_code == 0);
  CHECK(fine.out.find("nothing is written") != std::string::npos);
  const Outcome unread = here.run(
      {"check", here.write("a.msh", "nothing"), "--write-findings", here.path("look.vtu")});
  CHECK(unread.exit_code == 3);
  CHECK(here.names() == std::vector<std::string>{"a.msh"});
}

TEST_CASE("check tells where the mesh of findings cannot be written", "[apps][check][findings]") {
  const Workplace here;
  TetMesh mesh = one_tetrahedron();
  mesh.points.push_back({5, 5, 5});
  const std::string path = here.write("a.msh", mesh);
  const Outcome folder =
      here.run({"check", path, "--json", "--write-findings", here.path("no/such/look.vtu")});
  CHECK(folder.exit_code == 4);
  CHECK(folder.json()["findings"][0]["code"] == "cannot_write");
  CHECK(folder.json()["findings_file"]["path"].is_null());
  CHECK(here.run({"check", path, "--write-findings", here.path("look.png")}).exit_code == 2);
  CHECK(here.run({"check", path, "--write-findings", path}).exit_code == 2);
  CHECK(here.names() == std::vector<std::string>{"a.msh"});
}

TEST_CASE(
    "above 200 000 tetrahedra Betti numbers are those of sheets, and none where faces overlap",
    "[apps][check]") {
  const Workplace here;
  TetMesh mesh = suite::kuhn_box({33, 33, 31});
  const auto numbers = [&](const char* name) {
    const auto json = here.run({"check", here.write(name, mesh), "--json"}).json();
    CHECK(std::ranges::count(json["findings"], "betti_by_sheets", [](const auto& f) {
            return f["code"].template get<std::string>();
          }) == 1);
    return json["betti"];
  };
  CHECK(numbers("box.msh") == nlohmann::json::array({1, 0, 0}));
  // A tetrahedron with its tip inside the box.
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{3.3, 4.4, 30}, {3, 4, 33}, {4, 4, 33}, {3, 5, 33}});
  mesh.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
  CHECK(numbers("tip.msh").is_null());
}

// SPDX-License-Identifier: MIT
// `sunder split`: the paper's figures and some of the suite's fixtures through the command.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;
using nlohmann::json;

namespace {

/// (vertices, edges) that split, an exclamation mark for the oracle's yes, N for a new component.
std::string events(const json& answer) {
  std::string out;
  for (const json& split : answer["splits"]) {
    if (!out.empty()) out += " ";
    if (split.contains("error")) {
      out += "refused";
      continue;
    }
    out += fmt::format("({},{})", split["split_vertices"].size(), split["split_edges"].size());
    if (split["oracle"]) out += "!";
    if (split["new_component"]) out += "N";
  }
  return out;
}

/// V, E, F, T, CC, chi.
std::vector<int> counts(const json& side) {
  return {side["vertices"],   side["edges"],      side["faces"],
          side["tetrahedra"], side["components"], side["euler_characteristic"]};
}

json split_faces(const Workplace& here, const std::string& mesh, const std::string& faces) {
  const Outcome outcome =
      here.run({"split", mesh, "--faces", here.write("faces.txt", faces), "--json"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  return outcome.json();
}

}  // namespace

TEST_CASE("figure 4: the oracle is wrong at the first section of a ring, right at the second",
          "[apps][split][figure4]") {
  const Workplace here;
  const json answer =
      split_faces(here, sample_mesh("ring.msh"), "1 5 21\n1 17 21\n9 13 29\n9 25 29\n");
  CHECK(events(answer) == "(1,2) (3,3)! (1,2) (3,3)!N");
  CHECK(counts(answer["before"]) == std::vector{32, 112, 128, 48, 1, 0});
  CHECK(counts(answer["after"]) == std::vector{40, 122, 132, 48, 2, 2});
  CHECK(answer["before"]["betti"] == json::array({1, 1, 0}));
  CHECK(answer["after"]["betti"] == json::array({2, 0, 0}));
  CHECK(answer["splits"][0]["face"] == json::array({1, 5, 21}));
  CHECK(answer["splits"][0]["split_vertices"] == json::array({5}));
  CHECK(answer["splits"][0]["split_edges"] == json::parse("[[1, 5], [5, 21]]"));
  CHECK(answer["before"]["file_vertices"] == 32);
}

TEST_CASE("figure 5: the order of a fan's faces decides what the oracle says",
          "[apps][split][figure5]") {
  const std::string a = "1 4 14\n", b = "4 14 17\n", c = "4 7 17\n";
  const Workplace here;
  for (const auto& [order, expected] : {std::pair{a + b + c, "(0,1) (0,2) (3,3)!"},
                                        {b + a + c, "(0,1) (0,2) (3,3)!"},
                                        {a + c + b, "(0,1) (1,2) (2,3)"},
                                        {b + c + a, "(0,1) (2,3) (1,2)"},
                                        {c + a + b, "(1,2) (0,1) (2,3)"},
                                        {c + b + a, "(1,2) (1,2) (1,2)"}}) {
    const json answer = split_faces(here, sample_mesh("cube.msh"), order);
    CHECK(events(answer) == expected);
    CHECK(counts(answer["after"]) == std::vector{30, 104, 123, 48, 1, 1});
  }
}

TEST_CASE("fixture 7: the octahedron comes apart at its fourth face", "[apps][split]") {
  const Workplace here;
  const std::string mesh = here.write("octahedron.msh", octahedron_star());
  const json around = split_faces(here, mesh, "0 1 2\n0 2 3\n0 3 4\n0 4 1\n");
  CHECK(counts(around["before"]) == std::vector{7, 18, 20, 8, 1, 1});
  CHECK(events(around) == "(0,1) (1,2) (1,2) (3,3)!N");
  CHECK(counts(around["after"]) == std::vector{12, 26, 24, 8, 2, 2});
  CHECK(events(split_faces(here, mesh, "0 1 2\n0 3 4\n0 2 3\n0 4 1\n")) ==
        "(0,1) (0,1) (2,3) (3,3)!N");
  const json once = split_faces(here, mesh, "2 0 1\n");
  CHECK(once["after"]["edges"] == 19);
  CHECK(once["after"]["faces"] == 21);
  CHECK(once["splits"][0]["face"] == json::array({2, 0, 1}));
}

TEST_CASE("the octahedron by its plane and by its fan comes apart the same", "[apps][split]") {
  const Workplace here;
  const std::string mesh = here.write("octahedron.msh", octahedron_star());
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--plane", "0,0,-2,0"}, {"--fan", "0,0,0,1"}}) {
    const Outcome outcome = here.run({"split", mesh, how[0], how[1], "--json"});
    CHECK(outcome.exit_code == 0);
    const json answer = outcome.json();
    CHECK(answer["splits"].size() == 4);
    CHECK(answer["after"]["components"] == 2);
  }
}

TEST_CASE("fixture 5: each cut of a closed fan after the first frees one tetrahedron",
          "[apps][split]") {
  const Workplace here;
  const json answer =
      split_faces(here, here.write("fan.msh", closed_fan(4)), "0 1 2\n0 1 3\n0 1 4\n0 1 5\n");
  CHECK(events(answer) == "(1,2) (3,3)!N (3,3)!N (3,3)!N");
  CHECK(answer["after"]["components"] == 4);
  CHECK(answer["after"]["vertices"] == 16);
}

TEST_CASE("a face that is not interior is told and changes nothing", "[apps][split]") {
  const Workplace here;
  const json answer = split_faces(here, sample_mesh("two_tets.msh"),
                                  "# the surface, nothing at all, the common face twice\n"
                                  "0 1 3\n\n0 3 4 # none\n77 1 2\n2 1 0\n0 1 2\n");
  CHECK(events(answer) == "refused refused refused (3,3)!N refused");
  CHECK(answer["splits"][0]["face"] == json::array({0, 1, 3}));
  CHECK(answer["splits"][0].size() == 2);
  CHECK(answer["splits"][1]["error"] == "no tetrahedron has a face on these points");
  CHECK(answer["splits"][3]["face"] == json::array({2, 1, 0}));
  CHECK(counts(answer["after"]) == std::vector{8, 12, 8, 2, 2, 2});
}

TEST_CASE("the paper's order takes faces at the surface first, with the same end",
          "[apps][split]") {
  const Workplace here;
  const std::string mesh = here.write("box.msh", kuhn_box({4, 4, 2}));
  const auto cut = [&](const std::string& order) {
    const Outcome outcome =
        here.run({"split", mesh, "--plane", "0,0,1,1", "--order", order, "--json"});
    CHECK(outcome.exit_code == 0);
    return outcome.json();
  };
  const json given = cut("given"), paper = cut("paper");
  CHECK(given["after"] == paper["after"]);
  CHECK(given["splits"].size() == 32);
  std::set<json> faces_given, faces_paper;
  for (const json& split : given["splits"]) faces_given.insert(split["face"]);
  for (const json& split : paper["splits"]) faces_paper.insert(split["face"]);
  CHECK(faces_given == faces_paper);
  // A square of 4 x 4 cells, two triangles each, has 16 edges on the surface and 14 triangles at
  // least with one of them: two corners of the square hold two each.
  const auto at_surface = [](const json& face) {
    int edges = 0;
    for (int i = 0; i < 3; ++i) {
      const int a = face[i].get<int>() % 25, b = face[(i + 1) % 3].get<int>() % 25;
      edges += (a % 5 == b % 5 && a % 5 % 4 == 0) || (a / 5 == b / 5 && a / 5 % 4 == 0);
    }
    return edges > 0;
  };
  int first_inside = 0;
  while (at_surface(paper["splits"][first_inside]["face"])) ++first_inside;
  CHECK(first_inside == 14);
  for (int i = first_inside; i < 32; ++i) CHECK_FALSE(at_surface(paper["splits"][i]["face"]));
  CHECK_FALSE(given["splits"] == paper["splits"]);
}

TEST_CASE("the cut mesh has its vertices doubled and a region a component", "[apps][split]") {
  const std::string name = GENERATE("o.msh", "o.vtu");
  const Workplace here;
  const Outcome outcome = here.run(
      {"split", sample_mesh("ring.msh"), "--plane", "1,0,0,1", "-o", here.path(name), "--json"});
  CHECK(outcome.exit_code == 0);
  const json after = outcome.json()["after"];
  const Result<TetMesh> cut = read_mesh(std::filesystem::path(here.path(name)));
  REQUIRE(cut);
  CHECK(cut->points.size() == after["vertices"].get<std::size_t>());
  CHECK(std::set(cut->region.begin(), cut->region.end()) == std::set<std::int32_t>{1, 2});
  json checked = here.run({"check", here.path(name), "--json"}).json()["counts"];
  for (const char* key : {"vertices", "edges", "faces", "components", "boundary_sheets"}) {
    CHECK(checked[key] == after[key]);
  }
  CHECK(here.names() == std::vector<std::string>{name});
}

TEST_CASE("the three oracles answer alike and visit less and less", "[apps][split][oracle]") {
  const Workplace here;
  const auto answer = [&](const std::string& mesh, const std::string& oracle) {
    const Outcome outcome =
        here.run({"split", mesh, "--plane", "1,0.2,0,1.3", "--oracle", oracle, "--json"});
    CHECK(outcome.exit_code == 0);
    return outcome.json();
  };
  for (const std::string& mesh : {sample_mesh("ring.msh"), here.write("b.msh", ring({5, 4, 2}))}) {
    std::vector<std::size_t> visited;
    std::vector<json> answers;
    for (const std::string oracle : {"walk", "paper", "exact"}) {
      answers.push_back(answer(mesh, oracle));
      visited.push_back(answers.back()["visited"]);
      std::size_t sum = 0;
      for (json& split : answers.back()["splits"]) {
        sum += split["visited"].get<std::size_t>();
        split.erase("visited");
      }
      CHECK(sum == visited.back());
      answers.back().erase("visited");
    }
    CHECK(answers[0] == answers[1]);
    CHECK(answers[0] == answers[2]);
    CHECK(visited[0] > visited[1]);
    CHECK(visited[1] > visited[2]);
  }
  const Outcome table =
      here.run({"split", sample_mesh("ring.msh"), "--plane", "1,0,0,1.01", "--oracle", "paper"});
  CHECK(table.out.find("visited by the search for components") != std::string::npos);
  CHECK(here.run({"split", sample_mesh("ring.msh"), "--plane", "1,0,0,1", "--oracle", "delphi"})
            .exit_code == 2);
}

TEST_CASE("the paper's oracle walks the whole component at each yes, the walk at each face",
          "[apps][split][oracle][figure4]") {
  const Workplace here;
  const std::string faces = here.write("faces.txt", "1 5 21\n1 17 21\n9 13 29\n9 25 29\n");
  const auto visited = [&](const std::string& oracle) {
    const json answer =
        here.run({"split", sample_mesh("ring.msh"), "--faces", faces, "--oracle", oracle, "--json"})
            .json();
    std::vector<std::size_t> counts;
    for (const json& split : answer["splits"]) counts.push_back(split["visited"]);
    return counts;
  };
  CHECK(visited("walk") == std::vector<std::size_t>{48, 48, 48, 48});
  CHECK(visited("paper") == std::vector<std::size_t>{0, 48, 0, 48});
  const auto exact = visited("exact");
  CHECK(exact[0] == 0);
  CHECK(exact[2] == 0);
  CHECK(exact[3] <= 48);
}

TEST_CASE("cuts that vertex numbers cannot tell are listed beside, and give the same map again",
          "[apps][split][cuts]") {
  const std::string end = GENERATE(".msh", ".vtu");
  const Workplace here;
  const std::string mesh = here.write("box.msh", kuhn_box({4, 4, 4}));
  // Fixture 12: a crack of two faces inside the body.
  const std::string faces = here.write("faces.txt", "32 37 62\n32 57 62\n");
  const std::string once = here.path("once" + end), twice = here.path("twice" + end);
  const json first = here.run({"split", mesh, "--faces", faces, "-o", once, "--json"}).json();
  CHECK(here.names() ==
        std::vector<std::string>{"box.msh", "faces.txt", "once" + end, "once" + end + ".cuts"});
  CHECK(first["findings"].back()["code"] == "cuts_beside");
  CHECK(first["findings"].back()["count"] == 2);
  CHECK(here.run({"check", once, "--json"}).json()["counts"]["faces"] == 864);
  const Outcome again = here.run({"split", once, "--faces", once + ".cuts", "-o", twice, "--json"});
  CHECK(again.exit_code == 0);
  CHECK(again.json()["after"] == first["after"]);
  const Result<TetMesh> a = read_mesh(std::filesystem::path(once)),
                        b = read_mesh(std::filesystem::path(twice));
  CHECK(a->tetrahedra == b->tetrahedra);
  CHECK(a->points == b->points);
  CHECK(a->region == b->region);
  // Without such cuts the list of an earlier run is removed; a file that is none of ours is not.
  CHECK(here.run({"split", mesh, "--plane", "0,0,1,2", "-o", once}).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(once + ".cuts"));
  here.write("twice" + end + ".cuts", "0 1 2\n");
  CHECK(here.run({"split", mesh, "--plane", "0,0,1,2", "-o", twice}).exit_code == 0);
  CHECK(std::filesystem::exists(twice + ".cuts"));
}

TEST_CASE("random cuts of many bodies are restored by the mesh and its list",
          "[apps][split][cuts]") {
  const std::uint64_t seed = 71;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const Workplace here;
  for (const NamedMesh& shape : all_shapes()) {
    if (shape.mesh.tetrahedra.size() < 20) continue;
    INFO(shape.name);
    const std::string mesh = here.write("a.msh", shape.mesh);
    std::string list;
    for (const auto& t : shape.mesh.tetrahedra) {
      if (below(random, 6) == 0) list += fmt::format("{} {} {}\n", t[0], t[1], t[2]);
    }
    const std::string once = here.path("b.vtu"), cuts = once + ".cuts", twice = here.path("c.vtu");
    const json first =
        here.run({"split", mesh, "--faces", here.write("f.txt", list), "-o", once, "--json"})
            .json();
    if (!std::filesystem::exists(cuts)) here.write("b.vtu.cuts", "");
    const json second = here.run({"split", once, "--faces", cuts, "-o", twice, "--json"}).json();
    for (const char* key : {"vertices", "edges", "faces", "components", "boundary_sheets"}) {
      CHECK(first["after"][key] == second["after"][key]);
    }
    CHECK(read_mesh(std::filesystem::path(once))->tetrahedra ==
          read_mesh(std::filesystem::path(twice))->tetrahedra);
    std::filesystem::remove(cuts);
  }
}

TEST_CASE("the same command gives the same bytes", "[apps][split]") {
  const Workplace here;
  const auto bytes = [&](const std::string& name) {
    const Outcome outcome = here.run({"split", sample_mesh("bunny.msh"), "--plane", "0,0,1,0.07",
                                      "-o", here.path(name), "--json"});
    CHECK(outcome.exit_code == 0);
    return std::pair{json(outcome.json()["splits"]).dump(), read_mesh(here.path(name))->tetrahedra};
  };
  CHECK(bytes("a.vtu") == bytes("b.vtu"));
}

TEST_CASE("an output that cannot be written ends with 4, with the answer still printed",
          "[apps][split]") {
  const Workplace here;
  for (const std::string& place : {here.path("no/such/folder.msh"), here.path("o.step")}) {
    const Outcome outcome = here.run(
        {"split", sample_mesh("two_tets.msh"), "--plane", "0,0,1,0", "-o", place, "--json"});
    CHECK(outcome.exit_code == 4);
    CHECK(events(outcome.json()) == "(3,3)!N");
    CHECK(outcome.err.find(place) != std::string::npos);
    CHECK(here.names().empty());
  }
}

TEST_CASE("a list of faces that cannot be read ends with 3 at its line", "[apps][split]") {
  const Workplace here;
  const std::string mesh = sample_mesh("two_tets.msh");
  for (const std::string line :
       {"1 2", "1 2 3 4", "1 2 x", "1 2 -3", "1 2 3.5", "1 2 99999999999"}) {
    const std::string faces = here.write("faces.txt", "0 1 2\n" + line + "\n");
    const Outcome outcome = here.run({"split", mesh, "--faces", faces, "--json"});
    INFO(line << ": " << outcome.err);
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.json()["findings"][0]["code"] == "bad_face");
    CHECK(outcome.json()["findings"][0]["line"] == 2);
  }
  CHECK(here.run({"split", mesh, "--faces", here.path("none.txt")}).exit_code == 3);
}

TEST_CASE("a mesh with wrong cells is not split", "[apps][split]") {
  const Workplace here;
  TetMesh twice = one_tetrahedron();
  twice.tetrahedra.push_back(twice.tetrahedra[0]);
  const Outcome outcome = here.run(
      {"split", here.write("a.msh", twice), "--plane", "1,0,0,0", "-o", here.path("o.msh")});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err.find("duplicate_tetrahedron") != std::string::npos);
  CHECK(here.names() == std::vector<std::string>{"a.msh"});
}

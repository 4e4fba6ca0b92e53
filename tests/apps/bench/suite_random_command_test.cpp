// SPDX-License-Identifier: MIT
// `sunder suite --random` from outside: table, JSON, exit codes, fixtures of failures.
#include <catch2/catch.hpp>
#include <string>

#include "tests/support/program.hpp"
#include "topology/base/tet_mesh.hpp"

using namespace sunder::test;

namespace {

/// Wrong from its split number `begins` on.
std::string liar(const std::string& lie, const std::string& begins) {
  return std::string(SUNDER_PYTHON) + " " + SUNDER_ADAPTERS + "/liar.py " + lie + " " + begins;
}

}  // namespace

TEST_CASE("a random run prints a table, the checks made and its seed", "[suite][random][command]") {
  const Workplace here;
  const Outcome outcome = here.run({"suite", "--random", "60", "--seed", "3"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  for (const char* text : {"kernel sunder, seed 3", "closed spheres", "Checks made",
                           "single comparisons", "60 fans and ", " by labels, 0 mismatches"}) {
    CHECK(outcome.out.find(text) != std::string::npos);
  }
}

TEST_CASE("the JSON of a random run has the same numbers each time", "[suite][random][command]") {
  const Workplace here;
  const std::vector<std::string> words = {
      "suite", "--random", "40", "--json", "--kernel", "twin", "--mesh", sample_mesh("ring.msh")};
  const auto json = here.run(words).json();
  REQUIRE(json.is_object());
  CHECK(json["seed"] == 1);
  const auto& run = json["runs"][0];
  CHECK(run["kernel"] == "twin");
  CHECK(run["mismatches"] == 0);
  CHECK(run["total"]["done"]["fans"] == 40);
  CHECK(run["families"].size() == 16);
  CHECK(run["families"].back()["family"] == "ring.msh");
  CHECK(run["families"].back()["done"]["fans"] > 0);
  CHECK(run["total"]["done"]["missed"] == 0);
  CHECK(here.run(words).json()["runs"][0]["families"] == run["families"]);
}

TEST_CASE("a lying kernel ends a random run with 1 and a fixture that shows the lie",
          "[suite][random][command]") {
  const Workplace here;
  const std::string kernel = liar("forgets-a-vertex", "0");
  const Outcome outcome = here.run({"suite", "--random", "60", "--kernel", kernel, "--json"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 1);
  const auto run = outcome.json()["runs"][0];
  CHECK(run["mismatches"] == 1);
  const auto& failure = run["families"].back()["failure"];
  CHECK(failure["first"]["what"].get<std::string>().find("split vertices") == 0);
  CHECK(failure["repeats"] == true);
  CHECK(failure["fixture"]["cases"][0]["body"]["tetrahedra"].size() == 2);
  CHECK(failure["fixture"]["cases"][0]["operations"].size() == 1);
  here.write("lie.json", failure["fixture"].dump());
  CHECK(here.run({"suite", "--fixtures", here.path(""), "--kernel", kernel}).exit_code == 1);
  CHECK(here.run({"suite", "--fixtures", here.path(""), "--kernel", "twin"}).exit_code == 0);
}

TEST_CASE("a kernel that dies in a random run is told, and the run ends",
          "[suite][random][command]") {
  const Workplace here;
  const Outcome outcome = here.run({"suite", "--random", "30", "--kernel", liar("dies", "40")});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("the kernel: expected an answer") != std::string::npos);
}

TEST_CASE("what cannot be run at random is refused", "[suite][random][command]") {
  const Workplace here;
  CHECK(here.run({"suite", "--random", "0"}).exit_code == 2);
  CHECK(here.run({"suite", "--random", "-4"}).exit_code == 2);
  CHECK(here.run({"suite", "--seed", "4"}).exit_code == 2);
  CHECK(here.run({"suite", "figure", "--random", "10"}).exit_code == 2);
  CHECK(here.run({"suite", "--random", "10", "--mesh", "absent.msh"}).exit_code == 3);
  // Three tetrahedra on one face: no map of it can be.
  sunder::TetMesh overfull;
  overfull.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
  overfull.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  const std::string file = here.write("overfull.msh", overfull);
  const Outcome outcome = here.run({"suite", "--random", "10", "--mesh", file});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err.find("overfull_face") != std::string::npos);
}

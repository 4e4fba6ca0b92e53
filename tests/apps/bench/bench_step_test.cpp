// SPDX-License-Identifier: MIT
// `sunder bench step` from outside: parts add up, every case is there, files can be read.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <string>

#include "tests/support/program.hpp"

using namespace sunder::test;
using nlohmann::json;

TEST_CASE("the bench of steps tells parts that add up, and the same in its CSV", "[apps][bench]") {
  const Workplace here;
  const Outcome outcome = here.run({"bench", "step", SUNDER_MESHES "/cube.msh", "--runs", "3",
                                    "--json", "--csv", here.path("s.csv")});
  INFO(outcome.err);
  const json answer = outcome.json();
  CHECK(answer["runs"] == 3);
  std::map<std::string, double> base;
  int steps = 0;
  for (const json& f : answer["figures"]) {
    CHECK(f["body"] == "cube.msh");
    steps += f["quantity"] == "step";
    base.emplace(f["quantity"], f["value"].get<double>());
  }
  CHECK(steps == 13);
  double parts = 0;
  for (const char* part : {"frame", "product", "solve", "element_stress", "node_stress", "rest"}) {
    parts += base.at(part);
  }
  CHECK(parts == Approx(base.at("step")).epsilon(1e-6));
  CHECK(base.at("range") >= 1);
  // Only where the program was built with it.
  if (base.contains("cholmod_difference")) CHECK(base.at("cholmod_difference") < 1e-10);
  std::ifstream csv(here.path("s.csv"));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  CHECK(lines == answer["figures"].size() + 3);
}

TEST_CASE("the bench of steps refuses what is no mesh", "[apps][bench]") {
  const Workplace here;
  CHECK(here.run({"bench", "step", SUNDER_MESHES "/README.md"}).exit_code == 3);
  CHECK(here.run({"bench", "step", "--runs", "0"}).exit_code == 2);
}

TEST_CASE("the bench of methods measures every method on every body, and the same in its CSV",
          "[apps][bench]") {
  const Workplace here;
  const Outcome outcome =
      here.run({"bench", "methods", "--runs", "1", "--json", "--csv", here.path("m.csv")});
  INFO(outcome.err);
  const json answer = outcome.json();
  // Ten methods on the plate, modes not on the block, each twice.
  CHECK(answer["figures"].size() == 38);
  for (const json& f : answer["figures"]) {
    INFO(f.dump());
    CHECK(f["ms"] > 0);
    const bool by_mass = f["method"] == "broyden from the mass matrix";
    CHECK(f["given_up"] == by_mass);
  }
  std::ifstream csv(here.path("m.csv"));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  CHECK(lines == answer["figures"].size() + 3);
}

TEST_CASE(
    "the bench of the threshold test times every way on every source, and the same in its CSV",
    "[apps][bench]") {
  const Workplace here;
  const Outcome outcome =
      here.run({"bench", "threshold", "--runs", "1", "--json", "--csv", here.path("t.csv")});
  INFO(outcome.err);
  const json answer = outcome.json();
  CHECK(answer["figures"].size() == 16);  // three scenes and random tensors, four ways
  for (const json& f : answer["figures"]) {
    INFO(f.dump());
    CHECK(f["ns"] > 0);
    CHECK(f["tensors"] > 1000);
  }
  std::ifstream csv(here.path("t.csv"));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  CHECK(lines == answer["figures"].size() + 3);
  CHECK(here.run({"bench", "threshold", "--scenes", here.path("")}).exit_code == 3);
}

// SPDX-License-Identifier: MIT
// `sunder chart` from outside: its output and files, and how it ends.
#include <stdlib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/support/outside.hpp"
#include "tests/support/program.hpp"

using namespace sunder::test;
using nlohmann::json;

namespace {

/// A cube that turns freely.
std::string scene(const Workplace& here) {
  const json text = {{"name", "turning cube"},
                     {"bodies", {{{"mesh", sample_mesh("cube.msh")}, {"spin", {1, 2, 3}}}}},
                     {"fracture", {{"mode", "off"}}},
                     {"duration", 0.01}};
  return here.write("scene.json", text.dump());
}

}  // namespace

TEST_CASE("a quick chart leaves a table of all runs and lines to paste", "[apps][chart]") {
  const Workplace here;
  const std::string out = here.path("out");
  const std::vector<std::string> words = {"chart",   scene(here), "--quick", "--levels", "0",
                                          "--steps", "1e-3,5e-3", "--limit", "5",        "--out",
                                          out,       "--within",  "0.5"};
  const Outcome told = here.run(words);
  INFO(told.err);
  // Without gnuplot the table and the lines are there all the same; the picture has a test below.
  CHECK((told.exit_code == 0 || told.err.find("gnuplot_missing") != std::string::npos));
  CHECK(told.out.find("Cheapest inside an error of 0.5") != std::string::npos);
  CHECK(told.out.find("\"time_step\"") != std::string::npos);
  const std::string csv = bytes_of(out + "/position.csv");
  CHECK(csv.starts_with("# position of turning cube"));
  CHECK(csv.find("floating_frame") != std::string::npos);
}

TEST_CASE("meshes are points of a chart, or with --ensemble meshes the runs of each",
          "[apps][chart]") {
  const Workplace here;
  const auto rows = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"chart",    scene(here),
                                      "--method", "floating_frame",
                                      "--steps",  "5e-3",
                                      "--mesh",   sample_mesh("bar.msh"),
                                      "--mesh",   sample_mesh("cube.msh"),
                                      "--within", "10",
                                      "--out",    here.path("out")};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome told = here.run(words);
    INFO(told.err);
    CHECK((told.out.find("mean ") != std::string::npos) == !more.empty());
    const std::string csv = bytes_of(here.path("out") + "/position.csv");
    return std::count(csv.begin(), csv.end(), '\n') - 4;  // three comments and the head
  };
  CHECK(rows({}) == 2);
  CHECK(rows({"--ensemble", "meshes"}) == 1);
}

TEST_CASE("a chart is drawn", "[apps][chart]") {
  if (!has_program("gnuplot")) return;
  const Workplace here;
  const std::string out = here.path("out");
  const Outcome told = here.run({"chart", scene(here), "--quick", "--levels", "0", "--steps",
                                 "5e-3", "--limit", "5", "--out", out});
  INFO(told.err);
  CHECK(told.exit_code == 0);
  CHECK(bytes_of(out + "/position.png").starts_with("\x89PNG"));
}

TEST_CASE("what a chart cannot do ends with its reason", "[apps][chart]") {
  const Workplace here;
  const std::string cube = scene(here);
  const auto fails = [&](std::vector<std::string> words, int exit_code, const char* code) {
    words.insert(words.begin(),
                 {"chart", cube, "--quick", "--levels", "0", "--out", here.path("o")});
    const Outcome outcome = here.run(words);
    INFO(outcome.err);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.err.find(code) != std::string::npos);
  };
  fails({"--quantity", "postion"}, 3, "did you mean position");
  fails({"--method", "floating"}, 3, "unknown_method");
  fails({"--exact", "1,2"}, 3, "bad_setting");
  fails({"--probe", "1"}, 3, "bad_setting");
  fails({"--vary", "time_step"}, 3, "bad_setting");
  fails({"--set", "nothing=1"}, 3, "unknown_key");
  fails({"--quantity", "first_fan_time", "--steps", "1e-3"}, 3, "no_reference");
  fails({"--limit", "0"}, 2, "--limit");
  fails({"--ensemble", "0"}, 2, "--ensemble");
  fails({"--ensemble", "several"}, 2, "--ensemble");
  fails({"--ensemble", "meshes"}, 3, "--mesh FILE --mesh FILE");
  CHECK(here.run({"chart", here.path("none.json")}).exit_code == 3);
  CHECK_FALSE(std::filesystem::exists(here.path("o")));
}

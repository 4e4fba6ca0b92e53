// SPDX-License-Identifier: MIT
// `sunder convert` with units and a scale.
#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("convert writes metres from other units", "[apps][convert]") {
  const Workplace here;
  const std::string cube = sample_mesh("cube.msh");
  const std::vector<Point> points = read_file_mesh(cube)->points;
  const std::string out = here.path("out.msh");
  const auto scaled = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {"convert", cube, out};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = here.run(words);
    INFO(outcome.text());
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("scaled by") != std::string::npos);
    return read_file_mesh(out)->points;
  };
  const struct {
    std::vector<std::string> options;
    double factor;
  } cases[] = {{{"--units", "mm"}, 1e-3},
               {{"--scale", "0.5"}, 0.5},
               {{"--units", "in", "--scale", "10"}, 0.254}};
  for (const auto& c : cases) {
    const std::vector<Point> now = scaled(c.options);
    REQUIRE(now.size() == points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(now[p][axis] == Approx(c.factor * points[p][axis]));
      }
    }
  }
  // Metres are the file's own, to the byte.
  CHECK(here.run({"convert", cube, out, "--units", "m"}).exit_code == 0);
  CHECK(read_file_mesh(out)->points == points);
}

TEST_CASE("wrong units and scales of convert are refused", "[apps][convert]") {
  const Workplace here;
  const std::string cube = sample_mesh("cube.msh");
  CHECK(here.run({"convert", cube, here.path("a.msh"), "--units", "mn"}).exit_code == 2);
  CHECK(here.run({"convert", cube, here.path("a.msh"), "--scale", "0"}).exit_code == 2);
  CHECK(here.run({"convert", cube, here.path("a.msh"), "--scale", "-1"}).exit_code == 2);
  const Outcome huge =
      here.run({"convert", cube, here.path("a.msh"), "--scale", "1e300", "--units", "m"});
  const Outcome infinite = here.run(
      {"convert", here.write("far.off", "OFF\n3 1 0\n1e10 0 0\n0 1e10 0\n0 0 0\n3 0 1 2\n"),
       here.path("b.off"), "--scale", "1e305"});
  CHECK(infinite.exit_code == 3);
  CHECK(infinite.err.find("out_of_range") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(here.path("b.off")));
  CHECK(huge.exit_code == 0);
}

// SPDX-License-Identifier: MIT
// Objects of files: read, judged, scaled.
#include "apps/sunder/break/thing.hpp"

#include <catch2/catch.hpp>

#include "tests/apps/sunder/break/surfaces.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

std::string code_of(const Result<Thing>& thing) {
  for (const Finding& f : thing.findings) {
    if (f.severity != Severity::error) continue;
    CHECK_FALSE(f.remedy.empty());
    CHECK_FALSE(f.file.empty());
    return f.code;
  }
  return {};
}

}  // namespace

TEST_CASE("closed surfaces and meshes are taken", "[break]") {
  const Workplace here;
  const Result<Thing> cube = read_thing(here.write("cube.off", cube_off()));
  REQUIRE(cube);
  CHECK_FALSE(cube->is_solid());
  CHECK(cube->volume == Approx(1));
  CHECK(cube->surface.triangles.corners.size() == 12);
  CHECK(longest_side(*cube) == 1);
  // The corners of an STL's triangles are one point each where they lie at one place.
  const std::string stl = here.path("cube.stl");
  REQUIRE(here.run({"convert", here.path("cube.off"), stl}).exit_code == 0);
  const Result<Thing> soup = read_thing(stl);
  REQUIRE(soup);
  CHECK(soup->surface.points.size() == 8);
  const Result<Thing> solid = read_thing(sample_mesh("cube.msh"));
  REQUIRE(solid);
  CHECK(solid->is_solid());
}

TEST_CASE("surfaces that enclose no solid are refused with a remedy", "[break]") {
  const Workplace here;
  CHECK(code_of(read_thing(here.write("open.off", cube_off(true)))) == "open_surface");
  CHECK(code_of(read_thing(here.write("crossing.off", crossing_off()), Mending::none)) ==
        "self_intersection");
  const std::string wing =
      "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
  CHECK(code_of(read_thing(here.write("wing.off", wing))) == "open_surface");
  const std::string flat = "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n";
  CHECK(code_of(read_thing(here.write("flat.off", flat))) == "no_faces");
  CHECK(code_of(read_thing(here.write("text.stl", "this is no mesh"))) != "");
  CHECK(code_of(read_thing(here.path("missing.stl"))) == "cannot_open");
  // Two cubes that share an edge of four faces.
  std::string pair = "OFF\n14 24 0\n";
  for (const int d : {0, 1}) {
    for (const int z : {0, 1}) {
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        if (d == 1 && x == 0 && y == 0) continue;
        pair +=
            std::to_string(x + d) + " " + std::to_string(y + d) + " " + std::to_string(z) + "\n";
      }
    }
  }
  const int first[8] = {0, 1, 2, 3, 4, 5, 6, 7}, second[8] = {2, 8, 9, 10, 6, 11, 12, 13};
  const int faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                            {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  for (const auto& rows : {first, second}) {
    for (const auto& f : faces) {
      pair += "3 " + std::to_string(rows[f[0]]) + " " + std::to_string(rows[f[1]]) + " " +
              std::to_string(rows[f[2]]) + "\n";
    }
  }
  CHECK(code_of(read_thing(here.write("pair.off", pair), Mending::none)) == "nonmanifold_surface");
}

TEST_CASE("the unit is that of an option, or a guess that is told", "[break]") {
  Thing thing;
  thing.surface.points = {{0, 0, 0}, {95, 0, 0}, {0, 60, 0}};
  const ThingScale guess = scale_of(thing, {}, "", "mug.stl");
  CHECK(guess.metres == 1e-3);
  REQUIRE(guess.guess);
  CHECK(guess.guess->code == "guessed_unit");
  CHECK(guess.guess->text.find("95 mm") != std::string::npos);
  CHECK(guess.guess->remedy.find("--units") != std::string::npos);
  const ThingScale sized = scale_of(thing, 0.19, "", "mug.stl");
  CHECK(sized.metres == Approx(0.002));
  CHECK_FALSE(sized.guess);
  CHECK(scale_of(thing, {}, "cm", "mug.stl").metres == 0.01);
  thing.surface.points[1][0] = 0.095;
  thing.surface.points[2][1] = 0.06;
  CHECK(scale_of(thing, {}, "", "mug.stl").metres == 1);
}

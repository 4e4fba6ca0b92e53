// SPDX-License-Identifier: MIT
// Surfaces filled by meshers that are installed.
#include "apps/sunder/break/fill.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "apps/sunder/process/run_process.hpp"
#include "tests/apps/sunder/break/surfaces.hpp"
#include "tests/support/program.hpp"
#include "topology/mesh/check.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("each installed mesher fills a cube with about as many tetrahedra as asked for",
          "[break]") {
  const Workplace here;
  const Result<Thing> cube = read_thing(here.write("cube.off", cube_off()));
  REQUIRE(cube);
  int tried = 0;
  for (const std::string& mesher : known_meshers()) {
    if (!find_program(mesher)) continue;
    ++tried;
    INFO(mesher);
    const Result<Filled> filled = fill(*cube, 1500, mesher);
    for (const Finding& f : filled.findings) UNSCOPED_INFO(f.text);
    REQUIRE(filled);
    CHECK(filled->mesher == mesher);
    CHECK(std::abs(filled->volume_error) < 1e-3);
    CHECK(filled->mesh.tetrahedra.size() > 700);
    CHECK(filled->mesh.tetrahedra.size() < 3200);
    CHECK(check_mesh(filled->mesh).empty());
    const Result<Filled> again = fill(*cube, 1500, mesher);
    REQUIRE(again);
    CHECK(again->mesh.points == filled->mesh.points);
    CHECK(again->mesh.tetrahedra == filled->mesh.tetrahedra);
  }
  if (tried == 0) WARN("skipped: tetgen is not installed");
}

TEST_CASE("a mesher that is missing or fails is told with a remedy", "[break]") {
  const Workplace here;
  const Result<Thing> cube = read_thing(here.write("cube.off", cube_off()));
  REQUIRE(cube);
  const std::string before = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const Result<Filled> none = fill(*cube, 1500, "");
  const Result<Filled> named = fill(*cube, 1500, "gmsh");
  // Programs that print and fail, that write nothing, and that write no mesh.
  const auto pretend = [&](const std::string& name, const std::string& script) {
    const std::string path = here.write(name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  };
  pretend("tetgen", "echo this surface is bad\nexit 1\n");
  pretend("gmsh", "exit 0\n");
  pretend("sunder-mesh", "echo rubbish >filled.msh\n");
  setenv("PATH", std::filesystem::path(here.path("tetgen")).parent_path().c_str(), 1);
  const Result<Filled> failed = fill(*cube, 1500, "");
  setenv("PATH", before.c_str(), 1);
  REQUIRE_FALSE(none);
  CHECK(none.findings[0].code == "no_mesher");
  CHECK(none.findings[0].remedy.find("apt-get install tetgen") != std::string::npos);
  REQUIRE_FALSE(named);
  CHECK(named.findings[0].text.find("gmsh") != std::string::npos);
  REQUIRE_FALSE(failed);
  CHECK(failed.findings[0].code == "not_filled");
  for (const char* word : {"tetgen: it says: this surface is bad", "gmsh: it wrote no mesh",
                           "sunder-mesh: it wrote a mesh without tetrahedra"}) {
    INFO(failed.findings[0].text);
    CHECK(failed.findings[0].text.find(word) != std::string::npos);
  }
}

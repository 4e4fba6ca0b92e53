// SPDX-License-Identifier: MIT
// Keys of a scene that have no effect are noted.
#include "apps/scene/scene_notes.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/support/scene_texts.hpp"

using namespace sunder;
using namespace sunder::test;
using nlohmann::json;

TEST_CASE("windows asked for with a method that has none are noted, defaults are not",
          "[run][scene]") {
  json scene = cube_scene();
  scene["bodies"][0]["material"]["toughness"] = 1e6;
  const std::vector<std::string> broyden = {"integrator.method=broyden"};
  CHECK(read(scene, broyden).findings.empty());
  scene["impact"]["window"] = true;
  CHECK(read(scene).findings.empty());
  const Result<SceneFile> noted = read(scene, broyden);
  REQUIRE(noted);
  REQUIRE(noted.findings.size() == 1);
  CHECK(noted.findings[0].code == "no_impact_windows");
  CHECK(noted.findings[0].severity == Severity::note);
  CHECK(noted.findings[0].line > 0);
}

TEST_CASE("bodies that can break and name no toughness get one note", "[run][scene]") {
  json scene = cube_scene();
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"][1]["translation"] = {9, 0, 0};
  const Result<SceneFile> noted = read(scene);
  REQUIRE(noted);
  REQUIRE(codes(noted.findings) == std::multiset<std::string>{"no_toughness"});
  CHECK(noted.findings[0].severity == Severity::note);
  CHECK(noted.findings[0].text.find("and 1 more") != std::string::npos);
  CHECK(read(scene, {"fracture.mode=off"}).findings.empty());
  CHECK(read(scene, {"fracture.crack=paper"}).findings.empty());
  scene["bodies"][0]["material"]["toughness"] = 1e6;
  scene["bodies"][1]["material"]["fracture_energy"] = 30;
  CHECK(read(scene).findings.empty());
}

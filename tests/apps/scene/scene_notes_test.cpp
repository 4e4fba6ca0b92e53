// SPDX-License-Identifier: MIT
// What a scene asks for in vain is noted.
#include "apps/scene/scene_notes.hpp"

#include <unistd.h>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

using namespace sunder;
using nlohmann::json;

namespace {

/// Reads a scene given as JSON, with its meshes in the repository's meshes/.
Result<SceneFile> read(const json& scene, const std::vector<std::string>& settings = {}) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("sunder_notes_" + std::to_string(getpid()) + ".json");
  std::ofstream(path) << scene.dump(1);
  Result<SceneFile> file = read_scene(path, settings);
  std::filesystem::remove(path);
  return file;
}

json cube_scene() { return {{"bodies", {{{"mesh", SUNDER_MESHES "/cube.msh"}}}}}; }

std::multiset<std::string> codes(const std::vector<Finding>& findings) {
  std::multiset<std::string> all;
  for (const Finding& f : findings) all.insert(f.code);
  return all;
}

}  // namespace

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

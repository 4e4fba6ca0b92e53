// SPDX-License-Identifier: MIT
// `sunder modes` from outside: JSON, shapes on disk, rigid motions, exit codes.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"

using nlohmann::json;
namespace fs = std::filesystem;
using namespace sunder::test;

namespace {

/// Runs `sunder modes` on a scene in `folder`.
Outcome run(const fs::path& folder, const json& scene, const std::string& words) {
  std::ofstream(folder / "scene.json") << scene.dump(1);
  return run_program("modes " + (folder / "scene.json").string() + " " + words);
}

}  // namespace

TEST_CASE("sunder modes tells rigid motions from frequencies and ends as it says", "[run][modes]") {
  const Folder own;
  const fs::path& folder = own.path();
  json scene = {{"bodies", {{{"mesh", SUNDER_MESHES "/cube.msh"}}}}};
  const Outcome free = run(folder, scene, "--count 3 --json -o " + (folder / "m.vtu").string());
  CHECK(free.exit_code == 0);
  const json piece = json::parse(free.out)["pieces"][0];
  CHECK(piece["rigid_modes"] == 6);
  const auto frequency = piece["frequencies"].get<std::vector<double>>();
  REQUIRE(frequency.size() == 9);
  CHECK(frequency[5] == 0);
  CHECK(frequency[6] > 100);
  CHECK(sunder::read_mesh(folder / "m.vtu"));
  CHECK(bytes_of(folder / "m.vtu").find("mode_9") != std::string::npos);

  scene["bodies"][0]["held"] = {{{"minimum", {-9, -9, -9}}, {"maximum", {9, 9, 0}}}};
  const Outcome held = run(folder, scene, "--count 3");
  CHECK(held.exit_code == 0);
  CHECK(held.out.find("0 rigid") != std::string::npos);
  CHECK(run(folder, scene, "--count 0").exit_code == 2);
  CHECK(run(folder, scene, "--set bodies.0.mesh=none.msh").exit_code == 3);
  CHECK(run(folder, scene, "-o /nowhere/at/all.vtu").exit_code == 4);
}

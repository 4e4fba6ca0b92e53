// SPDX-License-Identifier: MIT
// `sunder modes` from outside: JSON, shapes on disk, rigid motions, exit codes.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "topology/io/mesh_file.hpp"

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs `sunder modes` on a scene in `folder`.
Outcome run(const fs::path& folder, const json& scene, const std::string& words) {
  std::ofstream(folder / "scene.json") << scene.dump(1);
  const std::string command = std::string(SUNDER_PROGRAM) + " modes " +
                              (folder / "scene.json").string() + " " + words + " >" +
                              (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), slurp(folder / "out"), slurp(folder / "err")};
}

}  // namespace

TEST_CASE("sunder modes tells rigid motions from frequencies and ends as it says", "[run][modes]") {
  const fs::path folder =
      fs::temp_directory_path() / ("sunder_modes_test_" + std::to_string(getpid()));
  fs::create_directories(folder);
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
  CHECK(slurp(folder / "m.vtu").find("mode_9") != std::string::npos);

  scene["bodies"][0]["held"] = {{{"minimum", {-9, -9, -9}}, {"maximum", {9, 9, 0}}}};
  const Outcome held = run(folder, scene, "--count 3");
  CHECK(held.exit_code == 0);
  CHECK(held.out.find("0 rigid") != std::string::npos);
  CHECK(run(folder, scene, "--count 0").exit_code == 2);
  CHECK(run(folder, scene, "--set bodies.0.mesh=none.msh").exit_code == 3);
  CHECK(run(folder, scene, "-o /nowhere/at/all.vtu").exit_code == 4);
  fs::remove_all(folder);
}

// SPDX-License-Identifier: MIT
// The program on streams that are full or closed, with limits of the system, names of any bytes and
// numbers of any size.
#include <sys/stat.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/struck_scene.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;

namespace {

/// The exit code of a shell's command, `$sunder` the program; -1 where a signal ended it.
int exit_of_shell(const std::string& command) {
  const std::string words = "sunder='" SUNDER_PROGRAM "'; " + command;
  const int status = std::system(words.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) < 128 ? WEXITSTATUS(status) : -1;
}

json cube_scene() {
  return {{"bodies", {{{"mesh", sample_mesh("cube.msh")}}}},
          {"duration", 0.003},
          {"time_step", 0.001},
          {"output", {{"frames", 0}}}};
}

bool is_plain(const std::string& text) {
  return std::ranges::none_of(text, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < ' ' && byte != '\n' && byte != '\t') || byte == 0x7f;
  });
}

bool has_null(const json& value) {
  if (value.is_null()) return true;
  if (!value.is_structured()) return false;
  return std::ranges::any_of(value, has_null);
}

}  // namespace

TEST_CASE("standard error that is full, closed or read by nobody ends no command",
          "[apps][robust]") {
  const Workplace here;
  const std::string scene = here.write("scene.json", cube_scene().dump());
  const std::string broken = here.write("broken.msh", std::string("$MeshFormat\n"));
  for (const char* err : {"2>/dev/full", "2>&-", "2>/dev/null"}) {
    INFO(err);
    const std::string run =
        "\"$sunder\" run " + scene + " --verbose --force -o " + here.path("out");
    CHECK(exit_of_shell(run + " >/dev/null " + err) == 0);
    CHECK(json::parse(bytes_of(here.path("out/report.json")))["end"] == "finished");
    fs::remove(here.path("out/report.json"));
    CHECK(exit_of_shell("\"$sunder\" check " + broken + " >/dev/null " + err) == 3);
    CHECK(exit_of_shell("\"$sunder\" run /nowhere.json >/dev/null " + std::string(err)) == 3);
    CHECK(exit_of_shell("\"$sunder\" nothing " + std::string(err)) == 2);
    CHECK(exit_of_shell("\"$sunder\" " + std::string(err)) == 2);
  }
  // A pipe without a reader.
  CHECK(exit_of_shell("{ { sleep 0.1; \"$sunder\" run " + scene + " --verbose --force -o " +
                      here.path("out") + " >/dev/null; echo $? >" + here.path("code") +
                      "; } 2>&1; } | true") == 0);
  CHECK(bytes_of(here.path("code")) == "0\n");
}

TEST_CASE("messages of a program without standard error are written into no file",
          "[apps][robust]") {
  const Workplace here;
  const std::string mesh = sample_mesh("cube.msh");
  CHECK(exit_of_shell("\"$sunder\" convert --verbose " + mesh + " " + here.path("a.vtk") +
                      " >/dev/null 2>&1") == 0);
  CHECK(exit_of_shell("\"$sunder\" convert --verbose " + mesh + " " + here.path("b.vtk") +
                      " >&- 2>&- <&-") == 4);  // that standard output is closed is an error
  CHECK(bytes_of(here.path("a.vtk")) == bytes_of(here.path("b.vtk")));
  CHECK(here.names() ==
        std::vector<std::string>{"a.vtk", "a.vtk.regions", "b.vtk", "b.vtk.regions"});
}

TEST_CASE("a result that standard output does not take is reported, and files are written",
          "[apps][robust]") {
  const Workplace here;
  const std::string scene = here.write("scene.json", cube_scene().dump());
  for (const char* out : {">/dev/full", ">&-"}) {
    for (const char* format : {"", " --json"}) {
      INFO(out << format);
      CHECK(exit_of_shell("\"$sunder\" run " + scene + format + " --force -o " + here.path("out") +
                          " " + out + " 2>" + here.path("err")) == 4);
      CHECK_THAT(bytes_of(here.path("err")), Contains("cannot be written to standard output"));
      CHECK(fs::exists(here.path("out/report.json")));
      fs::remove(here.path("out/report.json"));
    }
  }
}

TEST_CASE("a limit on the size of files is an error like a full disk", "[apps][robust]") {
  const Workplace here;
  const std::string old = here.write("a.vtk", std::string("old"));
  const int code = exit_of_shell("ulimit -f 1; \"$sunder\" convert " + sample_mesh("monolith.msh") +
                                 " " + old + " >/dev/null 2>&1");
  CHECK(code == 4);
  CHECK(bytes_of(old) == "old");
  CHECK(here.names() == std::vector<std::string>{"a.vtk"});
}

TEST_CASE("a converted mesh keeps the mode and the link of the file that it replaces",
          "[apps][robust]") {
  const Workplace here;
  const std::string target = here.write("target.vtk", std::string("old"));
  chmod(target.c_str(), 0600);
  fs::create_symlink("target.vtk", here.path("link.vtk"));
  CHECK(here.run({"convert", sample_mesh("cube.msh"), here.path("link.vtk")}).exit_code == 0);
  CHECK(fs::is_symlink(here.path("link.vtk")));
  CHECK(bytes_of(target).starts_with("# vtk"));
  CHECK((fs::status(target).permissions() & fs::perms::all) ==
        (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("a mesh of nothing replaces no file", "[apps][robust]") {
  const Workplace here;
  const std::string good = bytes_of(sample_mesh("cube.msh"));
  const std::string quads = here.write(
      "quad.vtk", std::string("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                              "POINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
                              "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n"));
  const std::vector<std::vector<std::string>> ways = {
      {here.write("none.stl", std::string(80, ' ') + std::string(4, '\0'))},
      {here.write("none.obj", std::string("# nothing\n"))},
      {here.write("none.off", std::string("OFF\n0 0 0\n"))},
      {here.write("none.ply", std::string("ply\nformat ascii 1.0\nelement vertex 0\nproperty float "
                                          "x\nproperty float y\nproperty float z\nend_header\n"))},
      {here.write("none.vtk", std::string("# vtk DataFile Version 3.0\nx\nASCII\nDATASET "
                                          "UNSTRUCTURED_GRID\nPOINTS 0 double\n"))},
      {here.write("none.msh", std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n"
                                          "$EndNodes\n$Elements\n0\n$EndElements\n"))},
      {quads, "--tetrahedra-only"},
      {here.write("flat.off", std::string("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")),
       "--triangles", "drop"}};
  for (const std::vector<std::string>& way : ways) {
    for (const char* ending : {"a.msh", "a.vtu", "a.stl", "a.obj", "a.ply"}) {
      const std::string target = here.write(ending, good);
      std::vector<std::string> words = {"convert", way[0], target};
      words.insert(words.end(), way.begin() + 1, way.end());
      const Outcome o = here.run(words);
      INFO(way[0] << " to " << ending << ": " << o.text());
      CHECK(o.exit_code != 0);
      CHECK(bytes_of(target) == good);
    }
  }
}

TEST_CASE("names of any bytes move no terminal and leave JSON whole", "[apps][robust]") {
  const Workplace here;
  const std::string odd = "a\x1b[31m\r\nb\x7f\xc2\x9b\xff.msh";
  const std::string mesh = here.write(odd, bytes_of(sample_mesh("cube.msh")));
  const std::string bad = here.write("bad" + odd, std::string("$MeshFormat\n"));
  const std::string vtk = here.path("out" + odd + ".vtk");
  const std::vector<std::vector<std::string>> commands = {
      {"check", mesh},
      {"check", mesh, bad},
      {"check", bad},
      {"convert", mesh, vtk, "--verbose"},
      {"convert", bad, vtk},
      {"refine", mesh, vtk, "--levels", "1"},
      {"cut", mesh, vtk, "--plane", "1,0,0,0.5"},
      {"split", mesh, "--fan", "0,1,0,0"},
      {"static", mesh},
      {"run", odd},
      {odd},
      {"check", "--" + odd}};
  for (std::vector<std::string> words : commands) {
    INFO(words[0]);
    const Outcome o = here.run(words);
    INFO(o.text());
    CHECK((o.exit_code >= 0 && o.exit_code <= 4));
    CHECK(is_plain(o.text()));
    if (words.size() == 1 || words[1].starts_with("--")) continue;
    words.push_back("--json");
    const Outcome told = here.run(words);
    INFO(told.text());
    CHECK(told.exit_code == o.exit_code);
    CHECK((told.json().is_object() || told.json().is_array()));
    CHECK(is_plain(told.text()));
  }
}

TEST_CASE("the names in a scene move no terminal and leave reports whole", "[apps][robust]") {
  const Workplace here;
  json scene = cube_scene();
  scene["name"] = "a\x1b]0;b\x07\r\nc\x7f\xc2\x9b";
  scene["bodies"][0]["name"] = "d\x1b[2J\nzzz";
  const std::string file = here.write("scene.json", scene.dump());
  for (const char* command : {"run", "static", "modes"}) {
    for (const bool as_json : {false, true}) {
      std::vector<std::string> words = {command, file};
      if (as_json) words.emplace_back("--json");
      if (std::string(command) == "run") {
        words.insert(words.end(), {"--verbose", "--force", "-o", here.path("out")});
      }
      const Outcome o = here.run(words);
      INFO(command << ": " << o.text());
      CHECK((o.exit_code == 0 || std::string(command) == "static"));
      CHECK(is_plain(o.text()));
      CHECK_THAT(o.text(), !Contains("\nzzz"));
      if (as_json) CHECK(o.json().is_object());
    }
  }
  // A name that is no UTF-8, by --set.
  const Outcome o =
      here.run({"run", file, "--set", "name=\xff\x1b", "--force", "-o", here.path("out")});
  INFO(o.text());
  CHECK(o.exit_code == 0);
  CHECK(is_plain(o.text()));
  CHECK(json::parse(bytes_of(here.path("out/report.json")), nullptr, false).is_object());
}

TEST_CASE("numbers of any size are refused, or run without a number that is none",
          "[apps][robust]") {
  const Workplace here;
  const std::string file = here.write("scene.json", struck_scene(0.32, 0.0005).dump());
  struct Place {
    const char *key, *before, *behind;
  };
  constexpr Place places[] = {{"fracture.budget_time", "", ""},
                              {"duration", "", ""},
                              {"gravity.acceleration", "[0,0,", "]"},
                              {"bodies.0.translation", "[", ",0,0]"},
                              {"bodies.0.velocity", "[0,0,", "]"},
                              {"bodies.0.spin", "[0,", ",0]"},
                              {"bodies.0.material.young_modulus", "", ""},
                              {"bodies.0.material.density", "", ""},
                              {"display_time_constant", "", ""},
                              {"ladder.sleep_after", "", ""},
                              {"obstacles.1.mass", "", ""},
                              {"obstacles.1.sphere.radius", "", ""},
                              {"obstacles.1.velocity", "[0,", ",0]"},
                              {"contact.friction", "", ""},
                              {"output.frame_interval", "", ""}};
  for (const Place& place : places) {
    for (const char* value :
         {"1e17", "1e308", "-1e300", "1e-300", "1e16", "1e-22", "1e20", "1e-30"}) {
      const std::string setting =
          std::string(place.key) + "=" + place.before + value + place.behind;
      INFO(setting);
      std::vector<std::string> words = {"run", file, "--quiet", "--force", "-o", here.path("out")};
      for (const std::string& one :
           {std::string("output={\"frames\": 0}"), std::string("fracture.mode=budget"),
            std::string("impact.max_sub_steps=50"), setting}) {
        words.insert(words.end(), {"--set", one});
      }
      const Outcome o = here.run(words);
      INFO(o.text());
      REQUIRE((o.exit_code == 0 || o.exit_code == 3 || o.exit_code == 5));
      if (o.exit_code == 0) {
        const json report = json::parse(bytes_of(here.path("out/report.json")));
        CHECK_FALSE(has_null(report));
      } else {
        CHECK_THAT(o.err, Contains("error: "));
      }
    }
  }
}

TEST_CASE("steps and budgets of any length divide by no 0", "[apps][robust]") {
  const Workplace here;
  json scene = struck_scene(0.32, 1e-3);
  const std::string file = here.write("scene.json", scene.dump());
  CHECK(here.run({"run", file, "--quiet", "-o", here.path("a"), "--set", "fracture.mode=budget",
                  "--set", "fracture.budget_time=1e16"})
            .exit_code == 0);
  CHECK(here.run({"run", file, "--quiet", "-o", here.path("b"), "--set", "ladder.rubble=certified",
                  "--set", "time_step=1e-22", "--set", "duration=3e-22"})
            .exit_code == 0);
}

TEST_CASE("limits of the environment hold for scenes, and a mistake in them is refused",
          "[apps][robust]") {
  const Workplace here;
  const std::string scene = here.write("scene.json", cube_scene().dump());
  const auto run = [&](const std::string& limits) {
    return exit_of_shell("SUNDER_LIMITS='" + limits + "' \"$sunder\" run " + scene +
                         " --force -o " + here.path("out") + " >/dev/null 2>" + here.path("err"));
  };
  CHECK(run("") == 0);
  CHECK(run("steps=3 file_bytes=1e6") == 0);
  CHECK(run("steps=2") == 3);
  CHECK_THAT(bytes_of(here.path("err")), Contains("too_many_steps"));
  CHECK(run("scene_levels=2") == 3);
  CHECK_THAT(bytes_of(here.path("err")), Contains("nested_too_deeply"));
  CHECK(run("file_bytes=100") == 3);
  CHECK_THAT(bytes_of(here.path("err")), Contains("too_large") && Contains("file_bytes"));
  CHECK(run("unpacked_byte=1") == 2);
  CHECK_THAT(bytes_of(here.path("err")), Contains("SUNDER_LIMITS") && Contains("unpacked_bytes"));
}

TEST_CASE("giant steps end with a result or with an error that names time_step", "[apps][robust]") {
  const Workplace here;
  json spinning = cube_scene();
  spinning["gravity"]["acceleration"] = {0, 0, 0};
  json resting = cube_scene();
  resting["bodies"][0]["translation"] = {0, 0, 0.05};
  resting["bodies"][0]["material"] = {{"young_modulus", 30e9}, {"tensile_strength", 3e6}};
  resting["fracture"]["mode"] = "off";
  resting["obstacles"] = {{{"plane", {{"normal", {0, 0, 1}}}}}};
  std::vector<json> scenes = {resting};
  for (const double spin : {1.0, 10.0, 1000.0}) {
    for (const bool rigid : {false, true}) {
      scenes.push_back(spinning);
      scenes.back()["bodies"][0]["spin"] = {0, 0.1 * spin, spin};
      scenes.back()["bodies"][0]["rigid"] = rigid;
    }
  }
  for (json& scene : scenes) {
    for (const double step : {40.0, 80.0, 1e4}) {
      scene["time_step"] = step;
      scene["duration"] = 3 * step;
      const std::string file = here.write("scene.json", scene.dump());
      const Outcome o = here.run({"run", file, "--force", "-o", here.path("out")});
      INFO(scene.dump() << "\n" << o.err);
      if (o.exit_code == 0) {
        CHECK_FALSE(has_null(json::parse(bytes_of(here.path("out/report.json")))));
      } else {
        CHECK((o.exit_code == 3 || o.exit_code == 5));
        CHECK_THAT(o.err, Contains("time_step"));
      }
    }
  }
}

TEST_CASE("a free rigid body of 80 s per step keeps its energy", "[apps][robust]") {
  const Workplace here;
  json scene = cube_scene();
  scene["bodies"][0]["mesh"] = sample_mesh("bar.msh");
  scene["gravity"]["acceleration"] = {0, 0, 0};
  scene["bodies"][0]["rigid"] = true;
  scene["bodies"][0]["spin"] = {0.01, 10, 0.02};
  scene["time_step"] = 80;
  scene["duration"] = 240;
  const Outcome o =
      here.run({"run", here.write("scene.json", scene.dump()), "-o", here.path("out")});
  INFO(o.err);
  CHECK(o.exit_code == 0);
  CHECK_THAT(o.err, !Contains("energy_rises") && !Contains("energy_residual"));
}

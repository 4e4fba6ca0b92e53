// SPDX-License-Identifier: MIT
// The scene reader, the committed schema, and `sunder run` from outside: files, bytes, exit codes.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_schema.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/state/living.hpp"
#include "tests/support/program.hpp"
#include "tests/support/struck_scene.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/kernel/invariants.hpp"

namespace fs = std::filesystem;
using nlohmann::json;
using namespace sunder::test;

namespace {

/// Runs `sunder run` with these words.
Outcome run(const std::string& words) { return run_program("run " + words); }

fs::path write_scene(const Folder& folder, const json& scene) {
  std::ofstream(folder.path() / "scene.json") << scene.dump(1);
  return folder.path() / "scene.json";
}

/// Runs a shipped scene for `duration` (s) and checks the result against the laws.
void hold_scene(const std::string& name, double duration) {
  auto file = sunder::read_scene(std::string(SUNDER_SCENES "/") + name + ".json");
  REQUIRE(file);
  auto sim = sunder::build_simulation(file->scene);
  REQUIRE(sim);
  const auto mass_of = [](const sunder::Simulation& s) {
    double sum = 0;
    for (const double m : s.state->mechanics.vertices.mass) sum += m;
    return sum;
  };
  const double mass = mass_of(*sim);
  std::size_t fans = 0, foreseen = 0, separated = 0;
  while (sim->state->mechanics.time < duration) {
    const sunder::StepReport step = sunder::advance(*sim);
    REQUIRE(step.status.outcome == sunder::StepOutcome::fine);
    for (const sunder::FanEvent& fan : step.fracture.fans) {
      ++fans;
      foreseen += fan.components.predicted > 0;
      separated += fan.components.created > 0;
      // The oracle never says no to a true separation.
      REQUIRE((fan.components.created == 0 || fan.components.predicted > 0));
    }
  }
  const sunder::VolumeMap& map = sim->state->cells.map;
  const sunder::Counts counts = sunder::count_cells(map);
  WARN(name << ": " << fans << " fans, " << counts.components << " pieces, oracle right in "
            << separated << " of " << foreseen << ", Betti numbers " << (*counts.betti)[0] << " "
            << (*counts.betti)[1] << " " << (*counts.betti)[2]);
  CHECK(fans > 0);
  CHECK(sunder::check(map).empty());
  CHECK(counts.components == sunder::living_components(sim->state->mechanics).size());
  CHECK((*counts.betti)[1] >= 0);
  CHECK(mass_of(*sim) == Approx(mass).epsilon(1e-12));
}

}  // namespace

TEST_CASE("the struck monolith's map passes every law", "[run]") {
  hold_scene("charts/monolith", 0.1);
}

// Two minutes: not part of ctest. sunder_run_tests "[scenes]"
TEST_CASE("the maps of all three scenes pass every law at their end", "[.][scenes]") {
  hold_scene("monolith", 0.1);
  hold_scene("block", 2.5);
  hold_scene("bunny", 0.03);
}

TEST_CASE("the committed schema is the program's own", "[run]") {
  CHECK(json::parse(bytes_of(SUNDER_SCENES "/scene.schema.json")) ==
        json::parse(sunder::scene_schema().dump()));
}

TEST_CASE("every scene that is shipped can be read", "[run]") {
  for (const char* name : {"monolith", "block", "bunny"}) {
    const auto scene = sunder::read_scene(std::string(SUNDER_SCENES "/") + name + ".json");
    INFO(name);
    REQUIRE(scene);
    CHECK(scene->scene.name == name);
    CHECK(scene->scene.bodies.size() == 1);
  }
}

TEST_CASE("a scene with only what is required has the defaults of the C++ structs", "[run]") {
  const Folder folder;
  json scene = struck_scene(0.4, 0.02);
  scene["bodies"][0].erase("material");
  const auto file = sunder::read_scene(write_scene(folder, scene));
  REQUIRE(file);
  CHECK(file->scene.bodies[0].material.density == sunder::Material{}.density);
  CHECK(file->scene.contact.ball_share == sunder::ContactSettings{}.ball_share);
  CHECK(file->scene.fracture.max_fans == sunder::FractureSettings{}.max_fans);
}

TEST_CASE("two runs of a scene that breaks leave the same bytes", "[run]") {
  const Folder folder;
  json struck = struck_scene(0.4, 0.02);
  struck["bodies"][0].erase("order");
  const fs::path scene = write_scene(folder, struck);
  for (const char* out : {"a", "b"}) {
    const Outcome o =
        run(scene.string() + " --quiet --frames 3 -o " + (folder.path() / out).string());
    INFO(o.text());
    REQUIRE(o.exit_code == 0);
  }
  const std::string events = bytes_of(folder.path() / "a/events.jsonl");
  CHECK(!events.empty());
  CHECK(events == bytes_of(folder.path() / "b/events.jsonl"));
  CHECK(bytes_of(folder.path() / "a/fragments.csv") == bytes_of(folder.path() / "b/fragments.csv"));
  CHECK(bytes_of(folder.path() / "a/history.csv") == bytes_of(folder.path() / "b/history.csv"));
  std::size_t frames = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "a/frames")) {
    ++frames;
    CHECK(bytes_of(entry.path()) == bytes_of(folder.path() / "b/frames" / entry.path().filename()));
  }
  CHECK(frames == 3);
  const json report = json::parse(bytes_of(folder.path() / "a/report.json"));
  for (const char* key :
       {"steps", "step_ms", "stage_ms", "fans", "faces_split", "components", "fragments",
        "gershgorin", "oracle", "momentum", "energy", "warnings", "settings"}) {
    INFO(key);
    CHECK(report.contains(key));
  }
  CHECK(report["fans"].get<int>() > 0);
  const json& settings = report["settings"];
  CHECK(settings["accuracy"] == "good");
  // A slab of two layers, so its order is chosen too.
  REQUIRE(settings["chosen"].size() == sunder::chosen_keys().size() + 1);
  CHECK(settings["chosen"].back()["key"] == "bodies.0.order");
  CHECK(settings["chosen"].back()["value"] == 2);
  CHECK(settings["chosen"][1]["key"] == "contact.max_passes");
  CHECK(settings["chosen"][1]["value"] == 10);
  CHECK(settings["expected"]["steps"] == report["steps"]);
  CHECK(settings["expected"]["seconds"].get<double>() > 0);
  CHECK(std::abs(report["fragments"]["mass_error"].get<double>()) < 1e-12);
}

TEST_CASE(
    "the history of a run is the same on any threads and kernel, at the interval of the scene",
    "[run][history]") {
  const Folder folder;
  const std::string scene = write_scene(folder, struck_scene(0.4, 0.02)).string();
  const auto history = [&](const std::string& name, const std::string& options) {
    const std::string out = (folder.path() / name).string();
    const Outcome o = run(scene + " --quiet --frames 0 -o " + out + " " + options);
    INFO(o.text());
    REQUIRE(o.exit_code == 0);
    return bytes_of(out + "/history.csv");
  };
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  const std::string one = history("one", "");
  CHECK(lines(one) == 1 + 81);  // the start and 80 steps
  CHECK(one.starts_with("time,kinetic_energy,"));
  CHECK(history("two", "--threads 2") == one);
  CHECK(history("three", "--threads 3 --set topology.kernel=lcc") == one);
  CHECK(history("dense", "--set topology.kernel=dense") == one);
  // At 0, 3, ... 18 ms, and the end at 20.
  CHECK(lines(history("seldom", "--set output.history=0.003")) == 1 + 8);
  for (const char* off : {"0", "off"}) {
    history("off", std::string("--force --set output.history=") + off);
    CHECK_FALSE(fs::exists(folder.path() / "off/history.csv"));
  }
  const Outcome bad =
      run(scene + " -o " + (folder.path() / "bad").string() + " --set output.history=often");
  CHECK(bad.exit_code == 3);
  CHECK(bad.text().find("output.history is \"often\"; a number or \"off\" is wanted") !=
        std::string::npos);
}

TEST_CASE("cracks drawn smooth change pictures and nothing else", "[run][smooth_cracks]") {
  const Folder folder;
  const std::string scene = write_scene(folder, struck_scene(0.4, 0.02)).string();
  const auto picture = [&](const std::string& cracks) {
    const Outcome outcome = run(scene + " -o " + (folder.path() / cracks).string() +
                                " --png 1 --set fracture.crack=object --set output.frames=1 "
                                "--set output.pictures.show=both --set output.crack_surface=" +
                                cracks);
    if (outcome.exit_code == 0) return bytes_of(folder.path() / cracks / "picture_000.png");
    INFO(outcome.text());
    const bool cannot_draw = outcome.text().find("[no_gl_") != std::string::npos ||
                             outcome.text().find("[no_headless_display]") != std::string::npos;
    REQUIRE(cannot_draw);
    WARN("skipped: OpenGL without a display is not installed");
    return std::string();
  };
  const std::string mesh = picture("mesh"), smooth = picture("smooth");
  if (mesh.empty()) return;
  CHECK(mesh != smooth);
  // Frames have one column more, for films.
  for (const char* file : {"events.jsonl", "cracks.csv", "fragments.csv"}) {
    INFO(file);
    const std::string bytes = bytes_of(folder.path() / "mesh" / file);
    CHECK(bytes.size() > 0);
    CHECK(bytes == bytes_of(folder.path() / "smooth" / file));
  }
  const auto plain = sunder::read_file_mesh(folder.path() / "mesh/frames/frame_000000.vtu");
  const auto moved = sunder::read_file_mesh(folder.path() / "smooth/frames/frame_000000.vtu");
  REQUIRE(plain);
  REQUIRE(moved);
  CHECK(plain->points == moved->points);
  CHECK(moved->point_data.size() == plain->point_data.size() + 1);
}

TEST_CASE("a run names its scene in one line, and with --verbose the chosen settings", "[run]") {
  const Folder folder;
  json scene = struck_scene(0.4, 0.001);
  scene["name"] = "struck";
  const std::string out = " --force --frames 0 -o " + (folder.path() / "a").string();
  const std::string words = write_scene(folder, scene).string() + " --set accuracy=preview" + out;
  const Outcome plain = run(words);
  CHECK(plain.exit_code == 0);
  CHECK(plain.err.find("struck: 1 body of 424 tetrahedra, ") != std::string::npos);
  CHECK(plain.err.find(
            " s in 4 steps, cracks: object; at most a few seconds of computing expected\n") !=
        std::string::npos);
  CHECK(plain.err.find("accuracy") == std::string::npos);
  CHECK(plain.err.find("expected:") == std::string::npos);
  const Outcome verbose = run(words + " --verbose");
  const json report = json::parse(bytes_of(folder.path() / "a" / "report.json"));
  REQUIRE(report["settings"]["chosen"].size() > 5);
  for (const json& choice : report["settings"]["chosen"]) {
    const std::string key = choice["key"], reason = choice["reason"];
    INFO(key << ": " << reason);
    CHECK_FALSE(reason.empty());
    CHECK(verbose.err.find("accuracy preview: " + key + " = ") != std::string::npos);
    CHECK(verbose.err.find("(" + reason + ")\n") != std::string::npos);
  }
}

TEST_CASE("a run reports chosen settings and odd values before it starts, unless it is quiet",
          "[run]") {
  const Folder folder;
  json scene = struck_scene(0.4, 0.001);
  scene["contact"] = {{"max_passes", 2}};
  scene["bodies"][0]["material"]["density"] = 2.4;
  const fs::path path = write_scene(folder, scene);
  const std::string out = " --force --frames 0 -o " + (folder.path() / "a").string();
  const std::string told = run(path.string() + " --verbose --set accuracy=preview" + out).text();
  CHECK(told.find("accuracy preview: contact.max_iterations = 100 (") != std::string::npos);
  CHECK(told.find("contact.max_passes") == std::string::npos);
  CHECK(told.find("expected: 4 steps of 424 tetrahedra") != std::string::npos);
  CHECK(told.find("bodies.0.material.density is 2.4 kg/m^3") != std::string::npos);
  const Outcome quiet = run(path.string() + " --quiet --strict" + out);
  CHECK(told.find("odd_unit") != std::string::npos);
  CHECK(quiet.err.empty());
  CHECK(bytes_of(folder.path() / "a" / "report.json").find("odd_unit") != std::string::npos);
  CHECK(quiet.exit_code == 7);
}

TEST_CASE("bad scenes are told with place, value and remedy, exit code 3", "[run]") {
  const Folder folder;
  struct Case {
    const char* pointer;
    json value;
    const char* words;
  };
  const Case cases[] = {
      {"/bodies/0/material/young_modulos", 1, "did you mean young_modulus"},
      {"/bodies/0/material/poisson_ratio", 0.5, "poisson_ratio is 0.5"},
      {"/bodies/0/material/density", -2, "density is -2"},
      {"/time_step", 0, "time_step is 0"},
      {"/time_step", "fast", "time_step"},
      {"/bodies/0/mesh", "not_there.msh", "not_there.msh"},
      {"/bodies/0/unbreakable", json::array({{{"region", "steel"}}}), "the regions are 1"},
      {"/bodies/0/held/0/maximum", json::array({-9, -9, -9}), "held"},
  };
  for (const Case& c : cases) {
    json scene = struck_scene(0.4, 0.02);
    if (std::string(c.pointer).find("held") != std::string::npos) {
      scene["bodies"][0]["held"] = {{{"minimum", {-10, -10, -10}}, {"maximum", {0, 0, 0}}}};
    }
    scene[json::json_pointer(c.pointer)] = c.value;
    const fs::path out = folder.path() / "out";
    const Outcome o = run(write_scene(folder, scene).string() + " --quiet -o " + out.string());
    INFO(c.pointer << ": " << o.text());
    CHECK(o.exit_code == 3);
    CHECK(o.text().find(c.words) != std::string::npos);
    CHECK(!fs::exists(out / "report.json"));
  }
}

TEST_CASE("a cut mesh is named with its line, exit code 3", "[run]") {
  const Folder folder;
  std::ofstream(folder.path() / "cut.msh")
      << bytes_of(SUNDER_MESHES "/bunny.msh").substr(0, 100000);
  json scene = struck_scene(0.4, 0.02);
  scene["bodies"][0]["mesh"] = "cut.msh";
  const Outcome o =
      run(write_scene(folder, scene).string() + " --quiet -o " + (folder.path() / "out").string());
  INFO(o.text());
  CHECK(o.exit_code == 3);
  CHECK(o.text().find("cut.msh:") != std::string::npos);
}

TEST_CASE("an explicit step that diverges says where and what to do, exit code 5", "[run]") {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  const Outcome o = run(write_scene(folder, struck_scene(0.4, 0.02)).string() +
                        " --quiet --set integrator.method=verlet"
                        " --set fracture.mode=off -o " +
                        out.string());
  INFO(o.text());
  CHECK(o.exit_code == 5);
  CHECK(o.text().find("vertex") != std::string::npos);
  CHECK(o.text().find("explicit_step_bound") != std::string::npos);
  CHECK(fs::exists(out / "report.json"));
}

TEST_CASE("an output that cannot be written is exit code 4, a wrong option 2", "[run]") {
  const Folder folder;
  const std::string scene = write_scene(folder, struck_scene(0.4, 0.02)).string();
  CHECK(run(scene + " --quiet -o /proc/nowhere/out").exit_code == 4);
  CHECK(run(scene + " --no-such-option").exit_code == 2);
  CHECK(run("").exit_code == 2);
}

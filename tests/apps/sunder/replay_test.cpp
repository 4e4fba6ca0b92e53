// SPDX-License-Identifier: MIT
// Replays: the same bytes from a run's own log, and every log that is not one refused or left.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/scene/scene_hash.hpp"
#include "apps/sunder/run/recorder.hpp"
#include "apps/sunder/run/replay.hpp"
#include "mechanics/rebuild.hpp"
#include "tests/support/replay_log.hpp"

namespace fs = std::filesystem;
using namespace sunder;
using nlohmann::json;
using nlohmann::ordered_json;
using test::bytes_of;
using test::forge;
using test::lines_of;
using test::Outcome;
using test::Place;
using test::place_of;
using test::run;
using test::struck_scene;
using test::write_lines;

namespace {

/// report.json without the wall times: all of a run that may differ.
json without_times(const fs::path& report) {
  json r = json::parse(bytes_of(report));
  for (const char* times : {"step_ms", "stage_ms", "fan_us"}) r.erase(times);
  return r;
}

/// Every file of two runs byte by byte, report.json but for its times; checkpoints, which a replay
/// has none of, left out.
void hold_same(const fs::path& a, const fs::path& b) {
  std::size_t files = 0, others = 0;
  for (const auto& entry : fs::recursive_directory_iterator(a)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".checkpoint") continue;
    ++files;
    const fs::path other = b / fs::relative(entry.path(), a);
    INFO(other.string());
    if (entry.path().filename() == "report.json") {
      CHECK(without_times(entry.path()) == without_times(other));
    } else {
      CHECK(bytes_of(entry.path()) == bytes_of(other));
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(b)) {
    others += entry.is_regular_file() && entry.path().extension() != ".checkpoint";
  }
  CHECK(files == others);
}

/// Child processes that keep every core busy, until the end of the scope.
struct BusyMachine {
  std::vector<pid_t> children;
  BusyMachine() {
    for (int k = 0; k < 4; ++k) {
      const pid_t child = fork();
      if (child == 0) {
        alarm(60);  // gone even if the test is killed
        for (std::atomic<unsigned> work = 0;;) ++work;
      }
      if (child > 0) children.push_back(child);
    }
  }
  ~BusyMachine() {
    for (const pid_t child : children) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }
};

}  // namespace

TEST_CASE("a replay, and a run on a busy machine, leave the bytes of the run", "[run][replay]") {
  const Place place = place_of(struck_scene());
  const Outcome first = run(place, "a");
  INFO(first.text());
  REQUIRE(first.exit_code == 0);
  REQUIRE(json::parse(bytes_of(place.path() / "a/report.json"))["fans"] > 50);
  const Outcome again = run(place, "b", "--replay " + (place.path() / "a/events.jsonl").string());
  INFO(again.text());
  CHECK(again.exit_code == 0);
  hold_same(place.path() / "a", place.path() / "b");
  const BusyMachine busy;
  const Outcome loaded = run(place, "c", "--threads 2");
  CHECK(loaded.exit_code == 0);
  hold_same(place.path() / "a", place.path() / "c");
}

TEST_CASE("replays repeat limits, budgets, sub-steps and drawn strengths", "[run][replay]") {
  std::map<std::string, json> scenes;
  for (const char* name :
       {"limits", "budget", "fit", "relax", "energy", "object", "sub_stepped", "cohesive"}) {
    scenes[name] = struck_scene();
    scenes[name]["duration"] = 0.002;
  }
  scenes["limits"]["fracture"] = {{"smallest_piece", 2}, {"max_pieces", 12}};
  scenes["budget"]["fracture"] = {{"mode", "budget"}, {"max_fans", 5}};
  scenes["fit"]["fracture"] = {{"node_stress", "fit"}};
  scenes["fit"]["bodies"][0]["strength"] = {{"weibull", {{"modulus", 8}}}};
  for (const char* name : {"relax", "energy"}) {
    scenes[name]["fracture"] = {{"relax", 2}};
    scenes[name]["bodies"][0]["material"]["toughness"] = 1e6;
  }
  scenes["energy"]["fracture"]["criterion"] = "energy";
  scenes["object"]["fracture"] = {{"crack", "object"}};
  scenes["object"]["bodies"][0]["cuts"] = {
      {{"plane", {{"point", {0, 0, 1}}, {"normal", {0, 0, 1}}}},
       {"box", {{"minimum", {-1, -1, 0}}, {"maximum", {0, 1, 2}}}}}};
  scenes["cohesive"]["fracture"] = {{"crack", "cohesive"}, {"smallest_piece", 2}};
  scenes["cohesive"]["bodies"][0]["material"]["fracture_energy"] = 10;
  scenes["cohesive"]["bodies"][0]["material"]["shear_energy_ratio"] = 2;
  scenes["cohesive"]["duration"] = 0.001;
  scenes["sub_stepped"]["duration"] = 0.001;
  scenes["sub_stepped"]["integrator"] = {{"method", "sub_stepped"}};
  scenes["sub_stepped"]["bodies"][0]["material"]["tensile_strength"] = 1e6;
  for (const auto& [name, scene] : scenes) {
    const Place place = place_of(scene);
    const Outcome first = run(place, "a");
    INFO(name << ": " << first.text());
    REQUIRE(first.exit_code == 0);
    CHECK(json::parse(bytes_of(place.path() / "a/report.json"))["fans"] > 0);
    const Outcome again = run(place, "b", "--replay " + (place.path() / "a/events.jsonl").string());
    INFO(again.text());
    CHECK(again.exit_code == 0);
    hold_same(place.path() / "a", place.path() / "b");
  }
}

TEST_CASE("the replay of a run that failed fails alike", "[run][replay]") {
  json scene = struck_scene();
  scene["integrator"] = {{"method", "verlet"}};
  const Place place = place_of(scene);
  const Outcome first = run(place, "a");
  INFO(first.text());
  REQUIRE(first.exit_code == 5);
  const Outcome again = run(place, "b", "--replay " + (place.path() / "a/events.jsonl").string());
  INFO(again.text());
  CHECK(again.exit_code == 5);
  hold_same(place.path() / "a", place.path() / "b");
}

TEST_CASE("tampered and foreign logs are refused with line and reason", "[run][replay]") {
  json scene = struck_scene();
  scene["duration"] = 0.001;
  const Place place = place_of(scene);
  REQUIRE(run(place, "a").exit_code == 0);
  const std::vector<std::string> good = lines_of(place.path() / "a/events.jsonl");
  REQUIRE(good.size() > 10);
  const SceneFile file = *read_scene(place.scene);
  const ReplayedScene told{scene_hash(file), step_count(file.scene)};
  using Lines = std::vector<std::string>;
  const auto replaced = [](std::string& line, const std::string& key) {
    // The first digit of the value of `key`, another one.
    const std::size_t digit = line.find_first_of("0123456789", line.find("\"" + key + "\":"));
    line[digit] = line[digit] == '7' ? '6' : '7';
  };
  struct Case {
    const char* name;
    std::function<void(Lines&)> change;
    std::size_t line;
    const char* code;
    const char* words;
  };
  const Case cases[] = {
      {"dropped", [](Lines& l) { l.erase(l.begin() + 4); }, 5, "bad_event_log", "fan 3 is due"},
      {"doubled", [](Lines& l) { l.insert(l.begin() + 4, l[4]); }, 6, "bad_event_log",
       "fan 4 is due"},
      {"vertex", [&](Lines& l) { replaced(l[4], "vertex"); }, 5, "bad_event_log", "changed"},
      {"normal", [&](Lines& l) { replaced(l[4], "normal"); }, 5, "bad_event_log", "changed"},
      {"stress", [&](Lines& l) { replaced(l[4], "stress"); }, 5, "bad_event_log", "changed"},
      {"cut off", [](Lines& l) { l.pop_back(); }, good.size() - 1, "bad_event_log", "cut off"},
      {"cut in a line", [](Lines& l) { l.resize(8), l.back().resize(40); }, 8, "bad_event_log",
       "not a JSON object"},
      {"nested", [](Lines& l) { l[4] = "{\"fan\":" + std::string(200000, '['); }, 5,
       "bad_event_log", "not a JSON object"},
      {"nested and closed",
       [](Lines& l) {
         l[4] = "{\"faces\":" + std::string(200000, '[') + std::string(200000, ']') + "}";
       },
       5, "bad_event_log", "not a JSON object"},
      {"only a head", [](Lines& l) { l.resize(1); }, 1, "bad_event_log", "cut off"},
      {"empty", [](Lines& l) { l.clear(); }, 0, "bad_event_log", "cut off"},
      {"not JSON", [](Lines& l) { l[3] = "component,body"; }, 4, "bad_event_log",
       "not a JSON object"},
      {"no check", [](Lines& l) { l[3] = "{\"fan\":2}"; }, 4, "bad_event_log", "\"step\""},
      {"goes on", [](Lines& l) { l.push_back(l[1]); }, good.size() + 1, "bad_event_log",
       "after the end"},
      {"older log", [](Lines& l) { l.erase(l.begin()); }, 1, "other_log_format", "head"},
      {"later format", [&](Lines& l) { replaced(l[0], "format"); }, 1, "other_log_format",
       "format 7"},
      {"scene's hash changed", [&](Lines& l) { replaced(l[0], "scene_hash"); }, 1, "bad_event_log",
       "changed"},
  };
  for (const Case& c : cases) {
    Lines lines = good;
    c.change(lines);
    const fs::path log = place.path() / "tampered.jsonl";
    write_lines(log, lines);
    const Result<Replay> replay = read_replay(log, told);
    INFO(c.name);
    CHECK(!replay);
    REQUIRE(replay.findings.size() == 1);
    const Finding& f = replay.findings[0];
    INFO(f.line << ": " << f.text);
    CHECK(f.code == c.code);
    CHECK(f.line == c.line);
    CHECK(f.text.find(c.words) != std::string::npos);
  }
  CHECK(read_replay(place.path() / "a/events.jsonl", told));
  for (const int steps : {1, 5}) {
    forge(place.path() / "a/events.jsonl", place.path() / "steps.jsonl",
          [&](auto& lines) { lines.back()["steps"] = steps; });
    CHECK(read_replay(place.path() / "steps.jsonl", told).findings.at(0).line == good.size());
  }
  CHECK(read_replay(place.path() / "none", told).findings.at(0).code == "cannot_open");

  const std::string log = "--replay " + (place.path() / "a/events.jsonl").string();
  const Outcome other = run(place, "b", log + " --set bodies.0.material.density=2401");
  CHECK(other.exit_code == 3);
  CHECK(other.text().find("other_scene") != std::string::npos);
  CHECK(run(place, "b", log + " --png 0 --set name=renamed").exit_code == 0);
  CHECK(run(place, "a", log).exit_code == 3);
}

TEST_CASE("a log of another version of the program is replayed with a warning", "[run][replay]") {
  json scene = struck_scene();
  scene["duration"] = 0.001;
  const Place place = place_of(scene);
  REQUIRE(run(place, "a").exit_code == 0);
  const fs::path log = place.path() / "older.jsonl";
  forge(place.path() / "a/events.jsonl", log, [](auto& lines) { lines[0]["sunder"] = "0.0.1"; });
  const Outcome o = run(place, "b", "--replay " + log.string());
  INFO(o.text());
  CHECK(o.exit_code == 0);
  CHECK(o.text().find("other_program") != std::string::npos);
}

TEST_CASE("logs forged with right checks depart where they stop being this run", "[run][replay]") {
  json scene = struck_scene();
  scene["duration"] = 0.001;
  scene["fracture"]["crack"] = "paper";  // a crack as a surface does not ask for each normal
  const Place place = place_of(scene);
  REQUIRE(run(place, "a").exit_code == 0);
  const fs::path good = place.path() / "a/events.jsonl";
  using Lines = std::vector<ordered_json>;
  const auto renumber = [](Lines& l) {
    for (std::size_t k = 1; k + 1 < l.size(); ++k) l[k]["fan"] = k - 1;
    l.back()["fans"] = l.size() - 2;
  };
  struct Case {
    const char* name;
    std::function<void(Lines&)> change;
  };
  const Case cases[] = {
      {"fan dropped", [&](Lines& l) { l.erase(l.begin() + 3), renumber(l); }},
      {"fan doubled",
       [&](Lines& l) {
         l.push_back(l.back());
         for (std::size_t k = l.size() - 2; k > 3; --k) l[k] = l[k - 1];
         renumber(l);
       }},
      {"vertex changed", [](Lines& l) { l[3]["vertex"] = l[3]["vertex"].get<int>() + 1; }},
      {"vertex not there", [](Lines& l) { l[3]["vertex"] = 1000000; }},
      {"normal changed",
       [](Lines& l) {
         l[3]["normal"] = {l[3]["normal"][1], l[3]["normal"][2], l[3]["normal"][0]};
       }},
      {"normal not of unit length",
       [](Lines& l) {
         l[3]["normal"] = {0, 0, 0};
       }},
      {"later step", [](Lines& l) { l[l.size() - 2]["step"] = 1000; }},
      {"later part",
       [](Lines& l) { l[l.size() - 2]["part"] = l[l.size() - 2]["part"].get<int>() + 1000; }},
      {"said to have failed", [](Lines& l) { l.back()["end"] = "failed"; }},
  };
  for (const Case& c : cases) {
    const fs::path log = place.path() / "forged.jsonl";
    forge(good, log, c.change);
    const Outcome o = run(place, "b", "--replay " + log.string());
    INFO(c.name << ": " << o.text());
    CHECK(o.exit_code == 6);
    CHECK(o.text().find("replay_departed") != std::string::npos);
    CHECK(o.text().find("forged.jsonl:") != std::string::npos);
  }
}

TEST_CASE("a scene's hash knows every value and the mesh, and not the names", "[run][replay]") {
  const Place place = place_of(struck_scene());
  const SceneFile file = *read_scene(place.scene);
  const std::string hash = scene_hash(file);
  CHECK(hash.size() == 16);
  const auto changed = [&](const std::function<void(SceneFile&)>& change) {
    SceneFile other = file;
    change(other);
    return scene_hash(other) != hash;
  };
  CHECK(!changed([](SceneFile& f) { f.scene.name = "other", f.description = "other"; }));
  CHECK(!changed([](SceneFile& f) { f.output.frames = 7; }));
  CHECK(changed([](SceneFile& f) { f.scene.duration = 1; }));
  CHECK(changed([](SceneFile& f) { f.scene.bodies[0].mesh.points[3][1] += 1e-12; }));
  CHECK(changed([](SceneFile& f) { f.scene.bodies[0].mesh.tetrahedra.pop_back(); }));
  CHECK(changed([](SceneFile& f) { f.scene.obstacles[1].mass = 121; }));
  CHECK(changed([](SceneFile& f) { f.scene.obstacles[1].mass = std::nullopt; }));
  CHECK(changed([](SceneFile& f) { f.scene.fracture.max_fans = 65; }));
  CHECK(changed([](SceneFile& f) { f.scene.bodies[0].cuts.push_back({CutPlane{}, {}, {}}); }));
  CHECK(changed([](SceneFile& f) { f.scene.bodies[0].strength.painted = {1e6}; }));
  CHECK(changed([](SceneFile& f) { f.scene.bodies[0].strength.weibull = WeibullSettings{}; }));
}

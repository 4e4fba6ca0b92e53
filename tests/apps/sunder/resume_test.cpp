// SPDX-License-Identifier: MIT
// Runs that end before their time and go on, are extended, branch; folders that are taken.
#include "apps/sunder/run/saved/resume.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/scene/scene_hash.hpp"
#include "apps/sunder/run/replay.hpp"
#include "apps/sunder/run/saved/checkpoint.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "fracture/saving/saved_state.hpp"
#include "tests/support/program.hpp"
#include "tests/support/struck_scene.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A scene of 100 steps that breaks, saved every seventh.
json saved_scene() {
  json scene = struck_scene(0.4, 0.025);
  scene["output"] = {{"frames", 11}, {"checkpoint", {{"steps", 7}, {"minutes", 0}, {"keep", 3}}}};
  return scene;
}

/// All files that a run of the same scene writes with the same bytes, by name; of the report the
/// parts that no clock decides.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".checkpoint") continue;
    std::string bytes = bytes_of(entry.path());
    if (entry.path().filename() == "report.json") {
      json report = json::parse(bytes);
      for (const char* key : {"step_ms", "stage_ms", "fan_us"}) report.erase(key);
      report["oracle"].erase("fan_us");
      bytes = report.dump(1);
    }
    files[fs::relative(entry.path(), folder).string()] = bytes;
  }
  return files;
}

/// The names of files that differ or are missing on one side.
std::vector<std::string> differing(const fs::path& a, const fs::path& b) {
  const auto left = files_of(a), right = files_of(b);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : left) {
    if (!right.contains(name) || right.at(name) != bytes) names.push_back(name);
  }
  for (const auto& [name, bytes] : right) {
    if (!left.contains(name)) names.push_back(name);
  }
  return names;
}

/// Runs a scene in a process of its own, which gets the signal once `wait` comes true.
template <class Wait>
int run_until(const Workplace& here, const std::string& scene, const std::string& out, int signal,
              const Wait& wait) {
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    const Outcome o = here.run({"run", scene, "--quiet", "-o", out});
    _exit(o.exit_code);
  }
  setpgid(child, child);
  while (!wait() && waitpid(child, nullptr, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(-child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a killed run goes on to the bytes of one that never stopped", "[run][resume]") {
  const Workplace here;
  json settings = saved_scene();
  settings["output"]["history"] = 7.5e-4;  // three steps: checkpoints fall between lines
  const std::string scene = here.write("scene.json", settings.dump());
  REQUIRE(here.run({"run", scene, "--quiet", "-o", here.path("whole")}).exit_code == 0);
  const int signal = GENERATE(SIGKILL, SIGTERM, SIGHUP);
  const int frames = GENERATE(3, 8);
  const std::string out = here.path("killed");
  const fs::path frame = fs::path(out) / frame_name(static_cast<std::uint64_t>(frames));
  run_until(here, scene, out, signal, [&] { return fs::exists(frame); });
  // The shell between may outlive the program; the lock says when that is gone.
  while (!FolderLock::take(out)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Outcome o = here.run({"run", "--resume", out, "--quiet"});
  INFO(o.text());
  REQUIRE(o.exit_code == 0);
  CHECK(differing(here.path("whole"), out) == std::vector<std::string>{});
}

TEST_CASE("a run is extended to the bytes of a longer one, more than once", "[run][resume]") {
  const Workplace here;
  json scene = saved_scene();
  scene["bodies"][0]["order"] = GENERATE(1, 2);
  const std::string whole = here.write("whole.json", scene.dump());
  REQUIRE(here.run({"run", whole, "--quiet", "-o", here.path("whole")}).exit_code == 0);
  scene["duration"] = 0.01;
  scene["output"]["frames"] = 5;
  const std::string part = here.write("part.json", scene.dump());
  REQUIRE(here.run({"run", part, "--quiet", "-o", here.path("part")}).exit_code == 0);
  for (const char* until : {"0.015", "0.025"}) {
    const Outcome o = here.run({"run", "--resume", here.path("part"), "--until", until, "--quiet"});
    INFO(o.text());
    REQUIRE(o.exit_code == 0);
  }
  CHECK(differing(here.path("whole"), here.path("part")) == std::vector<std::string>{});
  const Outcome early = here.run({"run", "--resume", here.path("part"), "--until", "0.02"});
  CHECK(early.exit_code == 3);
  CHECK(early.err.find("over_already") != std::string::npos);
  // The extended log is that of the longer scene, and replays.
  CHECK(here.run({"run", whole, "--quiet", "-o", here.path("again"), "--replay",
                  here.path("part/events.jsonl")})
            .exit_code == 0);
}

TEST_CASE("a run is not extended beyond the steps, frames and pictures that any may have",
          "[run][resume]") {
  const Workplace here;
  json scene = saved_scene();
  scene["duration"] = 0.0025;  // 10 steps
  const auto refused = [&](const json& output, const std::string& until) {
    scene["output"] = output;
    const std::string file = here.write("scene.json", scene.dump());
    const std::string out = here.path("out");
    REQUIRE(here.run({"run", file, "--quiet", "--force", "-o", out}).exit_code == 0);
    const auto before = files_of(out);
    const Outcome o = here.run({"run", "--resume", out, "--until", until, "--quiet"});
    CHECK(o.exit_code == 3);
    CHECK(files_of(out) == before);
    return o.err;
  };
  const json frames = {{"frames", 11}, {"checkpoint", {{"steps", 7}}}};
  CHECK(refused(frames, "1e300").find("too_many_steps") != std::string::npos);
  CHECK(refused(frames, "251").find("too_many_frames") != std::string::npos);
  const json pictures = {
      {"frames", 0}, {"pictures", {{"count", 11}}}, {"checkpoint", {{"steps", 7}}}};
  CHECK(refused(pictures, "251").find("too_many_pictures") != std::string::npos);
}

TEST_CASE("a branch begins as its run and goes on by other settings", "[run][resume]") {
  const Workplace here;
  json scene = saved_scene();
  scene["output"]["checkpoint"]["keep"] = 0;
  const std::string file = here.write("scene.json", scene.dump());
  REQUIRE(here.run({"run", file, "--quiet", "-o", here.path("run")}).exit_code == 0);

  // Without a change: the same run.
  Outcome o = here.run(
      {"run", "--resume", here.path("run"), "--from", "40", "--quiet", "-o", here.path("same")});
  INFO(o.text());
  REQUIRE(o.exit_code == 0);
  CHECK(differing(here.path("run"), here.path("same")) == std::vector<std::string>{});

  // No cracks from step 40 on.
  o = here.run({"run", file, "--set", "fracture.mode=off", "--resume", here.path("run"), "--from",
                "40", "--quiet", "-o", here.path("off")});
  INFO(o.text());
  REQUIRE(o.exit_code == 0);
  const std::string log = bytes_of(here.path("off/events.jsonl"));
  std::size_t fans = 0;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const json event = json::parse(line);
    if (!event.contains("fan")) continue;
    ++fans;
    CHECK(event["step"] <= 40);
  }
  CHECK(fans > 0);
  CHECK(log.find("\"branched_at\":40") != std::string::npos);
  CHECK(bytes_of(here.path("off/frames/frame_000004.vtu")) ==
        bytes_of(here.path("run/frames/frame_000004.vtu")));
  o = here.run({"run", file, "--set", "fracture.mode=off", "--quiet", "-o", here.path("replayed"),
                "--replay", here.path("off/events.jsonl")});
  CHECK(o.exit_code == 3);
  CHECK(o.err.find("branched_log") != std::string::npos);

  // Settings of the beginning cannot be changed in mid-run.
  o = here.run({"run", file, "--set", "bodies.0.material.tensile_strength=1e6", "--resume",
                here.path("run"), "--from", "40", "-o", here.path("other")});
  CHECK(o.exit_code == 3);
  CHECK(o.err.find("not_in_mid_run") != std::string::npos);
}

TEST_CASE("a branch may leave the history out and begin it again", "[run][resume][history]") {
  const Workplace here;
  json scene = saved_scene();
  scene["output"]["checkpoint"]["keep"] = 0;
  const std::string file = here.write("scene.json", scene.dump());
  REQUIRE(here.run({"run", file, "--quiet", "-o", here.path("run")}).exit_code == 0);
  const auto branch = [&](const char* from, const char* step, const char* history, const char* to) {
    const Outcome o =
        here.run({"run", file, "--set", std::string("output.history=") + history, "--resume",
                  here.path(from), "--from", step, "--quiet", "-o", here.path(to)});
    INFO(o.text());
    REQUIRE(o.exit_code == 0);
    return bytes_of(here.path(to) + "/history.csv");
  };
  CHECK(branch("run", "42", "off", "without") == "");
  const std::string again = branch("without", "70", "2.5e-4", "again");
  CHECK(std::ranges::count(again, '\n') == 1 + 30);  // steps 71 to 100
  const std::string whole = bytes_of(here.path("run/history.csv"));
  CHECK(again.substr(0, again.find('\n')) == whole.substr(0, whole.find('\n')));
}

TEST_CASE("one run at a time, and none is replaced unasked", "[run][resume]") {
  const Workplace here;
  const std::string scene = here.write("scene.json", saved_scene().dump());
  const std::string out = here.path("out");
  {
    const auto lock = FolderLock::take(out);
    REQUIRE(lock);
    const auto second = FolderLock::take(out);
    REQUIRE_FALSE(second);
    CHECK(second.findings[0].code == "folder_in_use");
    CHECK(second.findings[0].text.find(std::to_string(getpid())) != std::string::npos);
    const Outcome o = here.run({"run", scene, "-o", out, "--force"});
    CHECK(o.exit_code == 4);
    CHECK(o.err.find("folder_in_use") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(out + "/run.lock"));
  REQUIRE(here.run({"run", scene, "--quiet", "-o", out, "--set", "duration=0.002"}).exit_code == 0);
  const auto before = files_of(out);
  const Outcome o = here.run({"run", scene, "--quiet", "-o", out});
  CHECK(o.exit_code == 4);
  CHECK(o.err.find("folder_holds_a_run") != std::string::npos);
  CHECK(files_of(out) == before);
  CHECK(here.run({"run", scene, "--quiet", "-o", out, "--force"}).exit_code == 0);
  CHECK(files_of(out) != before);
}

TEST_CASE("checkpoints and logs that are damaged are passed over or refused", "[run][resume]") {
  const Workplace here;
  const std::string scene = here.write("scene.json", saved_scene().dump());
  const std::string out = here.path("out");
  REQUIRE(here.run({"run", scene, "--quiet", "-o", out}).exit_code == 0);
  const auto latest = read_checkpoint(out);
  REQUIRE(latest);
  CHECK(steps_taken(latest->simulation) == 100);
  CHECK(steps_taken(read_checkpoint(out, 99)->simulation) == 98);
  const std::string path = out + "/checkpoints/step_0000000100.checkpoint";
  const std::string bytes = bytes_of(path);
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string other = bytes;
    if (i % 2 == 0) other.resize(random() % bytes.size());
    if (i % 2 == 1) other[random() % other.size()] ^= static_cast<char>(1 << random() % 8);
    here.write("out/checkpoints/step_0000000100.checkpoint", other);
    const auto read = read_checkpoint(out);
    if (!read) {
      CHECK(read.findings[0].code == "other_version");
      continue;
    }
    REQUIRE(steps_taken(read->simulation) == 98);
    REQUIRE(read.findings.size() == 1);
    REQUIRE(read.findings[0].severity == Severity::warning);
  }
  here.write("out/checkpoints/step_0000000100.checkpoint", bytes);
  std::string log = bytes_of(out + "/events.jsonl");
  log[log.size() / 2] ^= 1;
  here.write("out/events.jsonl", log);
  const Outcome o = here.run({"run", "--resume", out});
  CHECK(o.exit_code == 3);
  CHECK(o.err.find("other_log") != std::string::npos);
  CHECK(bytes_of(out + "/events.jsonl") == log);  // nothing was touched

  const Outcome none = here.run({"run", "--resume", here.path("nowhere")});
  CHECK(none.exit_code == 3);
  CHECK(none.err.find("no_checkpoint") != std::string::npos);
}

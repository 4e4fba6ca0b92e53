// SPDX-License-Identifier: MIT
// Runs that a signal ends: their exit code, and that they go on from their last whole step.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/sunder/run/saved/checkpoint.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/struck_scene.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;

namespace {

/// The program on `words`, its standard error in `err`.
pid_t start(std::vector<std::string> words, const std::string& err) {
  words.insert(words.begin(), SUNDER_PROGRAM);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child > 0) return child;
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  execv(SUNDER_PROGRAM, list.data());
  _exit(127);
}

/// Waits until something is there, or the program has ended.
void wait_for(pid_t child, const std::function<bool()>& is_there) {
  while (!is_there()) {
    siginfo_t ended = {};
    waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == child) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// The exit code; -1 where a signal ended it.
int ended(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A scene that breaks, of 100 steps, and saves nothing before ten minutes have passed.
json unsaved_scene() {
  json scene = struck_scene(0.4, 0.025);
  scene["output"] = {{"frames", 11}};
  return scene;
}

}  // namespace

TEST_CASE(
    "a signal leaves a checkpoint of the last whole step, and the run goes on to the same bytes",
    "[run][interrupt]") {
  const Workplace here;
  const std::string scene = here.write("scene.json", unsaved_scene().dump());
  REQUIRE(here.run({"run", scene, "--quiet", "-o", here.path("whole")}).exit_code == 0);
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const int frames = GENERATE(1, 6);
  const std::string out = here.path("out"), err = here.path("err");
  const pid_t child = start({"run", scene, "-o", out}, err);
  wait_for(child, [&] {
    return fs::exists(fs::path(out) / frame_name(static_cast<std::uint64_t>(frames)));
  });
  kill(child, signal);
  kill(child, signal);  // as a terminal and `timeout` do: at once a second time
  const int code = ended(child);
  if (code == 0) return;  // it was faster than the signal
  REQUIRE(code == 130);
  INFO(bytes_of(err));
  CHECK_THAT(bytes_of(err), Contains("saved after step "));
  CHECK(json::parse(bytes_of(out + "/report.json"))["end"] == "interrupted");
  const Result<Checkpoint> saved = read_checkpoint(out);
  REQUIRE(saved);
  // No step is lost: a frame comes after every tenth.
  CHECK(steps_taken(saved->simulation) >= static_cast<std::uint64_t>(10 * frames));
  const Outcome o = here.run({"run", "--resume", out, "--quiet"});
  INFO(o.text());
  REQUIRE(o.exit_code == 0);
  for (const char* name : {"events.jsonl", "fragments.csv", "cracks.csv", "frames.pvd",
                           "frames/frame_000010.vtu", "obstacles.csv", "history.csv"}) {
    INFO(name);
    CHECK(bytes_of(here.path("whole/") + name) == bytes_of(out + "/" + name));
  }
}

TEST_CASE("a signal in a step that does not end leaves the step's start", "[run][interrupt]") {
  const Workplace here;
  const std::string out = here.path("out"), err = here.path("err");
  // One step, in which the bunny shatters: sub-steps of an impact, too many to come to an end here.
  const pid_t child = start({"run", SUNDER_SCENES "/bunny.json", "--set", "time_step=2", "--set",
                             "impact.max_sub_steps=1000000", "-o", out},
                            err);
  wait_for(child, [&] { return bytes_of(err).find("step 0/1  t = ") != std::string::npos; });
  kill(child, SIGTERM);
  CHECK(ended(child) == 130);
  const Result<Checkpoint> saved = read_checkpoint(out);
  REQUIRE(saved);
  CHECK(steps_taken(saved->simulation) == 0);
}

TEST_CASE("a signal while the scene is read ends the program in good order", "[run][interrupt]") {
  const Workplace here;
  const std::string pipe = here.path("pipe.msh"), err = here.path("err");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  json scene = unsaved_scene();
  scene["bodies"][0]["mesh"] = pipe;
  const std::string file = here.write("scene.json", scene.dump());
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const pid_t child = start({"run", file, "-o", here.path("out")}, err);
  const int mesh = open(pipe.c_str(), O_WRONLY);  // waits until the program reads
  REQUIRE(mesh >= 0);
  kill(child, signal);
  CHECK(ended(child) == 130);
  close(mesh);
  CHECK_FALSE(fs::exists(here.path("out")));
  CHECK_THAT(bytes_of(err), Contains("interrupted"));
}

TEST_CASE("a scene that wants no checkpoints gets none of a signal", "[run][interrupt]") {
  const Workplace here;
  json scene = unsaved_scene();
  scene["output"]["checkpoint"] = {{"minutes", 0}};
  const std::string file = here.write("scene.json", scene.dump()), out = here.path("out");
  const pid_t child = start({"run", file, "-o", out}, here.path("err"));
  wait_for(child, [&] { return fs::exists(fs::path(out) / frame_name(1)); });
  kill(child, SIGTERM);
  const int code = ended(child);
  CHECK((code == 130 || code == 0));
  CHECK_FALSE(read_checkpoint(out));
}

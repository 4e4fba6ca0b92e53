// SPDX-License-Identifier: MIT
// The line that names a scene, and the progress of a run, within a long step too.
#include "apps/sunder/run/progress.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <regex>
#include <thread>

#include "apps/sunder/run/report/scene_line.hpp"
#include "apps/sunder/run/report/settings_report.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;

namespace {

/// Sends this process's stderr to a file while it lives.
class StderrTo {
 public:
  explicit StderrTo(const std::string& path) : before_(dup(STDERR_FILENO)) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDERR_FILENO);
    close(file);
  }
  StderrTo(const StderrTo&) = delete;
  StderrTo& operator=(const StderrTo&) = delete;
  ~StderrTo() {
    dup2(before_, STDERR_FILENO);
    close(before_);
  }

 private:
  int before_;
};

void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(10)); }

Scene scene_of(std::size_t bodies) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.name = "test";
  scene.duration = 0.12;
  scene.integrator.time_step = 2e-5;
  for (std::size_t b = 0; b < bodies; ++b) {
    BodySettings body;
    body.mesh.tetrahedra.resize(1234);
    body.material.young_modulus = 1e9;
    body.material.tensile_strength = 6e5;
    scene.bodies.push_back(body);
  }
  return scene;
}

}  // namespace

TEST_CASE("a scene is one line", "[run][progress]") {
  Scene scene = scene_of(1);
  CHECK(
      scene_line(scene) ==
      "test: 1 body of 1 234 tetrahedra, E 1 GPa, strength 600 kPa, gravity 9.81 m/s^2; 0.12 s in "
      "6 000 steps, cracks: paper");
  scene.bodies[0].velocity = {0, 0, -5};
  scene.fracture.crack = CrackMode::object;
  CHECK(scene_line(scene) ==
        "test: 1 body of 1 234 tetrahedra, E 1 GPa, strength 600 kPa, falls at 5 m/s; 0.12 s in "
        "6 000 steps, cracks: object");
  scene.bodies[0].velocity = {5, 0, 0};
  CHECK(scene_line(scene).find(", moves at 5 m/s;") != std::string::npos);
  scene.fracture.mode = FractureMode::off;
  CHECK(scene_line(scene).find("nothing breaks") != std::string::npos);
  CHECK(scene_line(scene).find("strength") == std::string::npos);
}

TEST_CASE("the line of a scene names what drives it and where bodies differ", "[run][progress]") {
  Scene two = scene_of(2);
  two.bodies[1].material.young_modulus = 7e10;
  two.obstacles = {{.shape = Plane{}}, {.shape = Sphere{}, .velocity = {0, 14, 0}}};
  CHECK(scene_line(two).find("2 bodies of 2 468 tetrahedra, E 1 to 70 GPa, strength 600 kPa, 1 "
                             "obstacle at 14 m/s;") != std::string::npos);
  two.bodies[0].velocity = {0, 0, -1};
  two.bodies[1].velocity = {0, 0, -3};
  CHECK(scene_line(two).find("falling at up to 3 m/s, 1 obstacle at 14 m/s;") != std::string::npos);

  Scene held = scene_of(1);
  held.name = "";
  held.bodies[0].held.resize(2);
  CHECK(scene_line(held).starts_with("scene: "));
  CHECK(scene_line(held).find(", held, gravity 9.81 m/s^2;") != std::string::npos);
  held.bodies[0].held[1].velocity = {3e-3, 0, 0};
  CHECK(scene_line(held).find(", supports move at 0.003 m/s;") != std::string::npos);
  held.bodies[0].loads.resize(1);
  held.gravity.acceleration.setZero();
  held.bodies[0].held.clear();
  CHECK(scene_line(held).find(", loaded;") != std::string::npos);
  held.bodies[0].loads.clear();
  CHECK(scene_line(held).find(", at rest;") != std::string::npos);
}

TEST_CASE("a scene's name moves no cursor and breaks no line", "[run][progress]") {
  Scene scene = scene_of(1);
  scene.name = "a\nb\033[2Jc\rd";
  const std::string line = scene_line(scene);
  INFO(line);
  CHECK(line.starts_with(R"(a\x0ab\x1b[2Jc\x0dd: )"));
}

TEST_CASE("a line of progress has step, time, pieces, fans and wall time", "[run][progress]") {
  const ProgressState state{50, 200, 0.05, 3, 7};
  CHECK(progress_line(state, 10, 30, 8) ==
        "[##------] step 50/200  t = 0.050000 s  3 pieces  7 fans  0:10 gone  0:30 left");
  CHECK(progress_line({0, 200, 0, 1, 1}, 10, 4000, 0) ==
        "step 0/200  t = 0.000000 s  1 piece  1 fan  0:10 gone  1:06:40 left");
}

TEST_CASE("the expected time is printed in words", "[run][progress]") {
  CHECK(time_words(0.3) == "at most a few seconds");
  CHECK(time_words(4.4) == "about 4 s");
  CHECK(time_words(57) == "about 57 s");
  CHECK(time_words(150) == "about 3 min");
  CHECK(time_words(5000) == "about 83 min");
  CHECK(time_words(1e6) == "about 280 h");
}

TEST_CASE("progress is printed while the step goes on, from where the step has come to",
          "[run][progress]") {
  const Workplace here;
  const std::string path = here.path("err");
  {
    const StderrTo file(path);
    Progress progress(false, {.step = 3, .steps = 9, .pieces = 1}, {{}, 0, 1});
    progress.reach(0.0125, 42);
    // The caller is busy here; the thread prints.
    while (bytes_of(path).find('\n') == std::string::npos) wait_a_little();
  }
  const std::string text = bytes_of(path);
  INFO(text);
  CHECK(text.starts_with("step 3/9  t = 0.012500 s  1 piece  42 fans  "));
}

TEST_CASE("work of unknown length has one line in a file, however long it takes",
          "[run][progress]") {
  const Workplace here;
  const std::string path = here.path("err");
  {
    const StderrTo file(path);
    const Heartbeat work(false, line_of_work("opening the files"));
    while (bytes_of(path).empty()) wait_a_little();
    std::this_thread::sleep_for(std::chrono::milliseconds(2300));  // two more beats
  }
  CHECK(bytes_of(path) == "opening the files\n");
}

TEST_CASE("quiet progress prints nothing and holding it keeps it silent", "[run][progress]") {
  const Workplace here;
  const std::string path = here.path("err");
  {
    const StderrTo file(path);
    Progress quiet(true, {}, {{}, 0, 1});
    Progress progress(false, {}, {{}, 0, 1});
    const auto held = progress.hold();
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    CHECK(bytes_of(path).empty());
  }
}

TEST_CASE("a run reports its progress within a step that does not end", "[run][progress]") {
  const Workplace here;
  const std::string err = here.path("err"), out = here.path("out");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int file = open(err.c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(file, STDERR_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    // One step, in which the bunny shatters: sub-steps of an impact, too many to come to an end
    // here.
    execl(SUNDER_PROGRAM, SUNDER_PROGRAM, "run", SUNDER_SCENES "/bunny.json", "--set",
          "time_step=0.8", "--set", "impact.max_sub_steps=1000000", "-o", out.c_str(), nullptr);
    _exit(127);
  }
  const std::regex within("step 0/1  t = 0\\.0*[1-9]");
  bool shown = false;
  while (!shown && waitpid(child, nullptr, WNOHANG) == 0) {
    wait_a_little();
    shown = std::regex_search(bytes_of(err), within);
  }
  INFO(bytes_of(err));
  CHECK(shown);
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
}

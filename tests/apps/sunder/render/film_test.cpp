// SPDX-License-Identifier: MIT
// Films: the frames that they show, their speed, and encoders that are there, missing or failing.
#include "apps/sunder/render/film.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/sunder/process/run_process.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;

TEST_CASE("a film shows each frame once, or keeps to a speed", "[film]") {
  const std::vector<double> times = {0, 0.1, 0.2, 0.3, 0.4};
  const Result<FilmPlan> each = film_plan(times, {.rate = 25});
  REQUIRE(each);
  CHECK(each->frames == std::vector<std::size_t>{0, 1, 2, 3, 4});
  CHECK(each->seconds == Approx(0.2));
  CHECK(each->slower == Approx(0.4));
  CHECK(film_words(*each) == "5 pictures, 0.2 s, 2.5 times faster than life");
  const Result<FilmPlan> slow = film_plan(times, {.rate = 10, .slower = 3.0});
  REQUIRE(slow);
  REQUIRE(slow->frames.size() == 13);
  CHECK(slow->frames == std::vector<std::size_t>{0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4});
  CHECK(film_words(*slow) == "13 pictures, 1.3 s, 3 times slower than life");
  // Frames at uneven times: each picture has the nearest.
  const std::vector<double> uneven = {0, 0.01, 0.1};
  const Result<FilmPlan> fast = film_plan(uneven, {.rate = 100, .slower = 1.0});
  REQUIRE(fast);
  CHECK(fast->frames == std::vector<std::size_t>{0, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2});
}

TEST_CASE("runs of one frame and films without end are refused", "[film]") {
  const Result<FilmPlan> one = film_plan(std::vector<double>{0.5}, {});
  REQUIRE_FALSE(one);
  CHECK(one.findings[0].code == "one_frame");
  const Result<FilmPlan> endless = film_plan(std::vector<double>{0, 1}, {.slower = 1e6});
  REQUIRE_FALSE(endless);
  CHECK(endless.findings[0].code == "long_film");
  CHECK(endless.findings[0].remedy.find("--slower") != std::string::npos);
}

TEST_CASE("endings tell films from pictures", "[film]") {
  for (const char* name : {"a.mp4", "b.webm", "c/d.gif"}) CHECK(is_film(name));
  for (const char* name : {"a.png", "mp4", "a.mp4.png", "a.MOV", ""}) CHECK_FALSE(is_film(name));
}

#if defined(SUNDER_HAS_RENDERER)
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A run of a few frames, in `folder`; false where nothing can be drawn here.
bool run_cube(const Workplace& here, const std::string& folder) {
  const Outcome run = here.run({"break", sample_mesh("cube.msh"), "--size", "20cm", "--ball",
                                "60mm@30m/s", "--duration", "0.001", "--time-step", "2e-4",
                                "--no-film", "-o", here.path("cube")});
  INFO(run.text());
  if (run.text().find("no_renderer") != std::string::npos) return false;
  REQUIRE(run.exit_code == 0);
  CHECK_FALSE(fs::exists(here.path("cube") + "/cube.mp4"));
  CHECK(folder == here.path("cube") + "/run");
  return true;
}

/// PATH is `folder` until the end of its life.
class Path {
 public:
  explicit Path(const std::string& folder) : before_(std::getenv("PATH")) {
    setenv("PATH", folder.c_str(), 1);
  }
  ~Path() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

}  // namespace

TEST_CASE("a run becomes a film by the encoder, and pictures without one", "[film]") {
  const Workplace here;
  const std::string run = here.path("cube") + "/run", film = here.path("cube.mp4");
  if (!run_cube(here, run)) return;
  const std::vector<std::string> words = {"render", run, film, "--size", "64,49"};
  SECTION("ffmpeg encodes it") {
    if (!find_encoder()) {
      WARN("skipped: ffmpeg is not installed");
      return;
    }
    const Outcome made = here.run(words);
    INFO(made.text());
    REQUIRE(made.exit_code == 0);
    CHECK(made.out.find("6 pictures, 0.24 s, 200 times slower than life") != std::string::npos);
    CHECK(bytes_of(film).substr(4, 4) == "ftyp");
    CHECK_FALSE(fs::exists(here.path("cube_pictures")));
    const std::string gif = here.path("cube.gif");
    REQUIRE(here.run({"render", run, gif, "--size", "64,48", "--slower", "400"}).exit_code == 0);
    CHECK(bytes_of(gif).substr(0, 4) == "GIF8");
  }
  SECTION("without an encoder its pictures stay") {
    const Path none("/nonexistent");
    const Outcome kept = here.run(words);
    INFO(kept.text());
    CHECK(kept.exit_code == 4);
    CHECK(kept.err.find("no_encoder") != std::string::npos);
    CHECK(kept.err.find("ffmpeg -framerate 25 -i") != std::string::npos);
    CHECK_FALSE(fs::exists(film));
    CHECK(fs::exists(here.path("cube_pictures") + "/picture_000000.png"));
    CHECK(fs::exists(here.path("cube_pictures") + "/picture_000005.png"));
  }
  SECTION("an encoder that fails leaves no film") {
    const std::string fake = here.write("ffmpeg", "#!/bin/sh\necho no such codec\nexit 1\n");
    fs::permissions(fake, fs::perms::owner_all);
    const Path path(fs::path(fake).parent_path().string());
    const Outcome failed = here.run(words);
    CHECK(failed.exit_code == 4);
    CHECK(failed.err.find("no such codec") != std::string::npos);
    CHECK(failed.err.find("not_encoded") != std::string::npos);
    CHECK_FALSE(fs::exists(film));
    CHECK(fs::exists(here.path("cube_pictures") + "/picture_000000.png"));
  }
}

TEST_CASE("options of films and pictures do not mix", "[film]") {
  const Workplace here;
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"a.mp4", "--all"},
                                             {"a.mp4", "--time", "1"},
                                             {"a.png", "--rate", "30"},
                                             {"a.png", "--slower", "3"},
                                             {"a.avi"},
                                             {"a.mp4", "--rate", "0"}}) {
    std::vector<std::string> all = {"render", here.path("none")};
    all.insert(all.end(), words.begin(), words.end());
    CHECK(here.run(all).exit_code == 2);
  }
}
#endif

// SPDX-License-Identifier: MIT
// Output settings checked against their scene.
#include "apps/scene/check_output.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <vector>

using namespace sunder;

namespace {

using All = std::vector<std::string>;

/// Codes and places.
All wrong(const OutputSettings& output, const Scene& scene) {
  All found;
  for (const SettingFinding& f : check_output(output, scene)) {
    CHECK(f.finding.severity == Severity::error);
    CHECK_FALSE(f.finding.remedy.empty());
    CHECK(f.finding.text.starts_with(f.place + " "));
    found.push_back(f.finding.code + " " + f.place);
  }
  return found;
}

}  // namespace

TEST_CASE("an interval that asks for more frames than the key frames may is refused",
          "[run][scene]") {
  Scene scene;
  scene.integrator.time_step = 1e-6;
  scene.duration = 500;
  OutputSettings output;
  CHECK(wrong(output, scene).empty());  // as many as `frames` says
  output.frame_interval = 1e-3;
  CHECK(wrong(output, scene).empty());
  output.frame_interval = 1e-4;
  CHECK(wrong(output, scene) == All{"too_many_frames output.frame_interval"});
  // No frame falls between two steps.
  output.frame_interval = 1e-30;
  CHECK(wrong(output, scene) == All{"too_many_frames output.frame_interval"});
  scene.duration = 0.5;
  CHECK(wrong(output, scene).empty());
}

TEST_CASE("a history of more rows than may be is refused", "[run][scene]") {
  Scene scene;
  scene.integrator.time_step = 1e-6;
  scene.duration = 500;
  OutputSettings output;
  for (const double interval : {0.0, 1e-3}) {
    output.history.interval = interval;
    CHECK(wrong(output, scene).empty());
  }
  output.history.interval = 1e-4;
  CHECK(wrong(output, scene) == All{"too_many_rows output.history"});
  output.history.interval = -1;
  CHECK(wrong(output, scene) == All{"out_of_range output.history"});
}

TEST_CASE("numbers that a scene file could not have are refused too", "[run][scene]") {
  OutputSettings output;
  output.frames = 4'000'000'000;
  output.pictures.count = 4'000'000'000;
  CHECK(wrong(output, {}) ==
        All{"out_of_range output.frames", "out_of_range output.pictures.count"});
  output = {};
  output.pictures.times = {1, std::numeric_limits<double>::quiet_NaN()};
  CHECK(wrong(output, {}) == All{"out_of_range output.pictures.times.1"});
}

TEST_CASE("smooth cracks need planes", "[run][scene]") {
  OutputSettings output;
  output.crack_surface = CrackSurface::smooth;
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  CHECK(wrong(output, scene) == All{"no_crack_planes output.crack_surface"});
  scene.fracture.crack = CrackMode::object;
  CHECK(wrong(output, scene).empty());
}

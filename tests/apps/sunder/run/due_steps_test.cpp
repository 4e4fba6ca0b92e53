// SPDX-License-Identifier: MIT
// Steps of frames and of rows of the history.
#include "apps/sunder/run/due_steps.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("frames are spread evenly with both ends, or by their interval", "[run][due_steps]") {
  using Steps = std::vector<std::uint64_t>;
  CHECK(even_steps(100, 0).empty());
  CHECK(even_steps(100, 1) == Steps{100});
  CHECK(even_steps(100, 3) == Steps{0, 50, 100});
  CHECK(even_steps(2, 10) == Steps{0, 1, 2});
  Scene scene;
  scene.integrator.time_step = 1e-3;
  scene.duration = 0.01;
  CHECK(step_count(scene) == 10);
  CHECK(interval_steps(scene, 4e-3) == Steps{0, 4, 8});
  // No frame falls between two steps.
  CHECK(interval_steps(scene, 1e-5).size() == 11);
  scene.duration = 0.0101;
  CHECK(step_count(scene) == 11);
}

TEST_CASE("rows of the history come by their interval, or at most 2 000 times",
          "[run][due_steps]") {
  using Steps = std::vector<std::uint64_t>;
  SceneFile file;
  file.scene.integrator.time_step = 1e-3;
  file.scene.duration = 0.005;
  CHECK(due_history_rows(file) == Steps{0, 1, 2, 3, 4, 5});
  file.output.history.interval = 2e-3;
  CHECK(due_history_rows(file) == Steps{0, 2, 4});
  file.output.history.interval = 0;
  CHECK(due_history_rows(file).empty());
  file.output.history.interval.reset();
  file.scene.duration = 5;
  CHECK(due_history_rows(file).size() == 1667);  // every third of 5 000 steps, and the start
}

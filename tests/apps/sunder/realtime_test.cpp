// SPDX-License-Identifier: MIT
// Frames against the clock, and the budget of an interactive run.
#include "apps/sunder/run/realtime.hpp"

#include <catch2/catch.hpp>
#include <chrono>

using namespace sunder;

TEST_CASE("what is ahead of the clock waits for it", "[run]") {
  const auto start = std::chrono::steady_clock::now();
  FrameClock clock;
  for (int step = 1; step <= 24; ++step) clock.keep_up(step / 240.0);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CHECK(wall >= 0.1 - 1e-6);
  const nlohmann::ordered_json report = clock.report();
  CHECK(report["frames"] == 6);
  CHECK(report["median_ms"].get<double>() <= report["p99_ms"].get<double>());
  CHECK(report["p99_ms"].get<double>() <= report["worst_ms"].get<double>());
  CHECK(frame_line(report).find("6 of 1/60 s") != std::string::npos);
}

TEST_CASE("a late frame stops the clock, and later frames keep their length", "[run]") {
  using Clock = std::chrono::steady_clock;
  FrameClock clock;
  const auto busy = Clock::now() + std::chrono::milliseconds(60);
  while (Clock::now() < busy) {
  }
  clock.keep_up(1.0 / 60);
  CHECK(clock.slowed() > 0.04);
  CHECK(clock.report()["late"] == 1);
  const auto start = Clock::now();
  for (int frame = 2; frame <= 5; ++frame) clock.keep_up(frame / 60.0);
  // A clock that went on would let these frames through at once.
  CHECK(std::chrono::duration<double>(Clock::now() - start).count() > 3.9 / 60);
  const nlohmann::ordered_json report = clock.report();
  CHECK(report["speed"].get<double>() < 0.7);
  CHECK(report["slowed"].get<double>() == clock.slowed());
}

TEST_CASE("a scene's own budget stays", "[run]") {
  FractureSettings all, own, off;
  own.mode = FractureMode::budget;
  own.max_fans = 5;
  off.mode = FractureMode::off;
  for (FractureSettings* f : {&all, &own, &off}) set_frame_budget(*f);
  CHECK(all.mode == FractureMode::budget);
  CHECK(all.budget_time == frame_time);
  CHECK(own.max_fans == 5);
  CHECK(own.budget_time == 0);
  CHECK(off.mode == FractureMode::off);
}

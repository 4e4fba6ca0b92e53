// SPDX-License-Identifier: MIT
// Frames against the clock.
#include "apps/sunder/run/realtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace sunder {

void set_frame_budget(FractureSettings& fracture) {
  if (fracture.mode != FractureMode::all) return;
  fracture.mode = FractureMode::budget;
  fracture.max_fans = 32;
  fracture.max_new_pieces = 16;
  fracture.budget_time = frame_time;
}

FrameClock::FrameClock() : start_(Clock::now()), frame_start_(start_) {}

void FrameClock::keep_up(double time) {
  // Half a rounding of the step that ends a frame must not put it off by one.
  if (time < next_ - 1e-9) return;
  while (time >= next_ - 1e-9) next_ += frame_time;
  const auto due =
      start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time));
  reached_ = time;
  const auto now = Clock::now();
  frame_ms_.push_back(std::chrono::duration<double, std::milli>(now - frame_start_).count());
  if (now > due) {
    start_ += now - due;
    slowed_ += std::chrono::duration<double>(now - due).count();
  }
  std::this_thread::sleep_until(due);
  frame_start_ = Clock::now();
}

nlohmann::ordered_json FrameClock::report() const {
  std::vector<double> ms = frame_ms_;
  std::sort(ms.begin(), ms.end());
  const auto at = [&](double share) {
    if (ms.empty()) return 0.0;
    return ms[std::min(ms.size() - 1,
                       static_cast<std::size_t>(share * static_cast<double>(ms.size())))];
  };
  const auto late = std::ranges::count_if(ms, [](double m) { return m > 1000 * frame_time; });
  return {{"frames", ms.size()},
          {"late", late},
          {"median_ms", at(0.5)},
          {"p99_ms", at(0.99)},
          {"worst_ms", at(1)},
          {"slowed", slowed_},
          {"speed", reached_ > 0 ? reached_ / (reached_ + slowed_) : 1}};
}

std::string frame_line(const nlohmann::ordered_json& report) {
  return fmt::format(
      "frames         {} of 1/60 s, {} late; median {:.3g} ms, 99 % within {:.3g} ms, worst {:.3g} "
      "ms\n"
      "real time      {:.3g} of the clock's speed, {:.2f} s late in all\n",
      report["frames"].get<std::size_t>(), report["late"].get<std::size_t>(),
      report["median_ms"].get<double>(), report["p99_ms"].get<double>(),
      report["worst_ms"].get<double>(), report["speed"].get<double>(),
      report["slowed"].get<double>());
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Runs in step with the clock on the wall.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fracture/scene/scene.hpp"

namespace sunder {

/// s, of a frame.
inline constexpr double frame_time = 1.0 / 60;

/// Gives a scene in which all breaks at once (`FractureMode::all`) the budget of an interactive
/// run: 32 fans and 16 new pieces a frame. Others keep theirs.
void set_frame_budget(FractureSettings& fracture);

/// Paces a run by the clock on the wall. A frame ends with the step that reaches the next multiple
/// of 1/60 s. A run that is ahead waits. A late frame stops the clock meanwhile, so that delays
/// never add up: later frames keep their length.
class FrameClock {
 public:
  FrameClock();
  /// After a step, at simulated `time` (s): waits where that is ahead.
  void keep_up(double time);
  /// s, that the clock has been stopped in all.
  double slowed() const { return slowed_; }
  /// Frames, how long they took (ms: median, 99th of a hundred, worst), how many took longer than
  /// 1/60 s, for how long the clock was stopped (s), and simulated time over the wall's.
  nlohmann::ordered_json report() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_, frame_start_;  ///< `start_`: later by the stops of the clock
  double next_ = frame_time, reached_ = 0, slowed_ = 0;
  std::vector<double> frame_ms_;
};

/// That in a line.
std::string frame_line(const nlohmann::ordered_json& report);

}  // namespace sunder

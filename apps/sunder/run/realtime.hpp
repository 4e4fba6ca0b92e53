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

/// Holds simulated time against the wall's. A frame ends with the step that reaches the next multiple
/// of 1/60 s; what is ahead of the clock waits.
class FrameClock {
 public:
  FrameClock();
  /// After a step, at simulated `time` (s): waits where that is ahead.
  void keep_up(double time);
  /// s, that simulated time is behind the wall's; 0 where it is not.
  double behind() const { return behind_; }
  /// Frames, how long they took (ms: median, 99th of a hundred, worst), how many took longer than
  /// 1/60 s, and how far behind the run is and was at most, s.
  nlohmann::ordered_json report() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_, frame_start_;
  double next_ = frame_time, behind_ = 0, most_behind_ = 0;
  std::vector<double> frame_ms_;
};

/// That in a line.
std::string frame_line(const nlohmann::ordered_json& report);

}  // namespace sunder

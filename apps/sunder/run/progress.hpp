// SPDX-License-Identifier: MIT
// How far a run is, on stderr: a bar on a terminal, a plain line every few seconds elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace sunder {

/// What a line of progress tells.
struct ProgressState {
  std::uint64_t step = 0, steps = 0;
  /// s, simulated.
  double time = 0;
  std::size_t pieces = 0, fans = 0;
  /// s, behind the clock on the wall; 0: not, or not asked.
  double behind = 0;
};

/// Writes to stderr, at most ten times a second on a terminal, every three seconds elsewhere; takes
/// its line away from the terminal when destroyed.
class Progress {
 public:
  /// `quiet` shows nothing.
  explicit Progress(bool quiet);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void show(const ProgressState& state);

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_, terminal_;
  bool shown_ = false;
  Clock::time_point start_, last_;
};

/// The line itself: `part` of a bar of `width` characters (0: no bar), step, time, pieces, fans and
/// the wall time left, judged from `elapsed` seconds.
std::string progress_line(const ProgressState& state, double elapsed, std::size_t width);

}  // namespace sunder

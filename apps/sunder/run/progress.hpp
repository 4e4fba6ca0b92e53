// SPDX-License-Identifier: MIT
// How far a run is, on stderr: one line drawn again on a terminal, a line per second elsewhere.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "apps/sunder/run/remaining_time.hpp"

namespace sunder {

/// Where a run stands, for its line of progress.
struct ProgressState {
  std::uint64_t step = 0, steps = 0;
  /// s, simulated; moves within a step too.
  double time = 0;
  std::size_t pieces = 0, fans = 0;
  /// s that late frames have stopped the clock of a real-time run; 0: none, or no such run.
  double slowed = 0;
};

/// The line of a run: a bar of `width` characters (0: no bar), step, simulated time, pieces, fans,
/// wall time since the start (`elapsed`, s) and until the end (`left`, s).
std::string progress_line(const ProgressState& state, double elapsed, double left,
                          std::size_t width);

/// Prints a line to stderr from a thread of its own, however long the caller is busy: every 0.2 s
/// on a terminal, where it replaces the last one, every second elsewhere. Where the system gives no
/// thread nothing is printed. Elsewhere than on a terminal the same line is not printed twice.
class Heartbeat {
 public:
  /// Gives the line after `elapsed` seconds, with a bar of `width` characters where it has one.
  /// Called from the thread.
  using Line = std::function<std::string(double elapsed, std::size_t width)>;

  /// `quiet` prints nothing.
  Heartbeat(bool quiet, Line line);
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;
  /// Takes the line off the terminal.
  ~Heartbeat();

  /// Takes the line off the terminal; none is printed until the lock is released.
  std::unique_lock<std::mutex> hold();

 private:
  using Clock = std::chrono::steady_clock;

  void print_until_end();
  void print(double elapsed);
  void wipe();

  Line line_;
  bool terminal_, shown_ = false, ended_ = false;
  std::string last_;
  std::mutex printing_;
  std::condition_variable end_;
  Clock::time_point start_;
  std::thread thread_;
};

/// A heartbeat for work of unknown length: its name and, on a terminal, the time since its start.
/// Elsewhere its line comes once, as further ones would say nothing new.
Heartbeat::Line line_of_work(std::string_view name);

/// A heartbeat for the steps of a run. Its functions may be called while the thread prints.
class Progress {
 public:
  /// `quiet` shows nothing. `remaining`: of the run from here on.
  Progress(bool quiet, const ProgressState& start, RemainingTime remaining);

  /// After a step.
  void show(const ProgressState& state);
  /// Within a step that has reached `time` (s) and has made `fans` so far.
  void reach(double time, std::size_t fans);
  /// As `Heartbeat::hold`.
  std::unique_lock<std::mutex> hold() { return heartbeat_.hold(); }

 private:
  std::string line(double elapsed, std::size_t width) const;
  double elapsed() const;

  mutable std::mutex changing_;
  ProgressState state_;
  RemainingTime remaining_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Heartbeat heartbeat_;
};

}  // namespace sunder

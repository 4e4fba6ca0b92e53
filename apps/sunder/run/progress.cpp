// SPDX-License-Identifier: MIT
// Lines of progress.
#include "apps/sunder/run/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <system_error>

#include "apps/sunder/telling.hpp"
#include "topology/base/counted.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

std::string wall_time(double seconds) {
  const auto s = whole_number<std::uint64_t>(seconds + 0.5);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

double share_done(const ProgressState& state) {
  if (state.steps == 0) return 1;
  return static_cast<double>(state.step) / static_cast<double>(state.steps);
}

/// Characters in a line of the terminal behind stderr.
std::size_t terminal_columns() {
  winsize size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

std::string progress_line(const ProgressState& state, double elapsed, double left,
                          std::size_t width) {
  std::string line;
  if (width > 0) {
    const auto filled =
        whole_number<std::size_t>(share_done(state) * static_cast<double>(width), width);
    line = fmt::format("[{:-<{}}] ", std::string(filled, '#'), width);
  }
  line += fmt::format("step {}/{}  t = {:.6f} s  {}  {}", state.step, state.steps, state.time,
                      counted(state.pieces, "piece"), counted(state.fans, "fan"));
  if (state.slowed > 0) line += fmt::format("  {:.2f} s late", state.slowed);
  line += fmt::format("  {} gone  {} left", wall_time(elapsed), wall_time(left));
  return line;
}

Heartbeat::Heartbeat(bool quiet, Line line)
    : line_(std::move(line)), terminal_(is_terminal(STDERR_FILENO)), start_(Clock::now()) {
  if (quiet) return;
  try {
    thread_ = std::thread([this] { print_until_end(); });
  } catch (const std::system_error&) {
    // Work matters more than its progress.
  }
}

Heartbeat::~Heartbeat() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(printing_);
    ended_ = true;
  }
  end_.notify_one();
  thread_.join();
  wipe();
}

std::unique_lock<std::mutex> Heartbeat::hold() {
  std::unique_lock<std::mutex> lock(printing_);
  wipe();
  return lock;
}

void Heartbeat::print_until_end() {
  const auto pause = std::chrono::milliseconds(terminal_ ? 200 : 1000);
  Clock::time_point next = start_ + pause;
  std::unique_lock<std::mutex> lock(printing_);
  while (!end_.wait_until(lock, next, [this] { return ended_; })) {
    try {
      print(std::chrono::duration<double>(Clock::now() - start_).count());
    } catch (const std::bad_alloc&) {
      // The run itself reports that memory ran out.
    }
    next = std::max(next + pause, Clock::now());
  }
}

void Heartbeat::print(double elapsed) {
  std::string line = line_(elapsed, 0);
  if (terminal_) {
    // A line longer than the terminal's could not be replaced.
    constexpr std::size_t longest_bar = 24, shortest_bar = 6, frame = 3;
    const std::size_t room = terminal_columns() - 1;
    if (line.size() + frame + shortest_bar <= room) {
      line = line_(elapsed, std::min(longest_bar, room - frame - line.size()));
    }
    line.resize(std::min(line.size(), room));
  } else if (line == last_) {
    return;
  }
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
  std::fflush(stderr);
  shown_ = true;
  last_ = std::move(line);
}

void Heartbeat::wipe() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

Heartbeat::Line line_of_work(std::string_view name) {
  return [name = std::string(name), terminal = is_terminal(STDERR_FILENO)](double elapsed,
                                                                           std::size_t) {
    return terminal ? fmt::format("{}  {}", name, wall_time(elapsed)) : name;
  };
}

Progress::Progress(bool quiet, const ProgressState& start, RemainingTime remaining)
    : state_(start),
      remaining_(std::move(remaining)),
      heartbeat_(quiet,
                 [this](double elapsed, std::size_t width) { return line(elapsed, width); }) {}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::show(const ProgressState& state) {
  const std::lock_guard<std::mutex> lock(changing_);
  state_ = state;
  remaining_.reach(state.time, elapsed());
}

void Progress::reach(double time, std::size_t fans) {
  const std::lock_guard<std::mutex> lock(changing_);
  state_.time = time;
  state_.fans = fans;
  remaining_.reach(time, elapsed());
}

std::string Progress::line(double elapsed, std::size_t width) const {
  const std::lock_guard<std::mutex> lock(changing_);
  return progress_line(state_, elapsed, remaining_.left(), width);
}

}  // namespace sunder

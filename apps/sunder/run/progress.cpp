// SPDX-License-Identifier: MIT
// Lines of progress.
#include "apps/sunder/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "apps/sunder/telling.hpp"

namespace sunder {
namespace {

std::string wall_time(double seconds) {
  const auto s = static_cast<std::uint64_t>(seconds + 0.5);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

std::string progress_line(const ProgressState& state, double elapsed, std::size_t width) {
  const double part =
      state.steps == 0 ? 1 : static_cast<double>(state.step) / static_cast<double>(state.steps);
  std::string line;
  if (width > 0) {
    const auto filled = static_cast<std::size_t>(part * static_cast<double>(width));
    line = fmt::format("[{:-<{}}] ", std::string(filled, '#'), width);
  }
  line += fmt::format("step {}/{}  t = {:.4f} s  {} pieces  {} fans", state.step, state.steps,
                      state.time, state.pieces, state.fans);
  if (state.behind > 0) line += fmt::format("  {:.2f} s behind", state.behind);
  if (state.step > 0) line += fmt::format("  {} left", wall_time(elapsed * (1 - part) / part));
  return line;
}

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(is_terminal(STDERR_FILENO)), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::show(const ProgressState& state) {
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(3000);
  if (now - last_ < pause) return;
  last_ = now;
  shown_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string line = progress_line(state, elapsed, terminal_ ? 24 : 0);
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
  std::fflush(stderr);
}

}  // namespace sunder

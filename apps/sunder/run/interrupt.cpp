// SPDX-License-Identifier: MIT
// The handlers, which may call little.
#include "apps/sunder/run/interrupt.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>

#include "apps/sunder/exit_code.hpp"

namespace sunder {
namespace {

std::atomic<std::int64_t> interrupted_at = 0;  ///< s
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// Wall time that a step may take to its end where its start is not kept, s.
constexpr unsigned grace = 2;

/// Ends the program, with calls that a handler of signals may make.
[[noreturn]] void leave_at_once() {
  constexpr std::string_view words = "sunder: interrupted\n";
  static_cast<void>(::write(STDERR_FILENO, words.data(), words.size()) > 0);
  _exit(static_cast<int>(ExitCode::interrupted));
}

void on_signal(int) {
  const int error = errno;
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!writes_files) leave_at_once();
  if (was_interrupted.exchange(true)) {
    // A terminal and `timeout` signal a program and its group: twice at once.
    if (now.tv_sec > interrupted_at + 1) leave_at_once();
  } else {
    interrupted_at = now.tv_sec;
    if (start_is_kept) {
      hurry = true;
    } else {
      alarm(grace);
    }
  }
  errno = error;
}

}  // namespace

void watch_for_interrupt() {
  was_interrupted = hurry = start_is_kept = writes_files = false;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // nohup has SIGHUP ignored, and wants it to stay so.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  action.sa_handler = [](int) { hurry = true; };
  sigaction(SIGALRM, &action, nullptr);
}

}  // namespace sunder

// SPDX-License-Identifier: MIT
// Starting, asking and ending a child process.
#include "topology/suite/kernels/process_kernel_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>

#include "topology/suite/kernels/judged_kernel.hpp"

extern char** environ;

namespace sunder::suite {
namespace {

using Clock = std::chrono::steady_clock;

/// Keeps a write to a process that is gone from ending ours: SIGPIPE is held back in this thread
/// and taken away before it can be delivered. The program's own handler stays untouched.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutSigpipe() {
    constexpr timespec at_once = {0, 0};
    if (!was_pending_) {
      while (sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_ = false;
};

void close_all(std::initializer_list<int> files) {
  for (const int file : files) {
    if (file >= 0) close(file);
  }
}

/// How often a process that says nothing is looked at.
constexpr int look_every = 100;  // ms

}  // namespace

std::string in_quotes(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  constexpr std::size_t enough = 80;
  std::string quoted = "\"";
  for (const char c : line.substr(0, enough)) {
    const auto byte = static_cast<unsigned char>(c);
    quoted += byte >= ' ' && byte <= '~' ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
  }
  return quoted + (line.size() > enough ? "...\"" : "\"");
}

Child::Child(const std::string& command) : command_(command) {
  std::array<int, 2> in = {-1, -1}, out = {-1, -1};
  if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    close_all({in[0], in[1]});
    throw KernelLost(fmt::format("kernel \"{}\": no pipe: {}", command, std::strerror(error)));
  }
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::array<char*, 4> arguments = {const_cast<char*>("sh"), const_cast<char*>("-c"),
                                    const_cast<char*>(command.c_str()), nullptr};
  const int error =
      posix_spawn(&process_, "/bin/sh", &files, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  close_all({in[0], out[1]});
  to_ = in[1];
  from_ = out[0];
  if (error != 0) {
    close_all({to_, from_});
    throw KernelLost(fmt::format("kernel \"{}\": not started: {}", command, std::strerror(error)));
  }
  fcntl(to_, F_SETFL, O_NONBLOCK);
  fcntl(from_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (!ended_) {
    std::string_view quit = "quit\n";
    const auto deadline = Clock::now() + std::chrono::seconds(1);
    while (!ended_ && Clock::now() < deadline) {
      exchange(quit, 20);
      received_.clear();
      if (!quit.empty() || to_ < 0) continue;
      close(to_);
      to_ = -1;
    }
  }
  kill(-process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  close_all({to_, from_});
}

/// Waits until something can be written or read and does it; notes the end of the process's output
/// in `ended_`. False: nothing happened in time.
bool Child::exchange(std::string_view& to_send, int milliseconds) {
  std::array<pollfd, 2> files = {{{from_, POLLIN, 0}, {to_send.empty() ? -1 : to_, POLLOUT, 0}}};
  if (poll(files.data(), files.size(), milliseconds) <= 0) return false;
  if (files[1].revents != 0) {
    const WithoutSigpipe guard;
    const ssize_t written = write(to_, to_send.data(), to_send.size());
    if (written > 0) to_send.remove_prefix(static_cast<std::size_t>(written));
    // A process that reads no more may still have answered: the end of its output will show it.
    if (written < 0 && errno == EPIPE) to_send = {};
  }
  if (files[0].revents != 0) {
    std::array<char, 65536> buffer;
    const ssize_t got = read(from_, buffer.data(), buffer.size());
    if (got > 0) received_.append(buffer.data(), static_cast<std::size_t>(got));
    ended_ = got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
  }
  return true;
}

/// Whether the process has ended; its output may still be held open by one that it started.
bool Child::is_gone() const {
  siginfo_t info = {};
  return waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOWAIT | WNOHANG) == 0 &&
         info.si_pid != 0;
}

std::string Child::how_it_ended() const {
  // Its output is closed; if it lives on none the less, it is of no more use. Dying takes a while
  // where a core is dumped.
  const auto deadline = Clock::now() + std::chrono::seconds(2);
  while (!is_gone() && Clock::now() < deadline) usleep(10000);
  siginfo_t info = {};
  waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOWAIT | WNOHANG);
  if (info.si_pid == 0) return "closed its output";
  if (info.si_code == CLD_EXITED) return fmt::format("ended with exit code {}", info.si_status);
  return fmt::format("was ended by signal {} ({})", info.si_status, strsignal(info.si_status));
}

std::string Child::ask(std::string_view text, const Limits& limits) {
  const std::string_view question = text;
  const auto why = [&](const std::string& what) {
    return fmt::format("kernel \"{}\", asked {}: {}", command_, in_quotes(question), what);
  };
  std::string_view nothing;
  exchange(nothing, 0);
  if (!received_.empty()) {
    throw KernelLost(why(fmt::format("it had said {} without being asked", in_quotes(received_))));
  }
  const auto deadline = Clock::now() + std::chrono::duration<double>(limits.seconds);
  for (;;) {
    const std::size_t end = received_.find('\n');
    if (end != std::string::npos && text.empty()) {
      std::string answer = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (!received_.empty()) {
        throw KernelLost(why(fmt::format("its answer {} has another line, {}", in_quotes(answer),
                                         in_quotes(received_))));
      }
      if (!answer.empty() && answer.back() == '\r') answer.pop_back();
      return answer;
    }
    if (ended_) throw KernelLost(why("it " + how_it_ended()));
    if (received_.size() > limits.longest_answer) {
      throw KernelLost(why(fmt::format("its answer is longer than {} bytes and begins {}",
                                       limits.longest_answer, in_quotes(received_))));
    }
    const std::chrono::duration<double, std::milli> left = deadline - Clock::now();
    if (left.count() <= 0) {
      throw KernelSilent(why(fmt::format("no answer within {:.3g} s", limits.seconds)));
    }
    const double wait = std::min<double>(std::ceil(left.count()), look_every);
    if (exchange(text, static_cast<int>(wait)) || !is_gone()) continue;
    // Its last output may have come between the two looks.
    if (exchange(text, 0)) continue;
    throw KernelLost(why("it " + how_it_ended() + " and left its output to another process"));
  }
}

}  // namespace sunder::suite

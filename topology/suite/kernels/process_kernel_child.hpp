// SPDX-License-Identifier: MIT
// A child process that is asked in lines on its stdin and answers in lines on its stdout. The
// meaning of the lines is decided elsewhere.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace sunder::suite {

/// The start of a process's output, as a message quotes it: its first line, 80 characters at most,
/// with bytes that are not printable ASCII as \xNN. A terminal, JSON and XML can take it.
std::string in_quotes(std::string_view text);

/// One process under /bin/sh, in a process group of its own; killed with all that is still in that
/// group, and reaped, when the object ends. Its stderr is ours. POSIX only. Not thread-safe.
class Child {
 public:
  /// Throws KernelLost when no process can be started; a command that does not exist shows with
  /// the first question.
  explicit Child(const std::string& command);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  /// Says `quit` and waits a second for an end in peace, unless it was given up; then kills.
  ~Child();
  /// There is no more to say to it.
  void give_up() { ended_ = true; }

  struct Limits {
    double seconds = 10;
    std::size_t longest_answer = 1 << 20;
  };
  /// Sends `text` (whole lines) and gives the one line that comes back, without its end. Writes and
  /// reads at once, so that full pipes cannot lock. Throws KernelLost, naming the first line of
  /// `text`: the process ended (how), closed its output, said more than one line or spoke without
  /// being asked, or the answer is too long; KernelSilent when its time is over. Do not ask again
  /// after that.
  std::string ask(std::string_view text, const Limits& limits);

 private:
  bool is_gone() const;
  std::string how_it_ended() const;
  bool exchange(std::string_view& to_send, int milliseconds);

  std::string command_;
  pid_t process_ = -1;
  int to_ = -1, from_ = -1;
  std::string received_;
  bool ended_ = false;  // its output, or all talk with it
};

}  // namespace sunder::suite

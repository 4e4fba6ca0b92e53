// SPDX-License-Identifier: MIT
// Messages of a command on standard error: one rule for --quiet, --verbose and colours.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

/// How much is reported. Results on standard output are the same in every case.
struct Telling {
  /// The result is JSON; a refusal too.
  bool json = false;
  /// Errors only: no warnings, notes, remarks, progress.
  bool quiet = false;
  /// Also the stages of the work, each with its time, and the chosen settings of a run.
  bool verbose = false;
};

/// Adds `--quiet` to a command that prints more than errors on standard error.
CLI::Option* add_quiet_flag(CLI::App& command, Telling& telling);

/// Adds `--verbose` to a command with stages in its work. It excludes `--quiet`, if the command has
/// that already.
void add_verbose_flag(CLI::App& command, Telling& telling);

/// Adds both.
void add_telling_flags(CLI::App& command, Telling& telling);

/// Prints findings on standard error. With `json` and an error among them, which leaves the command
/// without a result, prints `{"findings": [...]}` on standard output too.
void tell(const std::vector<Finding>& findings, const Telling& telling);

/// Prints findings on standard error alone: for commands that have them in their result or go on.
void tell_beside(const std::vector<Finding>& findings, const Telling& telling);

/// Words on standard error that are no findings; nothing with `quiet`.
void remark(std::string_view words, const Telling& telling);

/// Prints the stages of a command's work with `verbose`, as they end.
class Stages {
 public:
  explicit Stages(const Telling& telling);
  /// Ends a stage. Its time counts from the last stage (the first: from the beginning).
  void done(std::string_view what);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_;
  Clock::time_point last_;
};

/// Whether a file descriptor is a terminal on which lines can be drawn again: not where TERM is
/// "dumb", empty or not set.
bool is_terminal(int descriptor);

/// Whether words are coloured there: on such a terminal, unless NO_COLOR is set and not empty.
bool shows_colours(int descriptor);

}  // namespace sunder

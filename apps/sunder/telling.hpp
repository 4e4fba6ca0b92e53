// SPDX-License-Identifier: MIT
// What a command says on standard error beside its result: one rule for --quiet, --verbose, colours.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

/// How much is told. Results on standard output are the same in every case.
struct Telling {
  /// The result is JSON; a refusal too.
  bool json = false;
  /// Errors alone: no warnings, notes, remarks, progress.
  bool quiet = false;
  /// Also what is done, each with the time that it took.
  bool verbose = false;
};

/// Adds `--quiet` to a command that tells more than errors on standard error.
CLI::Option* add_quiet_flag(CLI::App& command, Telling& telling);

/// Adds `--verbose` to a command whose work has stages; with `--quiet` it cannot go, if that is
/// there already.
void add_verbose_flag(CLI::App& command, Telling& telling);

/// Adds both.
void add_telling_flags(CLI::App& command, Telling& telling);

/// Tells findings on standard error; where an error among them leaves a command without a result
/// and JSON is asked for, on standard output as `{"findings": [...]}` too.
void tell(const std::vector<Finding>& findings, const Telling& telling);

/// Tells findings on standard error alone: of commands that have them in their result, or go on.
void tell_beside(const std::vector<Finding>& findings, const Telling& telling);

/// Words on standard error that are no findings; nothing with `quiet`.
void remark(std::string_view words, const Telling& telling);

/// Tells stages of a command's work with `verbose`, as they end.
class Stages {
 public:
  explicit Stages(const Telling& telling);
  /// The work since the last stage (the first: since the beginning) was `what`.
  void done(std::string_view what);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_;
  Clock::time_point last_;
};

/// Whether a file descriptor is a terminal on which lines can be drawn anew: not where TERM is
/// "dumb", empty or not set.
bool is_terminal(int descriptor);

/// Whether words are coloured there: on such a terminal, unless NO_COLOR is set and not empty.
bool shows_colours(int descriptor);

}  // namespace sunder

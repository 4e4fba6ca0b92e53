// SPDX-License-Identifier: MIT
// How the program ends, as a number for shells.
#pragma once

namespace sunder {

enum class ExitCode : int {
  fine = 0,
  /// The check found problems, or a conversion would lose something.
  problems = 1,
  usage = 2,
  /// Unreadable or invalid input.
  bad_input = 3,
  /// An output could not be written.
  not_written = 4,
  /// The simulation failed: diverged, not a number. Of every command: memory ran out.
  failed = 5,
  /// A replay departs from the log that it follows.
  departed = 6,
  /// A run to its end that has warnings, where `--strict` asks.
  warned = 7,
  interrupted = 130,
};

}  // namespace sunder

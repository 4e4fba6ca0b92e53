// SPDX-License-Identifier: MIT
// `sunder break`: from a file of any object to its fragments.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds `break THING [options]`. `exit_code` is set when the command runs.
void add_break_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

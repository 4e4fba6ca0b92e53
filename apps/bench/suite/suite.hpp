// SPDX-License-Identifier: MIT
// `sunder suite`: judges topology kernels by the fixtures of a folder.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `suite` to the program; `exit_code` is set when it has run.
void add_suite_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

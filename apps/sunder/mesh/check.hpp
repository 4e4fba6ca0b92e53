// SPDX-License-Identifier: MIT
// `sunder check`: the properties of a mesh, and its faults.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `check` to the program; `exit_code` is set when it has run.
void add_check_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

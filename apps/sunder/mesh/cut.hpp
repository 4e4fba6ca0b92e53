// SPDX-License-Identifier: MIT
// `sunder cut`: a body cut in two by a plane, through its cells or between them.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `cut` to the program; `exit_code` is set when it has run.
void add_cut_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

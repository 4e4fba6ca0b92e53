// SPDX-License-Identifier: MIT
// `sunder export`: a finished run for other programs.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `export` to the program; `exit_code` is set when it has run.
void add_export_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

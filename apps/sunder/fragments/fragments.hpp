// SPDX-License-Identifier: MIT
// `sunder fragments`: how large the pieces of a run are, with fitted laws and a plot.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `fragments` to the program; `exit_code` is set when it has run.
void add_fragments_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// `sunder modes`: natural frequencies and shapes of a scene's bodies.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `modes` to the program; `exit_code` is set when it has run.
void add_modes_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

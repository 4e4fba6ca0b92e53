// SPDX-License-Identifier: MIT
// `sunder static`: equilibrium of a scene's bodies under its loads.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `static` to the program; `exit_code` is set when it has run.
void add_static_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// `sunder convert`: a mesh file into another format, with every loss reported before it happens.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `convert` to the program; `exit_code` is set when it has run.
void add_convert_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

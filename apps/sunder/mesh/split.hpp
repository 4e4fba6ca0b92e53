// SPDX-License-Identifier: MIT
// `sunder split`: splits chosen faces of a mesh and reports the parts that came apart.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `split` to the program; `exit_code` is set when it has run.
void add_split_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

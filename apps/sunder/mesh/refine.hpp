// SPDX-License-Identifier: MIT
// `sunder refine`: finer tetrahedra everywhere, in regions, near a plane or near cracks.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds the subcommand `refine` to the program; `exit_code` is set when it has run.
void add_refine_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// `sunder view`: a scene in the browser, computed here.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Whether the page that `sunder view` serves is built.
bool page_is_built();

/// Adds the subcommand `view` to the program; `exit_code` is set when it has run.
void add_view_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

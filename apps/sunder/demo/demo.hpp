// SPDX-License-Identifier: MIT
// `sunder demo`: something breaks within half a minute, and the next line to type.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds `demo [-o DIR]`. `exit_code` is set when the command runs.
void add_demo_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

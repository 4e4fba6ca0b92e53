// SPDX-License-Identifier: MIT
// `sunder bench formats`: how fast each format is written, read and checked.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

void add_formats_command(CLI::App& bench, ExitCode& exit_code);

}  // namespace sunder

// SPDX-License-Identifier: MIT
// The command `sunder bench`.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds `bench` to the program; parsing runs it and sets `exit_code`.
void add_bench_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder

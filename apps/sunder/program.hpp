// SPDX-License-Identifier: MIT
// What the programs share: parsing a command line with its commands, and how mistakes end.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "apps/sunder/exit_code.hpp"

namespace sunder {

/// Adds commands to a program; parsing runs one of them, which sets the exit code.
using AddCommands = std::function<void(CLI::App& program, ExitCode& exit_code)>;

/// Runs the command that the arguments name, and gives what the program ends with: mistakes on the
/// command line are told and end with `usage`, exceptions with `failed`.
int run_program(int argc, char** argv, const AddCommands& add_commands);

}  // namespace sunder
